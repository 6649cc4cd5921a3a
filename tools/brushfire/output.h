// Where a verb's -o goes.
#pragma once

#include <string>

namespace brushfire::tool {

// Says, before anything is computed, that nothing is written under such a name. Throws Error(InvalidArgument).
void check_output(const std::string& path);

}  // namespace brushfire::tool
