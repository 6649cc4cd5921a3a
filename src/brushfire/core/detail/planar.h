// Plane geometry of one triangle and of circles around its corners: the formulas that every solver shares.
//
// The frame of an edge: its first end at (0,0), its second at (length,0), the triangle's third corner ("apex") above.
#pragma once

#include <brushfire/core/types.h>

#include <utility>

namespace brushfire {

// Sixteen times the squared area of a triangle with these sides; negative where no such triangle exists. Heron's
// formula with every difference factored, so that a thin triangle keeps its digits (Kahan 2014, Miscalculating Area
// and Angles of a Needle-like Triangle).
template <class Real>
constexpr Real heron(Real l, Real a, Real b) {
  return (a + b - l) * (a + b + l) * (l - (a - b)) * (l + (a - b));
}

// The same with the sides in any order: sorted first, which is what makes the result accurate for needles.
template <class Real>
constexpr Real heron_sorted(Real a, Real b, Real c) {
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  return (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
}

// The apex of a triangle over an edge of length `l` > 0; `a`, `b`: from the edge's first and second end to the apex.
// The altitude comes from the area, not from the lengths, which lose it for flat triangles.
template <class Real>
constexpr BasicVec2<Real> apex_over_edge(Real l, Real a, Real b, Real double_area) {
  return {0.5 * (l + (a - b) * (a + b) / l), double_area / l};
}

}  // namespace brushfire
