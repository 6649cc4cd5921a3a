// Fields from files, for the verbs that judge them.
#pragma once

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

}  // namespace brushfire::tool
