// Flat faces and shared points.
#include <brushfire/mesh/flat_face.h>

#include <brushfire/core/planar.h>

#include <algorithm>

namespace brushfire {

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

Vec2 flat_difference(const std::array<Vec2, 3>& corners, const std::array<double, 3>& from,
                     const std::array<double, 3>& to) {
  // Weights sum to one, so two of the three differences are enough, and a common corner far away does not matter.
  return (to[1] - from[1]) * (corners[1] - corners[0]) + (to[2] - from[2]) * (corners[2] - corners[0]);
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
      std::sort(faces.begin(), faces.end());
      return faces;
    }
    case PointLocation::On::Interior:
      break;
  }
  return {point.face};
}

std::optional<std::array<double, 3>> weights_in(const Mesh& mesh, const PointLocation& point, Index f) {
  if (f == point.face) return point.weights;
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

Index common_face(const Mesh& mesh, const PointLocation& a, const PointLocation& b, Index preferred) {
  if (preferred != kNoIndex && weights_in(mesh, a, preferred) && weights_in(mesh, b, preferred)) return preferred;
  for (const Index f : faces_at(mesh, a)) {
    if (weights_in(mesh, b, f)) return f;
  }
  return kNoIndex;
}

double distance_within(const Mesh& mesh, Index f, const PointLocation& a, const PointLocation& b) {
  return norm(flat_difference(flat_corners(mesh, f), weights_in(mesh, a, f).value(), weights_in(mesh, b, f).value()));
}

}  // namespace brushfire
