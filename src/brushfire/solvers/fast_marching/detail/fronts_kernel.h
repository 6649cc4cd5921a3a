// What the fronts of fronts.h make of an edge with values t1 and t2 at its ends.
//
// The frame: the edge runs from v1 = (0,0) to v2 = (length,0), the target lies at (x,y) above it, `side` away from v1.
// A value that is not known yet is +inf; a triangle that conducts along its side only has x = NaN. `any_order`: the
// target may be nearer to the start than v1 although its corner is not obtuse. update() gives the value at the target,
// and tells whether the front reaches it through the edge; void where not.
namespace brushfire::fast_marching::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

// V: a number, or lanes, of an edge each.
template <class Front, class V>
struct FrontOverEdge;

template <class V>
struct FrontOverEdge<CircularFront, V> {
  using T = NumberIn<V>;
  V length, inverse, t1, start_x, start_y;
  MaskFor<V> real;

  // inverse: 1 / length
  BRUSHFIRE_INLINE static FrontOverEdge of(V length, V inverse, V t1, V t2) {
    // t1 + t2 - length says how far the starting point is from the edge. Where that difference is but rounding, the
    // point is taken a little farther away, never nearer: values only fall, so an underestimate would stay.
    constexpr T kShorter = 1 - 8 * std::numeric_limits<T>::epsilon();
    const V difference = t1 - t2, sum = t1 + t2;
    // Sixteen times the squared area of the triangle of starting point and edge (Heron, differences factored).
    const V heron = (sum - kShorter * length) * (sum + length) * (length - difference) * (length + difference);
    const V half = T(0.5) * inverse, start_x = T(0.5) * length + difference * sum * half;
    const V start_y = square_root(greater(heron, V(0))) * half;  // below the edge
    return {length, inverse, t1, start_x, start_y, V(0) < heron};
  }

  template <class Index>
  BRUSHFIRE_INLINE FrontOverEdge permuted_by(const Index& index) const {
    return {permuted(length, index),  permuted(inverse, index), permuted(t1, index),
            permuted(start_x, index), permuted(start_y, index), permuted(real, index)};
  }

  BRUSHFIRE_INLINE V update(V x, V y, V side, MaskFor<V> any_order, MaskFor<V>& through) const {
    // The ray from the starting point to the target crosses the edge's line at crossing/height.
    const V height = y + start_y;
    const V crossing = start_x * y + x * start_y;
    const V across = x - start_x;
    const V straight = square_root(across * across + height * height);
    const auto causal = any_order | ((t1 - straight) * (t1 + straight) <= side * side);
    const auto within = (V(0) <= crossing) & (crossing <= length * height);
    through = real & within & (straight < t1 + side) & causal;
    return straight;
  }
};

template <class V>
struct FrontOverEdge<LiteralCircularFront, V> {
  using T = NumberIn<V>;
  V inverse, start_x, start_y;
  MaskFor<V> real;

  BRUSHFIRE_INLINE static FrontOverEdge of(V length, V inverse, V t1, V t2) {
    const V l2 = length * length;
    const V a = T(2) * t1 * t1 * l2 - l2 * l2 + T(2) * t2 * t2 * l2;
    const V b = (t1 * t1 - t2 * t2) * (t1 * t1 - t2 * t2);
    const V start_x = T(0.5) * (l2 + t1 * t1 - t2 * t2) * inverse;
    const V start_y = T(0.5) * square_root(greater(a - b, V(0))) * inverse;
    return {inverse, start_x, start_y, V(0) <= a - b};
  }

  template <class Index>
  BRUSHFIRE_INLINE FrontOverEdge permuted_by(const Index& index) const {
    return {permuted(inverse, index), permuted(start_x, index), permuted(start_y, index), permuted(real, index)};
  }

  BRUSHFIRE_INLINE V update(V x, V y, V, MaskFor<V>, MaskFor<V>& through) const {
    const V across = x - start_x, height = y + start_y;
    const V straight = square_root(across * across + height * height);
    through = real & (straight < V(std::numeric_limits<T>::infinity()));
    return straight;
  }
};

template <class V>
struct FrontOverEdge<PlanarFront, V> {
  using T = NumberIn<V>;
  V length, inverse, t1, t2, slope_x, slope_y;
  MaskFor<V> real;

  BRUSHFIRE_INLINE static FrontOverEdge of(V length, V inverse, V t1, V t2) {
    const V slope_x = (t2 - t1) * inverse, rest = (T(1) - slope_x) * (T(1) + slope_x);
    return {length, inverse, t1, t2, slope_x, square_root(greater(rest, V(0))), V(0) < rest};
  }

  // t1 is the same in all lanes: planar fronts start from one value.
  template <class Index>
  BRUSHFIRE_INLINE FrontOverEdge permuted_by(const Index& index) const {
    return {permuted(length, index),  permuted(inverse, index), t1, permuted(t2, index), permuted(slope_x, index),
            permuted(slope_y, index), permuted(real, index)};
  }

  BRUSHFIRE_INLINE V update(V x, V y, V side, MaskFor<V> any_order, MaskFor<V>& through) const {
    const V crossing = x * slope_y - slope_x * y;
    const V straight = t1 + (slope_x * x + slope_y * y);
    const auto causal = any_order | ((t1 <= straight) & (t2 <= straight));
    const auto within = (V(0) <= crossing) & (crossing <= length * slope_y);
    through = real & within & (straight < t1 + side) & causal;
    return straight;
  }
};

}  // namespace brushfire::fast_marching::BRUSHFIRE_TARGET
