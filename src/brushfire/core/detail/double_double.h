// DoubleDouble: an unevaluated sum of two doubles, some 106 bits, for the few meshes whose lengths differ too much for
// one double.
//
// Based on: T. J. Dekker, A floating-point technique for extending the available precision, 1971; Y. Hida, X. Li,
// D. Bailey, Algorithms for quad-double precision floating point arithmetic, 2001. Needs rounding to nearest and no
// contraction other than the fused multiplications that are written out.
#pragma once

#include <cmath>
#include <limits>

namespace brushfire::detail {

// The value is high + low, |low| <= half a unit in the last place of high; low = 0 where high is not finite. Sums and
// products are right to 2^-103 of the result (sums: also where they cancel), quotients and roots to 2^-101, as long as
// no product of low parts falls below the least double: that is, for numbers between 1e-140 and 1e140.
struct DoubleDouble {
  double high = 0, low = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double number) : high(number) {}  // NOLINT(google-explicit-constructor): every double is one
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}

  explicit constexpr operator double() const { return high; }
  explicit constexpr operator float() const { return static_cast<float>(high); }

  // a + b of doubles, exactly.
  static constexpr DoubleDouble sum(double a, double b) {
    const double s = a + b;
    if (!(s - s == 0)) return s;  // not finite
    const double part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  // The same for |a| >= |b|.
  static constexpr DoubleDouble quick_sum(double a, double b) {
    const double s = a + b;
    if (!(s - s == 0)) return s;
    return {s, b - (s - a)};
  }
  // a * b of doubles, exactly.
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
    if (!(p - p == 0)) return p;
    return {p, std::fma(a, b, -p)};
  }

  friend constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble highs = sum(a.high, b.high), lows = sum(a.low, b.low);
    const DoubleDouble once = quick_sum(highs.high, highs.low + lows.high);
    return quick_sum(once.high, once.low + lows.low);
  }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = product(a.high, b.high);
    if (!(p.high - p.high == 0)) return p;
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    if (!(first - first == 0) || first == 0) return first;
    DoubleDouble rest = a - b * first;
    const double second = rest.high / b.high;
    rest = rest - b * second;
    const double third = rest.high / b.high;
    return quick_sum(first, second) + third;
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }

  friend constexpr bool operator==(const DoubleDouble&, const DoubleDouble&) = default;
  friend constexpr bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
  }
  friend constexpr bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend constexpr bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low <= b.low);
  }
  friend constexpr bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }
};

inline DoubleDouble abs(const DoubleDouble& a) { return a.high < 0 || (a.high == 0 && a.low < 0) ? -a : a; }
inline DoubleDouble copysign(const DoubleDouble& a, const DoubleDouble& sign) {
  return std::signbit(a.high) == std::signbit(sign.high) ? a : -a;
}
inline bool isnan(const DoubleDouble& a) { return std::isnan(a.high); }
inline bool isfinite(const DoubleDouble& a) { return std::isfinite(a.high); }
// One step of Newton's method from the root of the high part (Karp and Markstein 1997).
inline DoubleDouble sqrt(const DoubleDouble& a) {
  const double root = std::sqrt(a.high);
  if (!(root - root == 0) || root == 0) return root;
  const DoubleDouble rest = a - DoubleDouble::product(root, root);
  const double step = rest.high / (2 * root);
  const DoubleDouble once = DoubleDouble::quick_sum(root, step);
  const DoubleDouble left = a - once * once;
  return once + left.high / (2 * root);
}
inline DoubleDouble hypot(const DoubleDouble& a, const DoubleDouble& b) { return sqrt(a * a + b * b); }

}  // namespace brushfire::detail
