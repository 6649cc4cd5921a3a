// Wedges of straight ways out of a point: what is seen of an edge after the faces on the way have been laid flat; and
// the goals that are found in them.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/detail/wide_face.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brushfire::windows {

using detail::DoubleDouble, detail::WideVec2;

// What the cross product of two arrows is rounded by at most, as a share of the product of their lengths: some hundred
// operations of 2^-104 each, with room for places that are far larger than what they are compared with.
inline constexpr double kNoTurn = 1e-26;

inline constexpr Index kStart = kNoIndex;  // the wedge before the first one

// The point lies in the origin; the edge goes from right to left.
struct Wedge {
  Index halfedge = kNoIndex;  // of the face that is left through the edge
  Index right_vertex = kNoIndex, left_vertex = kNoIndex;
  WideVec2 right, left;              // ends of the edge
  WideVec2 right_limit, left_limit;  // vertices that bound the wedge
  Index before = kStart;             // the wedge that it is a part of
  Index origin = 0;                  // the start whose place is the origin
  Vec2 guide;                        // where the hint points; 0: nowhere
};

// Where a leg may start.
struct LegGoal {
  double total = kInfinity;  // value there and length of the leg
  double length = 0;         // of the straight part
  Index vertex = kNoIndex, source = kNoIndex;
  Index face = kNoIndex;  // that holds it, and the weights there
  std::array<double, 3> weights{0, 0, 0};
  WideVec2 place;
  Index wedge = kStart;
  Index origin = 0;
};

inline Vec2 rounded(WideVec2 a) { return {a.x.high, a.y.high}; }
inline double length_of(WideVec2 a) { return norm(a).high; }

// > 0: b lies to the left of a; 0 where that cannot be told.
inline int side_of(WideVec2 a, WideVec2 b) {
  const double t = cross(a, b).high;
  const double room = kNoTurn * norm(rounded(a)) * norm(rounded(b));
  return t > room ? 1 : t < -room ? -1 : 0;
}

// The same within a half-plane, one limit of which may be opposite of the other.
inline bool is_left_of(WideVec2 a, WideVec2 b) {
  const int t = side_of(a, b);
  return t > 0 || (t == 0 && dot(a, b).high < 0);
}

inline double angle_between(Vec2 a, Vec2 b) { return std::atan2(std::abs(cross(a, b)), dot(a, b)); }

inline bool in_wedge(const Wedge& w, WideVec2 p) {
  return side_of(w.right_limit, p) >= 0 && side_of(p, w.left_limit) >= 0;
}

// The part of the wedge's edge that lies in the wedge, from right to left, as shares of the edge: of an edge 1e16 long
// next places in doubles are units apart.
struct VisiblePart {
  DoubleDouble first, last;
};
inline VisiblePart visible_part(const Wedge& w) {
  const auto share = [&](WideVec2 limit, DoubleDouble otherwise) {
    const DoubleDouble r = -cross(limit, w.right), sum = r + cross(limit, w.left);
    return sum.high > 0 ? std::clamp(r / sum, DoubleDouble(0), DoubleDouble(1)) : otherwise;
  };
  return {share(w.right_limit, 0.0), share(w.left_limit, 1.0)};
}

// How far away the edge is, in the direction of the wedge that is nearest to the hint. Who is far has got somewhere:
// between thin faces over one edge a way may go to and fro for as long as it likes.
inline double reach(const Wedge& w) {
  const Vec2 right = rounded(w.right), edge = rounded(w.left - w.right), first = rounded(w.right_limit),
             last = rounded(w.left_limit);
  const bool is_right = cross(first, w.guide) < 0, is_left = cross(w.guide, last) < 0;
  const Vec2 along = !is_right && !is_left ? w.guide : is_right ? first : last;
  const double across = cross(along, edge);
  return across > 0 ? cross(right, edge) / across * norm(along) : norm(right);
}

// By what angle the hint misses the wedge.
inline double miss(const Wedge& w) {
  if (w.guide == Vec2{0, 0}) return kPi;
  const Vec2 right = rounded(w.right_limit), left = rounded(w.left_limit);
  if (cross(right, w.guide) >= 0 && cross(w.guide, left) >= 0) return 0;
  return std::min(angle_between(right, w.guide), angle_between(left, w.guide));
}

// Where the straight way to a place that is `length` away crosses the wedge's edge.
inline SurfacePoint crossing(const Mesh& mesh, const Wedge& w, WideVec2 place, double length) {
  const DoubleDouble r = -cross(place, w.right), l = cross(place, w.left), sum = r + l;
  double right = 0, left = 0;  // weights
  if (sum.high > kNoTurn * length * norm(rounded(w.left - w.right))) {
    left = std::clamp((r / sum).high, 0.0, 1.0);
    right = std::clamp((l / sum).high, 0.0, 1.0);
  } else {
    // Along the edge: where the way begins.
    const WideVec2 edge = w.left - w.right;
    left = std::clamp((-dot(w.right, edge) / dot(edge, edge)).high, 0.0, 1.0);
    right = 1 - left;
  }
  const bool forward = mesh.from(w.halfedge) == w.right_vertex;
  SurfacePoint p{Mesh::face_of(w.halfedge), {0, 0, 0}};
  p.weights[w.halfedge % 3] = forward ? right : left;
  p.weights[Mesh::next(w.halfedge) % 3] = forward ? left : right;
  return p;
}

}  // namespace brushfire::windows
