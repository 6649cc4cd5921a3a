// Pairs of doubles: what sums, quotients and roots of them keep.
#include <brushfire/core/detail/double_double.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace brushfire::detail {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

DoubleDouble random_number(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1), exponent(-60, 60);
  const double high = std::ldexp(unit(random), static_cast<int>(exponent(random)));
  return DoubleDouble::quick_sum(high, high * 0x1p-54 * unit(random));
}

TEST(DoubleDouble, SumsOfDoublesAreExact) {
  const DoubleDouble s = DoubleDouble(1) + DoubleDouble(0x1p-100);
  EXPECT_EQ(s.high, 1);
  EXPECT_EQ(s.low, 0x1p-100);
  EXPECT_EQ(static_cast<double>(s - DoubleDouble(1)), 0x1p-100);
  EXPECT_EQ(static_cast<double>(DoubleDouble(1e16) + DoubleDouble(1) - DoubleDouble(1e16)), 1);
}

TEST(DoubleDouble, QuotientsAndRootsAreUndoneToTheLastBits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const DoubleDouble a = random_number(random), b = random_number(random);
    if (b == DoubleDouble(0)) continue;
    EXPECT_LE(static_cast<double>(abs(a / b * b - a)), 0x1p-100 * static_cast<double>(abs(a)));
    const DoubleDouble root = sqrt(abs(a));
    EXPECT_LE(static_cast<double>(abs(root * root - abs(a))), 0x1p-100 * static_cast<double>(abs(a)));
    EXPECT_LE(static_cast<double>(abs(a + b - b - a)),
              0x1p-101 * (static_cast<double>(abs(a)) + static_cast<double>(abs(b))));
  }
}

TEST(DoubleDouble, InfinityStaysInfinity) {
  const DoubleDouble infinite = kInfinite;
  EXPECT_EQ(static_cast<double>(infinite + DoubleDouble(1)), kInfinite);
  EXPECT_EQ(static_cast<double>(infinite * DoubleDouble(2)), kInfinite);
  EXPECT_TRUE(DoubleDouble(1) < infinite);
  EXPECT_FALSE(infinite < infinite);
  EXPECT_EQ(static_cast<double>(sqrt(infinite)), kInfinite);
  EXPECT_EQ(static_cast<double>(sqrt(DoubleDouble(0))), 0);
}

TEST(DoubleDouble, LowPartsDecideComparisons) {
  const DoubleDouble one(1), more(1, 0x1p-80);
  EXPECT_TRUE(one < more);
  EXPECT_TRUE(more >= one);
  EXPECT_FALSE(more <= one);
  EXPECT_FALSE(one == more);
}

}  // namespace
}  // namespace brushfire::detail
