// The loops over lists, four windows at a time. They go on to the end of the last four: columns have room for it
// (kRoomBehind), and what is made of no window there is not looked at.
namespace brushfire::windows::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

using Real4 = Lanes<double, 4>;

template <bool kMixed>
inline void look(const WindowColumns& w, Index count, Vec2 apex, double near, Sight& sight) {
  const Real4 apex_x(apex.x), apex_y(apex.y), zero(0), one(1), never(kInfinity);
  double *const lefts = sight.left.data(), *const rights = sight.right.data(), *const values = sight.value.data();
  std::uint64_t passes_left = 0, passes_right = 0;
  Real4 least = never;
  for (Index i = 0; i < count; i += 4) {
    const Real4 x = load<Real4>(w.x + i), y = load<Real4>(w.y + i), sigma = load<Real4>(w.sigma + i);
    // Linear windows are told by y > 0 (WindowColumns): the weight of the origin is 1 or 0, as in window.h.
    const auto linear = zero < y;
    const Real4 below = kMixed ? select(linear, -y, y) : y;
    const Real4 across = x * apex_y - below * apex_x;
    const Real4 along = (kMixed ? select(linear, zero, one) * apex_y : apex_y) - below;
    const Real4 left = across - load<Real4>(w.b0 + i) * along, right = load<Real4>(w.b1 + i) * along - across;
    const Real4 dx = apex_x - x, way = square_root(dx * dx + along * along);
    const Real4 straight = sigma + (kMixed ? select(linear, -(apex_x * x + apex_y * below), way) : way);
    const Real4 value = select(-Real4(near) * along < lesser(left, right), straight, never);
    store(lefts + i, left);
    store(rights + i, right);
    store(values + i, value);
    passes_left |= std::uint64_t{bits(zero < left)} << i % 64;
    passes_right |= std::uint64_t{bits(zero < right)} << i % 64;
    const bool all = count - i >= 4;
    least = lesser(all ? value : select(mask_cast<double>(first_lanes<4>(count - i)), value, never), least);
  }
  const std::uint64_t here = count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
  sight.passes_left = passes_left & here, sight.passes_right = passes_right & here;
  double of[4];
  store(of, least);
  sight.least = kNoIndex;
  const double least_of_all = std::min(std::min(of[0], of[1]), std::min(of[2], of[3]));
  if (!(least_of_all < kInfinity)) return;
  for (Index i = 0;; i += 4) {
    const std::uint32_t found = bits(load<Real4>(values + i) == Real4(least_of_all));
    if (found == 0) continue;
    sight.least = i + static_cast<Index>(std::countr_zero(found));
    return;
  }
}

// Whether some window does not obviously go on to one side alone. The first `left_end` should go left, those from
// `right_begin` on right (one may be both): they do if they pass the apex there and not on the other side, or if they
// end before `place`, where the best one's ray to the apex crosses the edge.
inline bool is_doubtful(const WindowColumns& w, Index count, const Sight& sight, Index left_end, Index right_begin,
                        double left_place, double right_place) {
  const Real4 zero(0);
  for (Index i = 0; i < count; i += 4) {
    const Real4 left = load<Real4>(sight.left.data() + i), right = load<Real4>(sight.right.data() + i);
    const Real4 b0 = load<Real4>(w.b0 + i), b1 = load<Real4>(w.b1 + i);
    const std::uint32_t fine_left = bits((zero < left) & ((right <= zero) | (b1 <= Real4(left_place))));
    const std::uint32_t fine_right = bits((zero < right) & ((left <= zero) | (Real4(right_place) <= b0)));
    const std::uint32_t lefts = i < left_end ? windows_from(i, left_end) : 0;
    const std::uint32_t rights = right_begin <= i ? 15u : ~windows_from(i, right_begin);
    if (((lefts & ~fine_left) | (rights & windows_from(i, count) & ~fine_right)) != 0) return true;
  }
  return false;
}

inline void copy_what_stays(const WindowColumns& from, const WindowColumns& to, Index i) {
  store(to.sigma + i, load<Real4>(from.sigma + i));
  std::memcpy(to.pseudo_source + i, from.pseudo_source + i, 4 * sizeof(Index));
}

// Towards the edge on the left of a triangle; see propagate(): the ray through (b,0) meets that edge at the share
// b q / (cx q - cy (b - x)) of its length. Whether some of the results may be slivers.
inline bool to_left(const WindowColumns& w, Index count, const double* goes, const double* passes, const Frame& frame,
                    const WindowColumns& to) {
  const Real4 apex_x(frame.apex.x), apex_y(frame.apex.y), length(frame.left), zero(0);
  const Real4 ux(frame.apex.x / frame.left), uy(frame.apex.y / frame.left);
  std::uint32_t dim = 0;
  for (Index i = 0; i < count; i += 4) {
    const Real4 b0 = load<Real4>(w.b0 + i), b1 = load<Real4>(w.b1 + i);
    const Real4 x = load<Real4>(w.x + i), y = load<Real4>(w.y + i);
    const Real4 q = -y, along = apex_x * q;
    const Real4 at0 = length * (b0 * q / (along - apex_y * (b0 - x)));
    const Real4 at1 = length * (b1 * q / (along - apex_y * (b1 - x)));
    const auto asked = zero < load<Real4>(goes + i);
    const Real4 begin = select(zero < b0, lesser(at0, length), zero);
    const Real4 end = select(zero < load<Real4>(passes + i), length, lesser(at1, length));
    const Real4 sx = x * ux + y * uy, sy = y * ux - x * uy;
    store(to.b0 + i, begin);
    store(to.b1 + i, select(asked, end, begin));
    store(to.x + i, sx);
    store(to.y + i, sy);
    copy_what_stays(w, to, i);
    const auto wide = Real4(kSliver) * (magnitude(sx) + length - sy) < end - begin, visible = sy < zero;
    dim |= ~bits(wide & visible & asked) & windows_from(i, count);
  }
  return dim != 0;
}

// The same on the right; places are measured from the end of the edge.
inline bool to_right(const WindowColumns& w, Index count, const double* goes, const double* passes, const Frame& frame,
                     const WindowColumns& to) {
  const double rest = frame.length - frame.apex.x;
  const Real4 apex_x(frame.apex.x), apex_y(frame.apex.y), base(frame.length), length(frame.right), zero(0), one(1);
  const Real4 ux(rest / frame.right), uy(-frame.apex.y / frame.right);
  std::uint32_t dim = 0;
  for (Index i = 0; i < count; i += 4) {
    const Real4 b0 = load<Real4>(w.b0 + i), b1 = load<Real4>(w.b1 + i);
    const Real4 x = load<Real4>(w.x + i), y = load<Real4>(w.y + i);
    const Real4 q = -y, along = Real4(rest) * q;
    const Real4 at0 = length * (one - (base - b0) * q / (along + apex_y * (b0 - x)));
    const Real4 at1 = length * (one - (base - b1) * q / (along + apex_y * (b1 - x)));
    const auto asked = zero < load<Real4>(goes + i);
    const Real4 begin = select(zero < load<Real4>(passes + i), zero, greater(at0, zero));
    const Real4 end = select(b1 < base, greater(at1, zero), length);
    const Real4 tx = x - apex_x, ty = y - apex_y;
    const Real4 sx = tx * ux + ty * uy, sy = ty * ux - tx * uy;
    store(to.b0 + i, begin);
    store(to.b1 + i, select(asked, end, begin));
    store(to.x + i, sx);
    store(to.y + i, sy);
    copy_what_stays(w, to, i);
    const auto wide = Real4(kSliver) * (magnitude(sx) + length - sy) < end - begin, visible = sy < zero;
    dim |= ~bits(wide & visible & asked) & windows_from(i, count);
  }
  return dim != 0;
}

inline void ends(const WindowColumns& w, Index count, double* d0, double* d1) {
  const Real4 zero(0);
  for (Index i = 0; i < count; i += 4) {
    const Real4 b0 = load<Real4>(w.b0 + i), b1 = load<Real4>(w.b1 + i), x = load<Real4>(w.x + i);
    const Real4 y = load<Real4>(w.y + i), sigma = load<Real4>(w.sigma + i);
    const Real4 p = b0 - x, q = b1 - x, h = y * y;
    Real4 to_b0 = square_root(p * p + h), to_b1 = square_root(q * q + h);
    if (w.mixed) {
      to_b0 = select(zero < y, -(b0 * x), to_b0);
      to_b1 = select(zero < y, -(b1 * x), to_b1);
    }
    store(d0 + i, sigma + to_b0);
    store(d1 + i, sigma + to_b1);
  }
}

}  // namespace brushfire::windows::BRUSHFIRE_TARGET
