// Floating-point numbers as text, by the digits of the engine that the module runs in: in place of core/decimal.cpp.
//
// JavaScript, too, writes as few digits as it takes, and the nearest of them; only where it has an exponent is not what
// std::to_chars does, so that the digits are laid out here.
#include <brushfire/core/detail/decimal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace brushfire::detail {
namespace {

// The digits of a positive number as "1e+0" or "1.25e-7": as few as it takes to read it back, as a float or as a
// double. Returns how many characters it wrote.
extern "C" __attribute__((import_module("brushfire"), import_name("digits"))) int brushfire_digits(double value,
                                                                                                   int is_float,
                                                                                                   char* to);

char* copy(const char* from, int count, char* to) { return std::copy_n(from, count, to); }

// `digits` with the point behind the first `whole` of them, of which there may be none or fewer than `whole`.
char* write_fixed(char* to, const char* digits, int count, int whole, double value) {
  if (whole > count) {
    // Exactly, as printf does: these are whole numbers, whose further digits are not zeros.
    char exact[kLongestDecimal];
    return copy(exact, std::snprintf(exact, sizeof exact, "%.0f", value), to);
  }
  if (whole > 0) to = copy(digits, whole, to);
  if (whole == count) return to;
  if (whole <= 0) *to++ = '0';
  *to++ = '.';
  to = std::fill_n(to, std::max(-whole, 0), '0');
  const int written = std::max(whole, 0);
  return copy(digits + written, count - written, to);
}

char* write_with_exponent(char* to, const char* digits, int count, int exponent) {
  *to++ = digits[0];
  if (count > 1) {
    *to++ = '.';
    to = copy(digits + 1, count - 1, to);
  }
  *to++ = 'e';
  *to++ = exponent < 0 ? '-' : '+';
  const int size = std::abs(exponent);
  if (size >= 100) *to++ = static_cast<char>('0' + size / 100);
  *to++ = static_cast<char>('0' + size / 10 % 10);
  *to++ = static_cast<char>('0' + size % 10);
  return to;
}

char* write_positive(char* to, double value, bool is_float) {
  char room[kLongestDecimal], digits[kLongestDecimal];
  const char* const text = room;
  const char* const end = text + brushfire_digits(value, is_float ? 1 : 0, room);
  const char* const e = std::find(text, end, 'e');
  const int count = static_cast<int>(std::copy_if(text, e, digits, [](char c) { return c != '.'; }) - digits);
  int exponent = 0;
  for (const char* c = e + 2; c < end; ++c) exponent = 10 * exponent + (*c - '0');
  if (e[1] == '-') exponent = -exponent;

  const int whole = exponent + 1;
  const int fixed = whole > 0 ? std::max(whole, count) + (count > whole ? 1 : 0) : 2 - whole + count;
  const int with_exponent = count + (count > 1 ? 1 : 0) + (std::abs(exponent) < 100 ? 4 : 5);
  return fixed <= with_exponent ? write_fixed(to, digits, count, whole, value)
                                : write_with_exponent(to, digits, count, exponent);
}

char* write_number(char* to, double value, bool is_float) {
  if (std::isnan(value)) return copy(std::signbit(value) ? "-nan" : "nan", std::signbit(value) ? 4 : 3, to);
  if (std::signbit(value)) *to++ = '-';
  const double size = std::abs(value);
  if (std::isinf(value)) return copy("inf", 3, to);
  if (size > 0) return write_positive(to, size, is_float);
  *to++ = '0';
  return to;
}

}  // namespace

char* write_shortest(char* to, double value) { return write_number(to, value, false); }
char* write_shortest(char* to, float value) { return write_number(to, double{value}, true); }

}  // namespace brushfire::detail
