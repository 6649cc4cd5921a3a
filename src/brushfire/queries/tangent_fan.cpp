// Walking around a vertex.
#include <brushfire/queries/detail/tangent_fan.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <string>

namespace brushfire::detail {
namespace {

Index first_usable_corner(const Mesh& mesh, Index vertex) {
  const auto corners = mesh.corners(vertex);
  const auto first =
      std::find_if(corners.begin(), corners.end(), [&](Index h) { return mesh.is_face_usable(Mesh::face_of(h)); });
  return first == corners.end() ? kNoIndex : *first;
}

// An open fan begins at the corner with a boundary edge: the lower of the two.
FanCorner first_corner(const Mesh& mesh, Index vertex, bool closed) {
  if (closed) return {first_usable_corner(mesh, vertex), false, 0, 0};
  const auto opposite = mesh.opposite();
  for (const Index h : mesh.corners(vertex)) {
    if (!mesh.is_face_usable(Mesh::face_of(h))) continue;
    if (opposite[h] == h) return {h, false, 0, 0};
    if (const Index back = Mesh::previous(h); opposite[back] == back) return {h, true, 0, 0};
  }
  return {};
}

// From corner to corner over edges of two faces, as far as they go.
TangentFan fan_from(const Mesh& mesh, FanCorner c) {
  TangentFan fan;
  const auto opposite = mesh.opposite();
  const Index vertex = mesh.from(c.corner), first = c.corner;
  while (true) {
    c.start = fan.total;
    c.angle = mesh.corner_angle(c.corner);
    fan.total += c.angle;
    fan.corners.push_back(c);
    const Index exit = c.reversed ? c.corner : Mesh::previous(c.corner);
    const Index entry = opposite[exit];
    if (entry == exit || opposite[entry] != exit) return fan;
    // An entry that starts at the vertex is the next corner itself.
    const bool starts_here = mesh.from(entry) == vertex;
    c = {starts_here ? entry : Mesh::next(entry), !starts_here, 0, 0};
    if (c.corner == first) break;
  }
  fan.closed = true;
  return fan;
}

}  // namespace

double TangentFan::around(Index corner, double inside) const {
  const auto at = std::find_if(corners.begin(), corners.end(), [&](const FanCorner& c) { return c.corner == corner; });
  return at->start + (at->reversed ? at->angle - inside : inside);
}

std::pair<Index, double> TangentFan::at(double angle) const {
  // The last corner that begins at or before the angle.
  auto next =
      std::upper_bound(corners.begin(), corners.end(), angle, [](double a, const FanCorner& c) { return a < c.start; });
  const FanCorner& c = next == corners.begin() ? corners.front() : *(next - 1);
  const double inside = std::clamp(angle - c.start, 0.0, c.angle);
  return {c.corner, c.reversed ? c.angle - inside : inside};
}

TangentFan tangent_fan(const Mesh& mesh, Index vertex) {
  const Link link = mesh.links()[vertex];
  if (link != Link::Circle && link != Link::Arc) {
    throw Error(ErrorCode::InvalidArgument, "the faces at vertex " + std::to_string(vertex) +
                                                " form neither a circle nor an arc: directions there have no angle");
  }
  const FanCorner first = first_corner(mesh, vertex, link == Link::Circle);
  return first.corner == kNoIndex ? TangentFan{} : fan_from(mesh, first);
}

TangentFan tangent_fan_of(const Mesh& mesh, Index corner) {
  const TangentFan backwards = fan_from(mesh, {corner, true, 0, 0});
  if (backwards.closed) return fan_from(mesh, {corner, false, 0, 0});
  const FanCorner& end = backwards.corners.back();
  return fan_from(mesh, {end.corner, !end.reversed, 0, 0});
}

}  // namespace brushfire::detail
