// DoubleDouble: a number as the sum of two doubles, 106 bits wide, where 53 do not tell on which side a ray passes.
//
// Based on: Dekker, "A floating-point technique for extending the available precision", 1971; Hida, Li, Bailey,
// "Library for double-double and quad-double arithmetic", 2007. Wrong under -ffast-math. Exponents are those of double.
#pragma once

#include <cmath>

namespace brushfire {

struct DoubleDouble {
  double high = 0, low = 0;  // |low| <= half a unit in the last place of high

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : high(value) {}
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}
  constexpr explicit operator double() const { return high; }
};

// The rounded sum and what rounding took away, together exact.
constexpr DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}
// The same where |a| >= |b|.
constexpr DoubleDouble exact_sum_ordered(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}
inline DoubleDouble exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.high, -a.low}; }
constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  DoubleDouble s = exact_sum(a.high, b.high);
  const DoubleDouble t = exact_sum(a.low, b.low);
  s = exact_sum_ordered(s.high, s.low + t.high);
  return exact_sum_ordered(s.high, s.low + t.low);
}
constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }
inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = exact_product(a.high, b.high);
  return exact_sum_ordered(p.high, p.low + (a.high * b.low + a.low * b.high));
}
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.high / b.high;
  DoubleDouble rest = a - b * first;
  const double second = rest.high / b.high;
  rest = rest - b * second;
  return exact_sum_ordered(first, second) + DoubleDouble(rest.high / b.high);
}

constexpr bool operator<(DoubleDouble a, DoubleDouble b) { return a.high < b.high || (a.high == b.high && a.low < b.low); }
constexpr bool operator>(DoubleDouble a, DoubleDouble b) { return b < a; }

inline DoubleDouble sqrt(DoubleDouble a) {
  if (!(a.high > 0)) return {};
  const double root = std::sqrt(a.high);
  const DoubleDouble rest = a - exact_product(root, root);  // one step of Newton's from a root to 53 bits
  return exact_sum_ordered(root, 0.5 * rest.high / root);
}

// A point or an arrow of the plane.
struct WideVec2 {
  DoubleDouble x, y;
  friend constexpr WideVec2 operator+(WideVec2 a, WideVec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr WideVec2 operator-(WideVec2 a, WideVec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend WideVec2 operator*(DoubleDouble s, WideVec2 a) { return {s * a.x, s * a.y}; }
};
inline DoubleDouble dot(WideVec2 a, WideVec2 b) { return a.x * b.x + a.y * b.y; }
inline DoubleDouble cross(WideVec2 a, WideVec2 b) { return a.x * b.y - a.y * b.x; }
inline DoubleDouble norm(WideVec2 a) { return sqrt(dot(a, a)); }

}  // namespace brushfire
