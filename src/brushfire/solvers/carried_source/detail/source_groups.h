// Which vertices march together as sources: groups of neighbours, of the mesh alone.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/carried_source/detail/group_state.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace brushfire::carried_source {

struct SourceGroup {
  std::vector<Index> vertices;  // ascending, at most kGroupLanes; the lane of each
  double spread = 0;            // not less than twice the way along edges from the first to any other, in mesh.unit()
};

// Each component of the surface is cut in halves again and again, each time between two vertices far from each other,
// until no more than kGroupLanes are left. What of such a piece is not close together (what cuts left over here and
// there) is taken apart. A vertex's group depends on the mesh and on which vertices are excluded, on nothing else.
//
// A piece is what is nearer to its pole than to others: the ways along edges from there to all of its vertices stay
// within it. So a cut needs the distances from one end only: those from the pole, the other end, are those of the piece
// that it was cut out of.
class SourceGrouping {
 public:
  // Of those vertices that are in faces and not `excluded` ([vertex_count], or empty).
  SourceGrouping(const Mesh& mesh, std::vector<bool> excluded);

  // The groups that hold the asked vertices, in an order of the surface; of a piece without any nothing is computed. A
  // vertex that has no neighbours close enough is a group by itself. O(V log V) at most, along edges. Once only.
  std::vector<SourceGroup> of(const std::vector<bool>& asked);

 private:
  using Range = std::pair<Index, Index>;  // of order_
  struct Neighbour {
    Index vertex = 0;
    float length = 0;
  };
  // Those that an edge leads to.
  std::span<const Neighbour> neighbours(Index v) const;

  void list_neighbours();
  std::vector<Range> components();
  bool any_asked(Range range, const std::vector<bool>& asked) const;
  Index cut(Range range);
  Index reach_other_end(Range range);
  void stretch(Range range, float length);
  float width_of(Range range, float length) const;
  Index farthest_reached(Range range) const;
  void forget(Range range, std::vector<float>& distance) const;
  void reach(Index start, float width, std::vector<float>& distance);
  void take_apart(Range range, const std::vector<bool>& asked, std::vector<SourceGroup>& groups);
  double close_by(Index vertex) const;
  std::vector<Index> cluster(std::vector<Index>& left, double& spread);

  const Mesh& mesh_;
  std::vector<std::size_t> start_;     // [vertex_count + 1] into neighbours_
  std::vector<Neighbour> neighbours_;  // each edge from either end
  float mean_edge_ = 0;
  std::vector<Index> order_;  // the vertices, piece after piece; within a piece they ascend
  std::vector<Index> piece_;  // [vertex_count]; kNoIndex: not to be passed
  Index pieces_ = 0;
  std::vector<float> from_;  // [vertex_count] from the pole of the piece
  std::vector<float> to_;    // [vertex_count] from its other end; kNowhere between cuts
  BucketQueue queue_;
  std::vector<Index> right_;
  std::vector<std::pair<float, Index>> sides_, heap_;
};

}  // namespace brushfire::carried_source
