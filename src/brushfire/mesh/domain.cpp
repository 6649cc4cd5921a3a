// The mesh with its walls cut out, and the ways there and back.
#include <brushfire/mesh/domain.h>

#include <brushfire/core/error.h>

#include <string>
#include <utility>

namespace brushfire {

std::vector<Index> closed_faces(const Mesh& mesh, std::span<const std::uint8_t> open_vertices) {
  if (open_vertices.size() != mesh.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument, "the mask has " + std::to_string(open_vertices.size()) +
                                                " values, the mesh " + std::to_string(mesh.vertex_count()) +
                                                " vertices");
  }
  std::vector<Index> closed;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.faces()[f];
    if (!open_vertices[a] || !open_vertices[b] || !open_vertices[c]) closed.push_back(f);
  }
  return closed;
}

Domain::Domain(Mesh mesh, const Barriers& barriers) : mesh_(std::move(mesh)) {
  if (barriers.vertices.empty() && barriers.faces.empty() && barriers.edges.empty()) return;
  cut_ = std::make_shared<const CutMesh>(brushfire::cut(mesh_, barriers));
}

std::vector<SurfacePoint> Domain::on_open(const SurfacePoint& point) const {
  if (point.is_nowhere()) return {};
  if (cut_) return cut_->from_original(mesh_, point);
  locate(mesh_, point);
  return {point};
}

void Domain::to_mesh(std::span<SurfacePoint> points) const {
  if (!cut_) return;
  // Not checked again as locate() would: these are points that were computed, and the weights of faces stay.
  for (SurfacePoint& p : points) p.face = cut_->original_face[p.face];
}

std::vector<double> Domain::spread(std::span<const double> values) const {
  if (values.size() == open().vertex_count()) return {values.begin(), values.end()};
  if (values.size() != mesh_.vertex_count()) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(values.size()) + " values for " + std::to_string(mesh_.vertex_count()) + " vertices");
  }
  std::vector<double> spread;
  spread.reserve(cut_->original_vertex.size());
  for (const Index v : cut_->original_vertex) spread.push_back(values[v]);
  return spread;
}

}  // namespace brushfire
