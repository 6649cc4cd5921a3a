// How to compute and how right the result has to be: --method, --tolerance, --accuracy, --bound.
#pragma once

#include "command_line.h"

#include <brushfire/solvers/distance.h>

#include <optional>
#include <string>

namespace brushfire::tool {

struct Accuracy {
  std::string method, level, bound;  // as typed; empty: not given
  std::optional<double> tolerance;
};

void add_accuracy(Verb& verb, Accuracy& accuracy);

// Sets method, tolerance and bound. A tolerance, a level or a bound without a method chooses Method::Windows, the one
// that keeps it. Throws Error(InvalidArgument) where they do not fit together.
void apply(const Accuracy& accuracy, DistanceOptions& options);

// The relative error that the method keeps at every vertex; nullopt: it promises none.
std::optional<double> promised_error(const DistanceOptions& options);

std::string name_of(Bound bound);

}  // namespace brushfire::tool
