// Vertex expansion: the sectors of faces around a vertex that light from it may fill, and the windows they send out.
#pragma once

#include <brushfire/solvers/windows/detail/record.h>
#include <brushfire/solvers/windows/detail/structure.h>

namespace brushfire::detail {

// The part of a face at its corner `corner` between two directions, angles from the edge that leaves the corner
// (halfedge 3 * face + corner) towards the one that enters it.
struct Sector {
  Index face;
  Index corner;
  double from, to;
  double angle;  // of the corner: 0 <= from <= to <= angle
};

// A shadow is lit wider by this on both sides: rounding of angle sums and of the arrival's direction. Whatever it adds
// are real paths.
inline constexpr double kShadowMargin = 1e-12;

// The direction, at the vertex above a ray's halfedge, from which the ray arrives: an angle like those of a Sector.
inline double arrival_angle(const WindowStructure& mesh, const Ray& ray) {
  const WindowFace& f = mesh.faces[ray.halfedge / 3];
  const Index k = ray.halfedge % 3;
  const Frame frame = frame_of(f, k);
  const Vec2 to_a = Vec2{} - frame.apex;
  const Vec2 to_source = ray.source - origin_weight(ray.kind) * frame.apex;
  const double angle = std::atan2(cross(to_a, to_source), dot(to_a, to_source));
  return std::clamp(angle, 0.0, angle_at(f, previous3(k)));
}

// Goes round a vertex, face by face, away from the face `start` over one of its two edges at the vertex; `turned`: the
// angle from the arrival to that edge. Visits the parts of faces between the angles lo and hi from the arrival. The
// vertex' faces form a circle or an arc.
template <class Visit>
void walk_fan(const WindowStructure& mesh, Index vertex, Index start, Index exit, double turned, double lo, double hi,
              Visit&& visit) {
  while (turned < hi) {
    const Index entry = mesh.faces[exit / 3].opposite[exit % 3];
    if (entry == exit || entry / 3 == start) return;
    const Index face = entry / 3;
    const WindowFace& f = mesh.faces[face];
    // Entered over the edge that leaves the vertex: the angle grows as the sector's does; else against it.
    const bool forwards = f.vertex[entry % 3] == vertex;
    const Index corner = forwards ? entry % 3 : next3(entry % 3);
    const double angle = angle_at(f, corner);
    if (turned + angle >= lo) {
      const double from = std::max(0.0, lo - turned), to = std::min(angle, hi - turned);
      visit(forwards ? Sector{face, corner, from, to, angle} : Sector{face, corner, angle - to, angle - from, angle});
    }
    turned += angle;
    exit = 3 * face + (forwards ? previous3(corner) : corner);
  }
}

// L6. The sectors in the shadow of a Saddle or Boundary vertex that a ray has reached: at an angle of pi or more from
// the arrival on both sides (on a boundary, the side that there is). Any one of several shortest arrivals will do: a
// path that goes on shortest from one of them goes on shortest from all.
template <class Visit>
void for_each_shadow(const WindowStructure& mesh, Index vertex, const Ray& arrival, Visit&& visit) {
  const Index start = arrival.halfedge / 3;
  const Index corner = previous3(arrival.halfedge % 3);  // the vertex' own, opposite of the halfedge
  const double angle = arrival_angle(mesh, arrival);
  const double rest = angle_at(mesh.faces[start], corner) - angle;
  const double lo = kPi - kShadowMargin;
  const bool open = mesh.bend[vertex] == Bend::Boundary;
  const double hi = open ? kInfinity : mesh.total_angle[vertex] - kPi + kShadowMargin;
  walk_fan(mesh, vertex, start, 3 * start + previous3(corner), rest, lo, hi, visit);
  if (open) walk_fan(mesh, vertex, start, 3 * start + corner, angle, lo, hi, visit);
}

// The window that light from a sector's corner makes on the edge opposite of the corner, seen from beyond that edge: in
// the frame from the end of halfedge 3 * face + next3(corner) to its start.
inline Window window_of(const WindowFace& f, const Sector& sector, double sigma) {
  const Index i = sector.corner;
  const double near = f.length[i], far = f.length[previous3(i)], length = f.length[next3(i)];
  // A ray at angle t from the near edge divides the opposite edge as near sin(t) : far sin(angle - t).
  const auto place = [&](double t) {
    const double a = near * std::sin(t), b = far * std::sin(sector.angle - t);
    return a + b > 0 ? length * (b / (a + b)) : length;
  };
  Window w;
  const Vec2 corner = apex_over_edge(length, far, near, f.double_area);
  w.source = {corner.x, -corner.y};
  w.sigma = sigma;
  w.b0 = sector.to >= sector.angle ? 0 : place(sector.to);
  w.b1 = sector.from <= 0 ? length : place(sector.from);
  w.d0 = w.b0 <= 0 ? sigma + far : value_at(w, w.b0);
  w.d1 = w.b1 >= length ? sigma + near : value_at(w, w.b1);
  return w;
}

}  // namespace brushfire::detail
