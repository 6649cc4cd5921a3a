// The inner loops of the search: every receiving point, four at a time, against every offering one.
namespace brushfire::steiner::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

// The least offer so far, and which point it is from.
inline void keep_lower(const Lanes<double, 4>& offer, Index i, Lanes<double, 4>& best, Lanes<double, 4>& origin) {
  const auto lower = offer < best;
  best = select(lower, offer, best);
  origin = select(lower, Lanes<double, 4>(static_cast<double>(i)), origin);
}

// The straight distance times the weight. Whether anything is lower than what was there. Most offers are none, since
// they go back to where the front has come from: these are told by the least value and the way from the nearest point
// of the stretch that offers.
inline bool relax_rows(const Offering& from, const Receiving& to, double weight, Offers& offers) {
  using V = Lanes<double, 4>;
  constexpr double kBelow = 1 - 0x1p-40;  // whatever rounding makes of an offer
  const double low = from.at[from.first], high = from.at[from.last], bounded = weight * kBelow;
  bool any_lower = false;
  for (Index j = 0; j < to.room; j += 4) {
    const V old = load<V>(to.value + j), at = load<V>(to.at + j);
    V best = old, origin(-1);
    const V x = to.start.x + at * to.direction.x, y = to.start.y + at * to.direction.y, yy = y * y;
    const V beside = greater(greater(low - x, x - high), V(0));
    if (any(from.least + bounded * square_root(beside * beside + yy) < old)) {
      for (Index i = from.first; i <= from.last; ++i) {
        const V dx = x - from.at[i], offer = from.value[i] + weight * square_root(dx * dx + yy);
        keep_lower(offer, i, best, origin);
      }
      any_lower = any_lower || any(best < old);
    }
    store(offers.value.data() + j, best);
    store(offers.from.data() + j, origin);
  }
  return any_lower;
}

// The same with the lowered costs of lower_costs.h; `rounding` is what a distance may be off by.
inline bool relax_rows_below(const Offering& from, const Receiving& to, double weight, const LowerTerms& near,
                             const LowerTerms& far, double rounding, Offers& offers) {
  using V = Lanes<double, 4>;
  constexpr double kTiny = 1e-100;  // its square is a number, and so is a quotient by it
  bool any_lower = false;
  for (Index j = 0; j < to.room; j += 4) {
    const V old = load<V>(to.value + j), at = load<V>(to.at + j);
    V best = old, origin(-1);
    if (any(V(from.least) < old)) {
      const V x = to.start.x + at * to.direction.x, y = to.start.y + at * to.direction.y, yy = y * y;
      const V height = load<V>(far.height.data() + j), reach = load<V>(far.reach.data() + j),
              variance = load<V>(far.variance.data() + j), quotient = load<V>(far.quotient.data() + j),
              ceiling = load<V>(far.ceiling.data() + j);
      for (Index i = from.first; i <= from.last; ++i) {
        const V dx = x - from.at[i], d = square_root(dx * dx + yy) - rounding;
        const V apart = greater(greater(d - reach - near.reach[i], V(kTiny)), greater(height, V(near.height[i])));
        const V square = apart * apart;
        const V spread = lesser(quotient * square, variance) + lesser(near.quotient[i] * square, V(near.variance[i]));
        const V share = apart / square_root(square + spread);
        const V cost = lesser(greater(d, V(0)) * share, ceiling + near.ceiling[i]);
        const V offer = from.value[i] + weight * cost;
        keep_lower(offer, i, best, origin);
      }
      any_lower = any_lower || any(best < old);
    }
    store(offers.value.data() + j, best);
    store(offers.from.data() + j, origin);
  }
  return any_lower;
}

}  // namespace brushfire::steiner::BRUSHFIRE_TARGET
