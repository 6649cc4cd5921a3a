// The arc tangent of angle.h.
namespace brushfire::fast_marching::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

// atan2(y, x) for y >= 0 to 2e-8 and rounding, without branches; 0 for (0, 0).
template <class V>
BRUSHFIRE_INLINE V quick_angle(V x, V y) {
  using T = NumberIn<V>;
  const V ax = magnitude(x), larger = greater(ax, y), smaller = lesser(y, ax);
  const V t = smaller / select(V(0) < larger, larger, V(1)), u = t * t;
  V p(static_cast<T>(kAngleSeries.front()));
  for (std::size_t i = 1; i < kAngleSeries.size(); ++i) p = p * u + static_cast<T>(kAngleSeries[i]);
  const V octant = p * t;
  const V quadrant = select(ax < y, T(0.5 * kPi) - octant, octant);
  return select(x < V(0), T(kPi) - quadrant, quadrant);
}

}  // namespace brushfire::fast_marching::BRUSHFIRE_TARGET
