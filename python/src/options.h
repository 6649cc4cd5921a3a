// DistanceOptions from what the Python files pass: a dict of those that the caller gave.
#pragma once

#include "bind.h"
#include "interrupt.h"

#include <string_view>

namespace brushfire::python {

// Runs that end far within a look for signals: below this many faces no thread is started.
inline constexpr Index kBriefFaces = 2000;

// Keys: method, bound, precision (strings), tolerance, max_distance (floats), threads (int); the Python files have
// checked the types.
DistanceOptions options_from(const nb::dict& given, Computation& computation);

}  // namespace brushfire::python
