// Shortest paths in the graph of the points on edges, from any sources, in order of value.
// Based on: Lanthier, Maheshwari, Sack (2001), Approximating shortest paths on weighted polyhedral surfaces.
#pragma once

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/progress.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/steiner/detail/point_layout.h>
#include <brushfire/solvers/steiner/detail/relax.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::steiner {

// Of real paths, whose costs are nowhere below the distance; or lowered (lower_costs.h) to be nowhere above it.
enum class Costs : std::uint8_t { Real, Below };

// Where a value comes from: a point of the layout, or kFromSource + position in the list of sources.
inline constexpr Index kFromSource = Index{1} << 31;

// In mesh.unit() times weight, from the least offset of a source on. Copies of a vertex at the ends of rows agree.
struct Front {
  std::vector<double> value;  // [layout.size()]
  std::vector<Index> parent;  // [layout.size()] kNoIndex: not reached. At ends of rows that of vertex_parent counts
  std::vector<double> vertex_value;
  std::vector<Index> vertex_parent;
  double horizon = kInfinity;  // values up to this are final
  std::uint64_t rows_sent = 0;
};

struct ValueAt {
  double value = kInfinity;
  Index parent = kNoIndex;
};

struct SearchLimits {
  double max_value = kInfinity;              // in units of the front
  std::span<const PointLocation> targets{};  // where there are any, it is over once all are final
  Progress progress{};                       // called with shares of this search
};

class Search {
 public:
  Search(const WeightedMesh& mesh, const PointLayout& layout, Costs costs);

  // Polls what the thread listens to. The sources' offsets are >= 0.
  void run(std::span<const detail::LocatedSource> sources, const SearchLimits& limits);
  // After a run: at any place. O(points on the rows of its faces).
  ValueAt at(const PointLocation& place) const;
  const Front& front() const { return front_; }
  Front take() { return std::move(front_); }

 private:
  // A face over an edge that is sent: where its third corner lies in the frame of the edge.
  struct Over {
    Index edge = kNoIndex, face = kNoIndex;
    Index start = kNoIndex, end = kNoIndex;  // the edge's vertices
    double length = 0;
    Vec2 apex;
  };
  // Where a place is in the frame of an edge beside it, or under it.
  struct Beside {
    Index edge = kNoIndex;
    double weight = 0;
    Vec2 place;
    bool under = false;
    double rounding = 0;  // of distances from it
  };

  void start(const detail::LocatedSource& source, Index number);
  std::vector<Beside> beside(const PointLocation& place) const;
  void add_beside(Index h, const PointLocation& place, std::vector<Beside>& rows) const;
  ValueAt straight_from_sources(const PointLocation& place) const;
  Over over(Index h) const;
  double cost_to(const Beside& row, Index i) const;
  void reach(Index v, double value, Index parent, Index except);
  void improve(Index edge, Index j, double value, Index parent);
  void mark(Index edge, Index j, double value);
  void send(Index edge);
  void sweep(Index edge, Index& first, Index& last);
  void step(Index edge, Index from, Index to, double cost, Index& first, Index& last);
  void send_into_face(const Over& over, Index first, Index last);
  void send_to_row(const Over& over, Index target, Index first, Index last);
  void find_lower_terms(const Over& over, Index target, const Receiving& to);
  void cross(Index edge, Index first, Index last);
  bool targets_are_final(std::span<const PointLocation> targets, std::size_t& done) const;

  Index end_of(Index edge, bool last) const {
    const Index h = mesh_.edges().halfedge(edge);
    return last ? mesh_.mesh().to(h) : mesh_.mesh().from(h);
  }

  const WeightedMesh& mesh_;
  const PointLayout& layout_;
  Costs costs_;
  std::span<const detail::LocatedSource> sources_;
  double width_ = 1;  // of a bucket
  BucketQueue queue_;
  Front front_;
  std::vector<Index> first_, last_;             // [edges] what has changed since the row was last sent
  std::vector<BucketQueue::Bucket> waiting_;    // [edges] the bucket it waits in
  Offers offers_;
  LowerTerms near_, far_;
};

}  // namespace brushfire::steiner
