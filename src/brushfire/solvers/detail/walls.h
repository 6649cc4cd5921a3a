// Runs in a domain with walls: the sources and targets go to the open mesh, what was found comes back.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>

#include <span>
#include <vector>

namespace brushfire::detail {

class WalledRun {
 public:
  // Throws Error(InvalidArgument) for a source that lies behind a wall, and as locate() does.
  WalledRun(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options);

  std::span<const Source> sources() const { return sources_; }  // on domain.open()
  const DistanceOptions& options() const { return options_; }   // with the targets on domain.open()
  // Which of the caller's a source on domain.open() is.
  Index origin(Index source) const { return source == kNoIndex ? kNoIndex : origin_[source]; }
  // Those of one of the caller's.
  std::span<const Source> sides_of(std::size_t source) const;

  void bring_back(DistanceField& field) const;
  void bring_back(SparseField& field) const;

 private:
  void bring_targets_back(std::vector<double>& distance, std::vector<Index>& source) const;

  const Domain& domain_;
  std::vector<Source> sources_;
  std::vector<Index> origin_;              // [sources_] which of the caller's each one is: ascending
  std::vector<std::size_t> target_start_;  // [caller's targets + 1] where those of each begin
  DistanceOptions options_;
};

}  // namespace brushfire::detail
