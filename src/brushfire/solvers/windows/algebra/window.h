// Window: an interval of an edge that one virtual source sees, and what can be asked of it.
//
// Based on: J. Mitchell, D. Mount, C. Papadimitriou, The Discrete Geodesic Problem, 1987; V. Surazhsky et al., Fast
// Exact and Approximate Geodesics on Meshes, 2005.
//
// The frame of a halfedge: its first end at (0,0), its second at (length,0), its face above, the source below.
#pragma once

#include <brushfire/solvers/windows/algebra/real.h>

#include <algorithm>
#include <cmath>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Circular: the light comes from a point, the virtual source: the last vertex (or the source itself) around which the
// path bends, unfolded into the plane of the edge. Linear: it comes from infinitely far away, in parallel rays, as
// from a segment that is a source along its whole length.
enum class WindowKind : std::uint32_t { Circular, Linear };

// The value of the window at x is  sigma + |x - source|  (circular) or  sigma - x * source.x  (linear). It is a lower
// bound of the distance where windows were merged, and the distance along the window's rays where not; `slack` more is
// a proven upper bound (0 in exact runs).
struct Window {
  Real b0 = 0, b1 = 0;  // the visible interval, 0 <= b0 < b1 <= length
  Vec2 source;          // circular: the virtual source; linear: the unit vector towards it. y < 0, or see is_visible()
  Real sigma = 0;       // circular: value at the virtual source; linear: value at the frame's origin
  Real d0 = 0, d1 = 0;  // values at b0 and b1
  Real slack = 0;       // a real path of length <= value + slack leads to every point of the interval
  float lift = 0;       // by how much the distance is expected to exceed the value, in [0, slack]; no proof hangs on it
  // Whose light it is: a vertex around which the path bends, or, from the number of vertices on, a source.
  Index pseudo_source = kNoIndex;
  WindowKind kind = WindowKind::Circular;
  Index trail = kNoIndex;  // which faces it has crossed: see Trails
};

// Weight of the frame's origin in the source's coordinates: moving the origin moves a point and leaves a direction.
constexpr double origin_weight(WindowKind kind) { return kind == WindowKind::Circular ? 1.0 : 0.0; }

// sqrt(x^2 + y^2). Lengths are near one (mesh.unit()), so that squares neither vanish nor overflow, and std::hypot's
// care would cost more than the rest of a window.
inline Real length_of(Real x, Real y) { return sqrt(x * x + y * y); }

// The value at a point p above the edge (p.y >= 0) along the straight ray from the source, wherever that ray crosses.
[[gnu::always_inline]] inline Real straight_value(const Window& w, Vec2 p) {
  if (w.kind == WindowKind::Circular) return w.sigma + length_of(p.x - w.source.x, p.y - w.source.y);
  return w.sigma - dot(p, w.source);
}

// The value at x on the edge.
inline Real value_at(const Window& w, Real x) { return straight_value(w, {x, 0}); }

// A lower bound of the values on the interval: the value changes by at most 1 per unit of length.
inline Real least_value(const Window& w) { return 0.5 * (w.d0 + w.d1 - (w.b1 - w.b0)); }

// The least value on the interval: over the foot of the source where that is visible, at the nearer end otherwise.
inline Real minimum_of(const Window& w) {
  if (w.kind == WindowKind::Circular && w.source.x > w.b0 && w.source.x < w.b1) return w.sigma - w.source.y;
  return std::min(w.d0, w.d1);
}

// Where the ray from the source to p (p.y >= 0) crosses the edge: at x = across / along, without the division.
// along > 0 whenever the source is below the edge.
struct Crossing {
  Real across = 0, along = 0;
};
inline Crossing crossing(const Window& w, Vec2 p) {
  return {w.source.x * p.y - w.source.y * p.x, origin_weight(w.kind) * p.y - w.source.y};
}

// How a window reaches a point p of the face above.
struct Arrival {
  Real value =
      kInfinity;    // length of the path: straight where p is seen, bent at the nearer end of the interval if not
  Real detour = 0;  // by how much the bend makes it longer than the straight line; 0 where p is seen
};
[[gnu::always_inline]] inline Arrival arrival(const Window& w, Vec2 p) {
  const Crossing c = crossing(w, p);
  const Real straight = straight_value(w, p);
  // A wrong decision about a ray that grazes an end is worth the detour, which is of second order in the miss.
  const bool before = c.across < w.b0 * c.along;
  if (!before && !(c.across > w.b1 * c.along)) return {straight, 0};
  const Real bent = (before ? w.d0 : w.d1) + length_of(p.x - (before ? w.b0 : w.b1), p.y);
  return {bent, bent - straight};
}

// The same window described from the other end of the edge, for a neighbour that runs the same way.
inline Window mirrored(const Window& w, Real length) {
  Window m = w;
  m.b0 = std::max(Real{0}, length - w.b1);
  m.b1 = w.b0 <= 0 ? length : length - w.b0;
  std::swap(m.d0, m.d1);
  m.source.x = origin_weight(w.kind) * length - w.source.x;
  if (w.kind == WindowKind::Linear) m.sigma = w.sigma - length * w.source.x;
  return m;
}

// Whether light comes through the interval at all: from a source below the edge, or from one on it, within the interval
// (that is how the middle vertex of a face without area, or a source in one, shines).
[[gnu::always_inline]] inline bool is_visible(const Window& w) {
  return w.source.y < 0 ||
         (w.source.y == 0 && w.kind == WindowKind::Circular && w.source.x > w.b0 && w.source.x < w.b1);
}

// How far from the edge places may be that the window is described by: what turns of the frame move is some epsilons of
// that.
inline Real extent_of(const Window& w) {
  return w.kind == WindowKind::Circular ? norm(w.source) : std::max(abs(w.d0), abs(w.d1));
}

// Whether the source lies on the edge, within the interval, or as good as: its light then leaves through one point, and
// parts of the interval do not stand for parts of the light. A cut beside a source that is kOnEdge of the interval away
// turns the limit ray by up to epsilon / kOnEdge = 2e-8; who is missed by that is reached round the cut with a detour
// of half its square, 2e-16. Nearer than that, cuts cannot be afforded.
inline constexpr double kOnEdge = 1e-8 * kSqrtFiner;
inline bool is_on_edge(const Window& w) {
  return -w.source.y <= kOnEdge * (w.b1 - w.b0) && w.kind == WindowKind::Circular && w.source.x > w.b0 &&
         w.source.x < w.b1;
}

// A window narrower than this share of its distance from the virtual source is dropped: what it alone lights is
// reached past its neighbour's end with a detour of at most twice its width.
inline constexpr double kSliver = 1e-14 * kFiner;
[[gnu::always_inline]] inline Real sliver_scale(const Window& w) {
  return w.kind == WindowKind::Circular ? w.d0 - w.sigma : w.b1;
}
[[gnu::always_inline]] inline bool is_sliver(const Window& w) { return !(w.b1 - w.b0 > kSliver * sliver_scale(w)); }

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
