// Angles at a point by the first pieces of paths.
#include <brushfire/queries/detail/leaving_angles.h>

#include <brushfire/mesh/detail/flat_face.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

using On = PointLocation::On;

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

double LeavingAngles::towards(const SurfacePoint& point) const {
  const PointLocation next = locate(mesh_, point);
  const Index f = common_face(mesh_, source_, next, source_.face);
  const std::array<Vec2, 3> c = flat_corners(mesh_, f);
  const std::array<double, 3> own = *weights_in(mesh_, source_, f);
  const Vec2 d = flat_difference(c, own, *weights_in(mesh_, next, f));
  if (at_vertex()) {
    const auto k = static_cast<Index>(std::max_element(own.begin(), own.end()) - own.begin());
    const Vec2 edge = c[(k + 1) % 3] - c[k];
    const double inside = std::clamp(std::atan2(cross(edge, d), dot(edge, d)), 0.0, mesh_.corner_angle(3 * f + k));
    return fan_.around(3 * f + k, inside);
  }
  return f == source_.face ? wrapped(direction_of(d) - base_direction(), 2 * kPi) : over_own_edge(f, c, d);
}

double LeavingAngles::base_direction() const {
  const std::array<Vec2, 3> corners = flat_corners(mesh_, source_.face);
  return direction_of(corners[1] - corners[0]);
}

// Over the source's own edge into face f: measured from the edge, which both faces have.
double LeavingAngles::over_own_edge(Index f, const std::array<Vec2, 3>& c, Vec2 d) const {
  Index in = mesh_.opposite()[source_.halfedge];
  while (Mesh::face_of(in) != f) in = mesh_.opposite()[in];
  const Vec2 in_edge = c[Mesh::next(in) % 3] - c[in % 3];
  const double above = std::atan2(cross(in_edge, d), dot(in_edge, d));  // into f, in [0, pi]
  const bool same_start = mesh_.from(in) == mesh_.from(source_.halfedge);
  const std::array<Vec2, 3> own_corners = flat_corners(mesh_, source_.face);
  const Vec2 own_edge = own_corners[Mesh::next(source_.halfedge) % 3] - own_corners[source_.halfedge % 3];
  // Below the edge in the source's face's plane, whichever way round the other face lies.
  const double from_edge = same_start ? -above : above - kPi;
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
