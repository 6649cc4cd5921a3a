// DistanceOptions from keyword arguments.
#pragma once

#include "bind.h"
#include "interrupt.h"

namespace brushfire::python {

// Runs that end far within a look for signals: below this many faces no thread is started.
inline constexpr Index kBriefFaces = 2000;

// The options that every call takes, as the Python files pass them.
struct CommonOptions {
  std::optional<std::string> method;
  double max_distance = kInfinity;

  DistanceOptions make(Computation& computation) const {
    DistanceOptions options;
    if (method) options.method = method_named(*method);
    options.max_distance = max_distance;
    options.cancel = computation.cancel();
    options.progress = computation.progress();
    return options;
  }
};

}  // namespace brushfire::python
