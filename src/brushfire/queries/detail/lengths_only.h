// For queries that know distances and no costs.
#pragma once

#include <brushfire/core/error.h>
#include <brushfire/solvers/distance.h>

#include <string>

namespace brushfire::detail {

// Throws Error(InvalidArgument) where a weighting is among the options: `what` would not be that of the costs.
inline void check_lengths_only(const DistanceOptions& options, const std::string& what) {
  if (!options.weighting) return;
  throw Error(ErrorCode::InvalidArgument, what + " are those of distances; DistanceOptions::weighting is for costs");
}

}  // namespace brushfire::detail
