// Angles at a point by the first pieces of paths.
#include <brushfire/queries/detail/leaving_angles.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

double direction_of(Vec2 v) { return std::atan2(v.y, v.x); }

double wrapped(double angle, double turn) {
  const double a = std::fmod(angle, turn);
  return a < 0 ? a + turn : a;
}

}  // namespace

LeavingAngles::LeavingAngles(const Mesh& mesh, const SurfacePoint& source)
    : mesh_(mesh), source_(locate(mesh, source)) {
  if (at_vertex()) fan_ = tangent_fan(mesh, source_.vertex);
}

LeavingAngles::LeavingAngles(const Mesh& mesh, const SurfacePoint& vertex, Index face)
    : mesh_(mesh), source_(locate(mesh, vertex)) {
  for (Index h = 3 * face; h < 3 * face + 3; ++h) {
    if (mesh.from(h) == source_.vertex) fan_ = tangent_fan_of(mesh, h);
  }
}

// Of a leg; of one that does not start at the source, nothing.
windows::TracedRays::Angle LeavingAngles::of(const WindowField::Leg& leg) const {
  if (leg.points.size() < 2 || (leg.vertex != kNoIndex && !is_source(leg.vertex))) return {};
  return {towards(leg.points[leg.points.size() - 2]), sense_in(leg.points.back().face)};
}

// An angle within the full turn.
double LeavingAngles::within_turn(double angle) const {
  constexpr double kNoTurn = 1e-14;  // what rounding takes an angle below 0 by: not a full turn
  if (at_vertex() && !fan_.closed) return std::clamp(angle, 0.0, fan_.total);
  return angle < 0 && angle > -kNoTurn ? 0 : wrapped(angle, total());
}

double LeavingAngles::towards(const SurfacePoint& point) const {
  const PointLocation next = locate(mesh_, point);
  const Index f = common_face(mesh_, source_, next, source_.face);
  const std::array<Vec2, 3> c = flat_corners(mesh_, f);
  const std::array<double, 3> own = *weights_in(mesh_, source_, f);
  const Vec2 d = flat_difference(c, own, *weights_in(mesh_, next, f));
  if (at_vertex()) {
    const auto k = static_cast<Index>(std::max_element(own.begin(), own.end()) - own.begin());
    return in_corner(3 * f + k, d, c);
  }
  return f == source_.face ? wrapped(direction_of(d) - base_direction(), 2 * kPi) : over_own_edge(f, c, d);
}

std::vector<double> LeavingAngles::all_towards(const SurfacePoint& point) const {
  const PointLocation next = locate(mesh_, point);
  std::vector<double> angles;
  for (const FanCorner& at : fan_.corners) {
    const Index f = Mesh::face_of(at.corner);
    const auto there = weights_in(mesh_, next, f);
    if (!there) continue;
    const std::array<Vec2, 3> c = flat_corners(mesh_, f);
    angles.push_back(in_corner(at.corner, flat_difference(c, *weights_in(mesh_, source_, f), *there), c));
  }
  return angles;
}

std::vector<Index> LeavingAngles::borders() const {
  if (closed() || fan_.corners.empty()) return {};
  const FanCorner &first = fan_.corners.front(), &last = fan_.corners.back();
  const auto end = [&](Index corner, bool before) {
    return before ? mesh_.from(Mesh::previous(corner)) : mesh_.to(corner);
  };
  return {end(first.corner, first.reversed), end(last.corner, !last.reversed)};
}

double LeavingAngles::in_corner(Index corner, Vec2 d, const std::array<Vec2, 3>& c) const {
  const Vec2 edge = c[Mesh::next(corner) % 3] - c[corner % 3];
  return fan_.around(corner, std::clamp(std::atan2(cross(edge, d), dot(edge, d)), 0.0, mesh_.corner_angle(corner)));
}

// 1 where angles grow counter-clockwise in the face, which holds the source; -1 where clockwise.
double LeavingAngles::sense_in(Index face) const {
  if (!at_vertex()) return face == source_.face || !runs_as_own(halfedge_in(face)) ? 1 : -1;
  const auto at = std::find_if(fan_.corners.begin(), fan_.corners.end(),
                               [&](const FanCorner& c) { return Mesh::face_of(c.corner) == face; });
  return at == fan_.corners.end() || !at->reversed ? 1 : -1;
}

// The halfedge along the source's edge in another face.
Index LeavingAngles::halfedge_in(Index face) const {
  Index in = mesh_.opposite()[source_.halfedge];
  while (Mesh::face_of(in) != face) in = mesh_.opposite()[in];
  return in;
}

double LeavingAngles::base_direction() const {
  const std::array<Vec2, 3> corners = flat_corners(mesh_, source_.face);
  return direction_of(corners[1] - corners[0]);
}

// Over the source's own edge into face f: measured from the edge, which both faces have.
double LeavingAngles::over_own_edge(Index f, const std::array<Vec2, 3>& c, Vec2 d) const {
  const Index in = halfedge_in(f);
  const Vec2 in_edge = c[Mesh::next(in) % 3] - c[in % 3];
  const double above = std::atan2(cross(in_edge, d), dot(in_edge, d));  // into f, in [0, pi]
  const std::array<Vec2, 3> own_corners = flat_corners(mesh_, source_.face);
  const Vec2 own_edge = own_corners[Mesh::next(source_.halfedge) % 3] - own_corners[source_.halfedge % 3];
  // Below the edge in the source's face's plane, whichever way round the other face lies.
  const double from_edge = runs_as_own(in) ? -above : above - kPi;
  return wrapped(direction_of(own_edge) + from_edge - base_direction(), 2 * kPi);
}

Vec2 LeavingAngles::vector(double angle, double length) const {
  if (at_vertex() && fan_.closed) angle *= 2 * kPi / fan_.total;
  return {length * std::cos(angle), length * std::sin(angle)};
}

std::pair<double, double> LeavingAngles::polar(Vec2 v) const {
  const double angle = wrapped(direction_of(v), 2 * kPi), length = norm(v);
  if (!at_vertex()) return {angle, length};
  if (fan_.closed) return {angle * fan_.total / (2 * kPi), length};
  if (angle <= fan_.total) return {angle, length};
  // Outside: what is left of it along the nearer end of the border.
  const double beyond = angle - fan_.total, before = 2 * kPi - angle;
  const double off = std::min(beyond, before);
  return {beyond < before ? fan_.total : 0, length * std::max(0.0, std::cos(off))};
}

}  // namespace brushfire::detail
