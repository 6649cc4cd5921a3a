// Which vertices march together as sources: groups of neighbours, of the mesh alone.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/carried_source/detail/group_state.h>

#include <span>
#include <utility>
#include <vector>

namespace brushfire::carried_source {

struct SourceGroup {
  std::vector<Index> vertices;  // ascending, at most kGroupLanes; the lane of each
  double spread = 0;            // not less than twice the way along edges from the first to any other, in mesh.unit()
};

// The surface is cut in halves again and again, each time between two vertices far from each other, until no more than
// kGroupLanes are left. What of such a piece is not close together (what cuts left over here and there, other
// components) is taken apart. A vertex's group depends on the mesh and on which vertices are excluded, on nothing else.
class SourceGrouping {
 public:
  // Of those vertices that are in faces and not `excluded` ([vertex_count], or empty).
  SourceGrouping(const Mesh& mesh, std::vector<bool> excluded);

  // The groups that hold the asked vertices, in an order of the surface; of a piece without any nothing is computed. A
  // vertex that has no neighbours close enough is a group by itself. O(V log V) at most, along edges.
  std::vector<SourceGroup> of(const std::vector<bool>& asked);

 private:
  using Range = std::pair<Index, Index>;  // of order_

  bool any_asked(Range range, const std::vector<bool>& asked) const;
  Index cut(Range range);
  Index farthest(Index start, Range range, std::vector<float>& distance);
  void take_apart(Range range, const std::vector<bool>& asked, std::vector<SourceGroup>& groups);
  double close_by(Index vertex) const;
  std::vector<Index> cluster(std::vector<Index>& left, double& spread);

  const Mesh& mesh_;
  std::vector<Index> order_;  // the vertices, piece after piece; within a piece they ascend
  std::vector<Index> piece_;  // [vertex_count]
  Index pieces_ = 0;
  std::vector<float> from_, to_;  // [vertex_count]
  std::vector<std::pair<float, Index>> sides_, heap_;
};

}  // namespace brushfire::carried_source
