// DistanceOptions from what the Python files pass: a dict of those that the caller gave.
#pragma once

#include "bind.h"
#include "interrupt.h"

#include <brushfire/core/error.h>

#include <initializer_list>
#include <string_view>

namespace brushfire::python {

// Runs that end far within a look for signals: below this many faces no thread is started.
inline constexpr Index kBriefFaces = 2000;

// Keys: method, bound, precision (strings), tolerance, max_distance (floats), threads (int); the Python files have
// checked the types. Throws unknown_key().
DistanceOptions options_from(const nb::dict& given, Computation& computation);

// For a dict of options that has a key which nothing reads.
Error unknown_key(std::string_view name);
// Throws it unless all keys are among those.
void require_known(const nb::dict& given, std::initializer_list<std::string_view> known);

}  // namespace brushfire::python
