// Lanes against single numbers, on every target that this processor has.
#include <brushfire/core/detail/lanes.h>
#include <brushfire/core/detail/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace brushfire {
namespace {

// NaN is a value, and -0 is not 0.
template <class T>
bool same_bits(T a, T b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

// What makes trouble, and ordinary numbers, in any order.
template <class T>
std::vector<T> awkward_numbers(std::size_t count) {
  using Limits = std::numeric_limits<T>;
  const std::array<T, 10> special{0,
                                  -T(0),
                                  Limits::infinity(),
                                  -Limits::infinity(),
                                  Limits::quiet_NaN(),
                                  Limits::max(),
                                  Limits::min(),
                                  Limits::denorm_min(),
                                  1,
                                  -1};
  Random random(7);
  std::vector<T> numbers(count);
  for (T& x : numbers) {
    const std::uint64_t i = random.below(2 * special.size());
    x = i < special.size() ? special[i] : static_cast<T>(random.uniform(-4, 4));
  }
  return numbers;
}

}  // namespace
}  // namespace brushfire

#define BRUSHFIRE_KERNEL_IS_WIDE
#define BRUSHFIRE_KERNEL <core/lanes_test_kernel.h>
#include <brushfire/core/detail/each_target.h>

namespace brushfire {
namespace {

constexpr Variant kVariants[] = {Variant::Portable, Variant::Avx2, Variant::Best};

TEST(Lanes, CalculateAsSingleNumbersDoToTheBit) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, calculate_all());
}

TEST(Lanes, OfWholeNumbersCountModuloTwoToTheThirtyTwo) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, count_all());
}

TEST(Lanes, ComeFromWhereTheIndexSays) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, gather_all());
}

TEST(Lanes, ArePermutedAndPackedByAnySetOfLanes) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, pack_all());
}

TEST(Lanes, TouchNoMemoryBeyondTheFirstOnes) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, load_only_the_first());
}

TEST(Lanes, TurnIntoBytesAndBack) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, store_as_bytes());
}

TEST(Lanes, TurnIntoWordsAndBack) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, store_as_words());
}

TEST(Lanes, AreConvertedAsSingleNumbersAre) {
  for (const Variant variant : kVariants) BRUSHFIRE_ON_WIDE_TARGET(variant, convert_all());
}

}  // namespace
}  // namespace brushfire
