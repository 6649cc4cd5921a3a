// Floating-point numbers as text, by the standard library.
#include <brushfire/core/detail/decimal.h>

#include <charconv>

namespace brushfire::detail {

char* write_shortest(char* to, double value) { return std::to_chars(to, to + kLongestDecimal, value).ptr; }
char* write_shortest(char* to, float value) { return std::to_chars(to, to + kLongestDecimal, value).ptr; }

}  // namespace brushfire::detail
