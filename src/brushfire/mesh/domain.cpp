// The mesh with its walls cut out, and the ways there and back.
#include <brushfire/mesh/domain.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/components.h>

#include <algorithm>
#include <numeric>
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

OpenPart open_part(const Domain& domain) {
  const Mesh &whole = domain.mesh(), &open = domain.open();
  const detail::Components components = detail::components_of(open);
  OpenPart part;
  part.closed_faces = whole.face_count() - open.face_count();
  part.components = components.count;
  std::vector<double> area(components.count, 0);
  for (Index f = 0; f < open.face_count(); ++f) {
    area[components.of_vertex[open.faces()[f][0]]] += 0.5 * open.double_area(f) * open.unit() * open.unit();
  }
  const auto largest = std::max_element(area.begin(), area.end());
  part.area = std::accumulate(area.begin(), area.end(), 0.0);
  part.largest_area = area.empty() ? 0 : *largest;
  std::vector<char> on_largest(whole.vertex_count(), false);
  for (Index v = 0; v < open.vertex_count(); ++v) {
    const Index c = components.of_vertex[v];
    if (c != kNoIndex && area.begin() + c == largest) on_largest[domain.vertex(v)] = true;
  }
  for (Index v = 0; v < whole.vertex_count(); ++v) {
    if (whole.corners(v).empty()) continue;
    part.closed_vertices += !domain.is_open(v);
    part.islanders += domain.is_open(v) && !on_largest[v];
  }
  return part;
}

}  // namespace brushfire
