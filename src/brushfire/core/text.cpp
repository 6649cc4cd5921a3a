// Numbers in sentences.
#include <brushfire/core/detail/text.h>

#include <array>
#include <cstdio>

namespace brushfire {

std::string number_as_text(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

}  // namespace brushfire
