// A name that cannot be written is the user's slip and not a bad input file, which is what the library's code says.
#include "output.h"

#include <brushfire/core/error.h>
#include <brushfire/io/write_field.h>

namespace brushfire::tool {

void check_output(const std::string& path) {
  if (path.empty() || path == "-") return;
  try {
    check_field_format(path);
  } catch (const Error& e) {
    throw Error(ErrorCode::InvalidArgument, e.what());
  }
}

}  // namespace brushfire::tool
