// Fields from files: those that are judged, and those of --scalar.
#pragma once

#include "surface.h"

#include <brushfire/io/read_field.h>

#include <cstddef>
#include <string>
#include <vector>

namespace brushfire::tool {

// One value for each of `count` vertices; infinity where the file names vertices and leaves this one out. A field and
// its mesh, or another field, come from different runs: Error(InvalidArgument) says which file does not fit `beside`,
// and how.
std::vector<double> values_of(const LoadedField& loaded, const std::string& path, std::size_t count,
                              const std::string& beside);

// The values of a file (the array `name`), on the vertices of surface.mesh().
std::vector<double> values_on(const Surface& surface, const std::string& path, const std::string& name);

// What a verb shows: the values of --scalar, or distances. Throws Error(InvalidArgument) where both are asked for, or
// neither is.
void check_scalar_or_source(const SharedArguments& arguments);

}  // namespace brushfire::tool
