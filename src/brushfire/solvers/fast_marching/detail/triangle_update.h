// The value at one corner of a triangle from the values at the other two: pure functions, one per front model.
//
// Based on: Novotni, Klein (2002), Computing Geodesic Distances on Triangular Meshes, section 3 (circular front);
// Kimmel, Sethian (1998), Computing Geodesic Paths on Manifolds (planar front).
//
// The frame: the known edge runs from v1 = (0,0) to v2 = (length,0), the target lies at (x,y) above it. All functions
// tell whether the front reaches the target through the edge, and give its value if so; otherwise t1 + side, the value
// of the way along the edge from v1 (the way over v2 is v2's own affair). A value that is not known yet is +inf; a
// triangle that conducts along its side only has x = NaN. Branch-free, so that compilers run a block of triangles
// through vector registers.
#pragma once

#include <cmath>
#include <limits>

namespace brushfire::fast_marching {

template <class T>
struct UpdateTriangle {
  T length, inverse;  // of the edge v1v2; 1/length
  T x, y;             // the target
  T side;             // from v1 to the target
  bool any_order;     // the target may be nearer to the start than v1 although its corner is not obtuse
};

template <class T>
struct Update {
  T value;
  bool through;
};

// A front that started in one point, at distances t1 and t2 from the edge's ends: the target's distance from that
// point, where the straight line to it passes through the edge (ALGORITHMS: visibility test; without it the value is
// shorter than any path and every such error spreads).
struct CircularFront {
  static constexpr bool kBends = true;  // the circle's radius is carried along (see march.cpp)
  template <class T>
  static Update<T> update(const UpdateTriangle<T>& at, T t1, T t2) {
    // t1 + t2 - length says how far the starting point is from the edge. Where that difference is but rounding, the
    // point is taken a little farther away, never nearer: values only fall, so an underestimate would stay.
    constexpr T kShorter = 1 - 8 * std::numeric_limits<T>::epsilon();
    const T difference = t1 - t2, sum = t1 + t2;
    // Sixteen times the squared area of the triangle of starting point and edge (Heron, differences factored).
    const T heron =
        (sum - kShorter * at.length) * (sum + at.length) * (at.length - difference) * (at.length + difference);
    const T half = T(0.5) * at.inverse;
    const T start_x = T(0.5) * at.length + difference * sum * half;
    const T start_y = std::sqrt(heron > 0 ? heron : T(0)) * half;  // below the edge
    // The ray from the starting point to the target crosses the edge's line at crossing/height.
    const T height = at.y + start_y;
    const T crossing = start_x * at.y + at.x * start_y;
    const T across = at.x - start_x;
    const T straight = std::sqrt(across * across + height * height);
    const T along = t1 + at.side;
    const bool causal = at.any_order | ((t1 - straight) * (t1 + straight) <= at.side * at.side);
    const bool visible = (heron > 0) & (crossing >= 0) & (crossing <= at.length * height) & (straight < along) & causal;
    return {visible ? straight : along, visible};
  }
};

// The same, literally as printed: the farther of the two circle intersections, accepted always; where there is none,
// or only one value is known, the way along the edge.
struct LiteralCircularFront {
  static constexpr bool kBends = false;
  template <class T>
  static Update<T> update(const UpdateTriangle<T>& at, T t1, T t2) {
    const T l2 = at.length * at.length;
    const T a = 2 * t1 * t1 * l2 - l2 * l2 + 2 * t2 * t2 * l2;
    const T b = (t1 * t1 - t2 * t2) * (t1 * t1 - t2 * t2);
    const T start_x = T(0.5) * (l2 + t1 * t1 - t2 * t2) * at.inverse;
    const T start_y = T(0.5) * std::sqrt(a - b > 0 ? a - b : T(0)) * at.inverse;
    const T across = at.x - start_x, height = at.y + start_y;
    const T straight = std::sqrt(across * across + height * height);
    const bool real = (a - b >= 0) & (straight < std::numeric_limits<T>::infinity());
    return {real ? straight : t1 + at.side, real};
  }
};

// A straight front: of slope (t2 - t1)/length along the edge and slope 1 in all, where the ray that arrives at the
// target came through the edge (the upwind condition).
struct PlanarFront {
  static constexpr bool kBends = false;
  template <class T>
  static Update<T> update(const UpdateTriangle<T>& at, T t1, T t2) {
    const T slope_x = (t2 - t1) * at.inverse;
    const T rest = (1 - slope_x) * (1 + slope_x);
    const T slope_y = std::sqrt(rest > 0 ? rest : T(0));
    const T crossing = at.x * slope_y - slope_x * at.y;
    const T straight = t1 + (slope_x * at.x + slope_y * at.y);
    const T along = t1 + at.side;
    const bool causal = at.any_order | ((straight >= t1) & (straight >= t2));
    const bool visible = (rest > 0) & (crossing >= 0) & (crossing <= at.length * slope_y) & (straight < along) & causal;
    return {visible ? straight : along, visible};
  }
};

}  // namespace brushfire::fast_marching
