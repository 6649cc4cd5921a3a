// Numbers as other languages spell them.
#include <brushfire/io/detail/text.h>

#include <algorithm>
#include <limits>

namespace brushfire::detail {

namespace {

// What stands behind "1.#" where Microsoft's C library has no number to print.
bool read_microsoft_name(std::string_view name, double& value) {
  const std::string_view letters = name.substr(0, name.find_first_of("0123456789"));  // the precision pads with digits
  if (letters == "INF") {
    value = kInfinity;
  } else if (letters == "IND" || letters == "QNAN" || letters == "SNAN") {
    value = std::numeric_limits<double>::quiet_NaN();
  } else {
    return false;
  }
  return true;
}

}  // namespace

bool read_foreign_number(std::string_view word, double& value) {
  const bool has_sign = !word.empty() && (word[0] == '-' || word[0] == '+');
  const bool is_negative = has_sign && word[0] == '-';
  if (has_sign) word.remove_prefix(1);
  if (word.substr(0, 3) == "1.#") {
    if (!read_microsoft_name(word.substr(3), value)) return false;
  } else {
    constexpr std::size_t kLongest = 64;  // digits beyond those of a double come from no Fortran program
    if (word.empty() || word.size() > kLongest || word[0] == '-' || word[0] == '+') return false;
    std::string text(word);
    const std::size_t exponent = text.find_first_of("dD");
    if (exponent == std::string::npos || exponent + 1 == text.size()) return false;
    text[exponent] = 'e';
    const auto result = fast_float::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return false;
  }
  if (is_negative) value = -value;
  return true;
}

}  // namespace brushfire::detail
