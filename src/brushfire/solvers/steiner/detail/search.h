// Shortest paths in the graph of the points on edges, from any sources, in order of value.
// Based on: Lanthier, Maheshwari, Sack (2001), Approximating shortest paths on weighted polyhedral surfaces.
#pragma once

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/progress.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/steiner/detail/places.h>
#include <brushfire/solvers/steiner/detail/relax.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::steiner {

struct SearchLimits {
  double max_value = kInfinity;              // in units of the front
  std::span<const PointLocation> targets{};  // where there are any, it is over once all are final
  Progress progress{};                       // called with shares of this search
};

// A front that has reached nothing.
Front unreached(const WeightedMesh& mesh, const PointLayout& layout);

class Search {
 public:
  // `towards`: sources are where one goes to, which tells a difference where slopes count. Those are for real costs
  // only.
  Search(const WeightedMesh& mesh, const PointLayout& layout, Costs costs, bool towards = false);

  // Polls what the thread listens to. The sources' offsets are >= 0.
  void run(std::span<const detail::LocatedSource> sources, const SearchLimits& limits);
  // Goes on from a front whose values are those of real paths: these rows are sent again, whole, and the sources start.
  void resume(Front front, std::span<const detail::LocatedSource> sources, std::span<const Index> rows,
              const SearchLimits& limits);
  // After a run: at any place. O(points on the rows of its faces).
  ValueAt at(const PointLocation& place) const { return places_.value(front_, sources_, place); }
  const Front& front() const { return front_; }
  Front take() { return std::move(front_); }

 private:
  void start(const detail::LocatedSource& source, Index number);
  void reach(Index v, double value, Index parent, Index except);
  void improve(Index edge, Index j, double value, Index parent);
  void mark(Index edge, Index j, double value);
  void send(Index edge);
  void sweep(Index edge, Index& first, Index& last);
  void send_into_face(const FaceOver& over, const Offering& from);
  void send_to_row(const FaceOver& over, Index target, const Offering& from);
  void take_offers(Index offering_row, Index target);
  void find_lower_terms(const FaceOver& over, Index target, const Receiving& to);
  void cross(Index edge, Index first, Index last);
  bool targets_are_final(std::span<const PointLocation> targets, std::size_t& done) const;

  Index end_of(Index edge, bool last) const { return places_.end_of(edge, last); }

  const WeightedMesh& mesh_;
  const PointLayout& layout_;
  Costs costs_;
  Travel travel_;
  Places places_;
  std::span<const Index> opposite_;
  std::span<const detail::LocatedSource> sources_;
  double width_ = 1;  // of a bucket
  BucketQueue queue_;
  Front front_;
  std::vector<Index> first_, last_;           // [edges] what has changed since the row was last sent
  std::vector<BucketQueue::Bucket> waiting_;  // [edges] the bucket it waits in
  Offers offers_;
  LowerTerms near_, far_;
};

}  // namespace brushfire::steiner
