// brushfire compare: how far one field is from another.
#include "command_line.h"

namespace brushfire::tool {
void add_compare(CommandLine&) {}
}  // namespace brushfire::tool
