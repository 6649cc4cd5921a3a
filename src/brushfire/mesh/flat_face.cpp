// Flat faces and shared points.
#include <brushfire/core/detail/sort.h>
#include <brushfire/mesh/detail/flat_face.h>

#include <brushfire/core/detail/planar.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

// A corner such that the steps along the two edges from it do not cancel each other.
std::size_t largest(const std::array<double, 3>& step) {
  std::size_t k = 0;
  for (const std::size_t i : {1U, 2U}) {
    if (std::abs(step[i]) > std::abs(step[k])) k = i;
  }
  return k;
}

}  // namespace

std::array<Vec2, 3> flat_corners(const Mesh& mesh, Index f) {
  const std::span<const double> l = mesh.lengths().subspan(3 * static_cast<std::size_t>(f), 3);
  const auto base = static_cast<std::size_t>(std::max_element(l.begin(), l.end()) - l.begin());
  std::array<Vec2, 3> corners;
  if (l[base] > 0) {
    corners[(base + 1) % 3] = {l[base], 0};
    corners[(base + 2) % 3] = apex_over_edge(l[base], l[(base + 2) % 3], l[(base + 1) % 3], mesh.double_areas()[f]);
  }
  return corners;
}

Vec2 apex_over(const Mesh& mesh, Index h, Index g) {
  const auto from = [&](Index e) { return mesh.faces()[Mesh::face_of(e)][e % 3]; };
  const bool same_way = g == h || from(g) == from(h);
  const Mesh::FaceGeometry face = mesh.face_geometry(Mesh::face_of(g));
  const double from_first = face.lengths[(same_way ? Mesh::previous(g) : Mesh::next(g)) % 3];
  const double from_second = face.lengths[(same_way ? Mesh::next(g) : Mesh::previous(g)) % 3];
  return apex_over_edge(face.lengths[g % 3], from_first, from_second, face.double_area);
}

Vec2 point_over(const Mesh& mesh, Index h, const std::array<double, 3>& weights) {
  const Vec2 apex = apex_over(mesh, h, h);
  const double ahead = weights[Mesh::next(h) % 3], third = weights[Mesh::previous(h) % 3];
  return {ahead * mesh.length(h) + third * apex.x, third * apex.y};
}

std::array<double, 3> weight_difference(const std::array<double, 3>& from, const std::array<double, 3>& to) {
  const auto k = static_cast<std::size_t>(std::max_element(from.begin(), from.end()) - from.begin());
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  std::array<double, 3> step;
  step[i] = to[i] - from[i];
  step[j] = to[j] - from[j];
  step[k] = -(step[i] + step[j]);
  return step;
}

Vec2 flat_difference(const std::array<Vec2, 3>& corners, const std::array<double, 3>& from,
                     const std::array<double, 3>& to) {
  const std::array<double, 3> step = weight_difference(from, to);
  const std::size_t k = largest(step), i = (k + 1) % 3, j = (k + 2) % 3;
  return step[i] * (corners[i] - corners[k]) + step[j] * (corners[j] - corners[k]);
}

std::vector<Index> faces_at(const Mesh& mesh, const PointLocation& point) {
  std::vector<Index> faces;
  switch (point.on) {
    case PointLocation::On::Vertex:
      for (const Index h : mesh.corners(point.vertex)) faces.push_back(Mesh::face_of(h));
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
      return faces;
    case PointLocation::On::Edge: {
      Index h = point.halfedge;
      do {
        faces.push_back(Mesh::face_of(h));
        h = mesh.opposite()[h];
      } while (h != point.halfedge);
      detail::sort(faces.begin(), faces.end());
      return faces;
    }
    case PointLocation::On::Interior:
      break;
  }
  return {point.face};
}

std::optional<std::array<double, 3>> weights_in(const Mesh& mesh, const PointLocation& point, Index f) {
  if (f == point.face) return point.weights;
  if (point.on == PointLocation::On::Interior) return std::nullopt;
  const Face& t = mesh.faces()[f];
  std::array<double, 3> weights{0, 0, 0};
  const Face& own = mesh.faces()[point.face];
  for (std::size_t k = 0; k < 3; ++k) {
    if (point.weights[k] == 0) continue;
    const auto at = std::find(t.begin(), t.end(), own[k]);
    if (at == t.end()) return std::nullopt;
    weights[static_cast<std::size_t>(at - t.begin())] += point.weights[k];
  }
  return weights;
}

PointLocation on_other_halfedge(const Mesh& mesh, const PointLocation& point, Index halfedge) {
  const Index h = point.halfedge, g = halfedge;
  const bool same_way = mesh.from(g) == mesh.from(h);
  PointLocation there = point;
  there.halfedge = g;
  there.face = Mesh::face_of(g);
  there.weights = {0, 0, 0};
  there.weights[g % 3] = point.weights[(same_way ? h : Mesh::next(h)) % 3];
  there.weights[Mesh::next(g) % 3] = point.weights[(same_way ? Mesh::next(h) : h) % 3];
  there.t = there.weights[Mesh::next(g) % 3];
  return there;
}

Index common_face(const Mesh& mesh, const PointLocation& a, const PointLocation& b, Index preferred) {
  if (preferred != kNoIndex && weights_in(mesh, a, preferred) && weights_in(mesh, b, preferred)) return preferred;
  for (const Index f : faces_at(mesh, a)) {
    if (weights_in(mesh, b, f)) return f;
  }
  return kNoIndex;
}

double distance_within(const Mesh& mesh, Index f, const PointLocation& a, const PointLocation& b) {
  return distance_within(mesh, f, weights_in(mesh, a, f).value(), weights_in(mesh, b, f).value());
}

double distance_within(const Mesh& mesh, Index f, const std::array<double, 3>& a, const std::array<double, 3>& b) {
  if (!mesh.has_positions()) return norm(flat_difference(flat_corners(mesh, f), a, b));
  const std::array<double, 3> step = weight_difference(a, b);
  const std::size_t k = largest(step);
  const double scale = 1 / mesh.unit();
  const Vec3 origin = mesh.positions()[mesh.faces()[f][k]];
  Vec3 sum;
  for (const std::size_t i : {(k + 1) % 3, (k + 2) % 3}) {
    sum = sum + step[i] * (scale * (mesh.positions()[mesh.faces()[f][i]] - origin));
  }
  return norm(sum);
}

}  // namespace brushfire
