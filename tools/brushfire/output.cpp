// A name that cannot be written is the user's slip and not a bad input file, which is what the library's code says.
#include "output.h"

#include <brushfire/core/error.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>

namespace brushfire::tool {
namespace {

template <class Check>
void as_usage_error(const std::string& path, Check&& check) {
  if (path.empty() || path == "-") return;
  try {
    check();
  } catch (const Error& e) {
    throw Error(ErrorCode::InvalidArgument, e.what());
  }
}

}  // namespace

void check_output(const std::string& path) {
  as_usage_error(path, [&] { check_field_format(path); });
}

void check_lines_output(const std::string& path) {
  as_usage_error(path, [&] { check_lines_format(path); });
}

}  // namespace brushfire::tool
