// What brushfire distance and brushfire path do where weights are given.
#pragma once

#include "output.h"
#include "surface.h"
#include "talk.h"
#include "weights.h"

#include <string>
#include <vector>

namespace brushfire::tool {

struct WeightedRequest {
  std::string file, output;
  const SharedArguments& shared;
  std::vector<std::string> targets;  // places
  int refinements = 0;               // of bounds
};

int weighted_distance(const WeightedRequest& request, const Talk& talk);
int weighted_path(const WeightedRequest& request, LinesOptions drawing, const Talk& talk);

}  // namespace brushfire::tool
