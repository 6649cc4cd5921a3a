// The edges of a mesh, numbered: halfedges that lie in one ring are one edge.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <span>
#include <vector>

namespace brushfire::steiner {

// An edge runs the way of the lowest halfedge of its ring. O(halfedges); 12 bytes a halfedge.
class EdgeTable {
 public:
  explicit EdgeTable(const Mesh& mesh);

  Index count() const { return static_cast<Index>(halfedge_.size()); }
  Index edge(Index h) const { return edge_of_[h]; }
  Index halfedge(Index e) const { return halfedge_[e]; }
  // The edges that a vertex is an end of.
  std::span<const Index> at(Index v) const { return {at_.data() + offsets_[v], offsets_[v + 1] - offsets_[v]}; }

 private:
  std::vector<Index> edge_of_;   // [halfedges]
  std::vector<Index> halfedge_;  // [edges] the lowest
  std::vector<Index> offsets_, at_;
};

}  // namespace brushfire::steiner
