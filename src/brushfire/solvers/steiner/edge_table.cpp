// One walk around every ring.
#include <brushfire/solvers/steiner/detail/edge_table.h>

namespace brushfire::steiner {

EdgeTable::EdgeTable(const Mesh& mesh) : edge_of_(mesh.halfedge_count(), kNoIndex), offsets_(mesh.vertex_count() + 1) {
  const std::span<const Index> opposite = mesh.opposite();
  const std::span<const Face> faces = mesh.faces();
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (edge_of_[h] != kNoIndex) continue;
    const auto e = static_cast<Index>(halfedge_.size());
    halfedge_.push_back(h);
    ends_.push_back({faces[Mesh::face_of(h)][h % 3], faces[Mesh::face_of(h)][Mesh::next(h) % 3]});
    edge_of_[h] = e;
    for (Index g = opposite[h]; g != h; g = opposite[g]) edge_of_[g] = e;
  }
  const auto for_ends = [&](const auto& body) {
    for (Index e = 0; e < count(); ++e) {
      const auto [a, b] = ends_[e];
      if (a == b) continue;  // a face that names a vertex twice: leads nowhere
      body(a, e);
      body(b, e);
    }
  };
  for_ends([&](Index v, Index) { ++offsets_[v + 1]; });
  for (std::size_t v = 0; v + 1 < offsets_.size(); ++v) offsets_[v + 1] += offsets_[v];
  at_.resize(offsets_.back());
  std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
  for_ends([&](Index v, Index e) { at_[next[v]++] = e; });
}

}  // namespace brushfire::steiner
