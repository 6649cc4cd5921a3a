// Costs in place of distances, as a DistanceSolver sees them: of what computes them it knows nothing, and programs
// without weights link none of it.
#pragma once

#include <brushfire/solvers/distance.h>

#include <span>

namespace brushfire::detail {

// The runs of one thread.
class CostRuns {
 public:
  virtual ~CostRuns() = default;

  // The field of options.weighting, in a solver's domain. Throws Error(InvalidArgument) where that is another one than
  // the weighting's, where windows are to be kept, and where lower bounds are asked for of slopes; and what the run
  // throws.
  virtual DistanceField operator()(const Domain& domain, std::span<const Source> sources,
                                   const DistanceOptions& options) = 0;
};

}  // namespace brushfire::detail
