// A weighted run that answers as distance() does.
#pragma once

#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/steiner/weighting.h>

#include <span>

namespace brushfire::steiner {

// The field of options.weighting, in a solver's domain. Throws Error(InvalidArgument) where that is another one than
// the weighting's, where windows are to be kept, and where lower bounds are asked for of slopes; and what the run
// throws.
DistanceField run_as_distance(WeightedSolver& solver, const Domain& domain, std::span<const Source> sources,
                              const DistanceOptions& options);
// The reached vertices of it alone.
SparseField reached_of(DistanceField field);

}  // namespace brushfire::steiner
