// Where a verb's -o goes.
#pragma once

#include <string>

namespace brushfire::tool {

// Say, before anything is computed, that no field (no curves) can be written under such a name. Throw
// Error(InvalidArgument).
void check_output(const std::string& path);
void check_lines_output(const std::string& path);

}  // namespace brushfire::tool
