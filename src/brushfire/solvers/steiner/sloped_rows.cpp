// Rows of points on slopes.
#include <brushfire/solvers/steiner/detail/relax.h>

namespace brushfire::steiner {

bool relax_sloped_rows(const Offering& from, const Receiving& to, double weight, Vec2 gradient, const Travel& travel,
                       Offers& offers) {
  bool any_lower = false;
  for (Index j = 0; j < to.room; ++j) {
    offers.value[j] = to.value[j];
    offers.from[j] = -1;
    if (!(from.least < to.value[j])) continue;
    const Vec2 end = to.start + to.at[j] * to.direction;
    for (Index i = from.first; i <= from.last; ++i) {
      if (!(from.value[i] < offers.value[j])) continue;
      const Vec2 way = end - Vec2{from.at[i], 0};
      const double offer = from.value[i] + weight * travel.cost(norm(way), dot(way, gradient));
      if (!(offer < offers.value[j])) continue;
      offers.value[j] = offer;
      offers.from[j] = static_cast<double>(i);
      any_lower = true;
    }
  }
  return any_lower;
}

}  // namespace brushfire::steiner
