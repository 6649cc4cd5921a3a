// Floating-point numbers as text.
//
// In a file of its own, decimal.cpp: the tables behind std::to_chars are 125 kB, and the package for JavaScript has
// these functions by the engine that it runs in (js/src/decimal.cpp is linked in the place of that file).
#pragma once

namespace brushfire::detail {

inline constexpr int kLongestDecimal = 32;

// As few digits as it takes to read the same number back, with an exponent where that is shorter: "0.1", "1e+22",
// "-inf", "nan". Writes at most kLongestDecimal characters from `to` and returns their end.
char* write_shortest(char* to, double value);
char* write_shortest(char* to, float value);

}  // namespace brushfire::detail
