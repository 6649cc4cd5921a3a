// The edges of a mesh, numbered: halfedges that lie in one ring are one edge.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire::steiner {

// An edge runs the way of the lowest halfedge of its ring. O(halfedges); 16 bytes a halfedge.
class EdgeTable {
 public:
  explicit EdgeTable(const Mesh& mesh);

  Index count() const { return static_cast<Index>(halfedge_.size()); }
  Index edge(Index h) const { return edge_of_[h]; }
  Index halfedge(Index e) const { return halfedge_[e]; }
  Index end(Index e, bool last) const { return ends_[e][last ? 1 : 0]; }  // its first vertex, or its last
  // The edges that a vertex is an end of.
  std::span<const Index> at(Index v) const { return {at_.data() + offsets_[v], offsets_[v + 1] - offsets_[v]}; }

 private:
  std::vector<Index> edge_of_;   // [halfedges]
  std::vector<Index> halfedge_;  // [edges] the lowest
  std::vector<std::array<Index, 2>> ends_;
  std::vector<Index> offsets_, at_;
};

}  // namespace brushfire::steiner
