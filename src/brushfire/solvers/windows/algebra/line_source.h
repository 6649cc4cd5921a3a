// A segment that is a source along its whole length: what it is to a point, and where its parallel light goes.
//
// Based on: D. Bommes, L. Kobbelt, Accurate Computation of Geodesic Distance Fields for Polygonal Curves on Triangle
// Meshes, 2007 (sources that are polygons); values that change along the segment are new here.
#pragma once

#include <brushfire/solvers/windows/algebra/curve_segments.h>
#include <brushfire/solvers/windows/algebra/face_shape.h>
#include <brushfire/solvers/windows/algebra/rays.h>
#include <brushfire/solvers/windows/algebra/window.h>

#include <algorithm>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// A segment in a frame, from `begin` on in the direction `along` (a unit vector), with the value sigma + slope t at the
// place t of it. The least of value and straight way to a point is found at a right angle to the segment where the
// slope is 0, else along parallel rays that lean towards the lower end: the front is a line, tilted by asin(slope).
struct LineSource {
  Vec2 begin, along;
  Real length = 0;
  Real sigma = 0, slope = 0;
  Real rise = 1;  // by how much the value grows per unit of distance from the segment's line: cos(asin(slope))

  Vec2 at(Real t) const { return begin + t * along; }
  Vec2 end() const { return at(length); }
  // The unit direction of the rays on one side: 1: to the left of `along`, -1: to the right.
  Vec2 light(int side) const {
    const Real across = side * rise;
    return {slope * along.x - across * along.y, slope * along.y + across * along.x};
  }

  // How a point sees the segment: the least value and where on the segment it comes from; by parallel light, `source`
  // then being the direction back to the segment, or from an end.
  struct Sight {
    Real value;
    Real t;
    WindowKind kind;
    Vec2 source;
  };
  Sight sight_of(Vec2 p) const {
    const Vec2 to_p = p - begin;
    const Real ahead = dot(to_p, along), aside = cross(along, to_p), away = abs(aside);
    // Without a division by `rise`, which may be 0: the foot lies at ahead - away * slope / rise.
    const Real before = rise * ahead - away * slope;
    if (before > 0 && before < rise * length) {
      const Vec2 back = Real{-1} * light(aside >= 0 ? 1 : -1);
      return {sigma + slope * ahead + away * rise, before / rise, WindowKind::Linear, back};
    }
    const Real t = before > 0 ? length : Real{0};
    const Vec2 source = at(t), way = p - source;
    return {sigma + slope * t + length_of(way.x, way.y), t, WindowKind::Circular, source};
  }
};

// In the frame of halfedge k of its face.
inline LineSource line_source_in(const Frame& frame, Index k, const SegmentInFace& s) {
  LineSource line;
  line.begin = in_frame(frame, k, s.from);
  const Vec2 step = in_frame(frame, k, step_between(s.from, s.to));
  line.length = length_of(step.x, step.y);
  line.along = (1 / line.length) * step;
  line.sigma = s.from_value;
  line.slope = std::clamp((s.to_value - s.from_value) / line.length, Real{-1}, Real{1});
  line.rise = sqrt((1 - line.slope) * (1 + line.slope));
  return line;
}

// An interval of an edge, from which parts are cut off.
struct Interval {
  Real low, high;

  bool empty() const { return !(low < high); }
  // Leaves the places x for which the arrow from p (above the edge) to (x,0) does not point to the right of `direction`
  // (sense 1) or to its left (-1).
  void keep_beside(Vec2 p, Vec2 direction, int sense) {
    const Real turn = sense * direction.y;
    if (turn == 0) {
      if (sense * direction.x * p.y > 0) high = low;
      return;
    }
    const Real x = where_ray_leaves(p, direction);
    if (turn < 0) {
      low = std::max(low, x);
    } else {
      high = std::min(high, x);
    }
  }
  // Where the ray from p in this direction, which is not that of the edge, crosses the edge. A place of the edge may be
  // rounded to below it; then a ray that grazes it would begin far behind.
  static Real where_ray_leaves(Vec2 p, Vec2 direction) {
    return p.x - std::max(Real{0}, p.y) * (direction.x / direction.y);
  }
};

// The parallel light on one side as it leaves through the edge of the frame, seen from beyond: in the frame from the
// edge's end to its start. Not visible where none does.
inline Window parallel_light(const LineSource& line, int side, Real edge_length) {
  Window w;
  w.kind = WindowKind::Linear;
  const Vec2 d = line.light(side);
  if (!(d.y < 0)) return w;
  const Real x0 = Interval::where_ray_leaves(line.begin, d), x1 = Interval::where_ray_leaves(line.end(), d);
  const Real low = std::max(Real{0}, std::min(x0, x1)), high = std::min(edge_length, std::max(x0, x1));
  if (!(low < high)) return w;
  w.source = d;
  w.sigma = line.sigma + dot(Vec2{edge_length, 0} - line.begin, d);
  w.b0 = edge_length - high;
  w.b1 = low <= 0 ? edge_length : edge_length - low;
  w.d0 = value_at(w, w.b0);
  w.d1 = value_at(w, w.b1);
  return w;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
