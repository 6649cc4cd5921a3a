// Marks come out in ascending order, once each, and are forgotten.
#include <brushfire/core/detail/marks.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace brushfire::detail {
namespace {

std::vector<std::size_t> taken(Marks& marks) {
  std::vector<std::size_t> numbers;
  marks.take([&](std::size_t number) { numbers.push_back(number); });
  return numbers;
}

TEST(Marks, ComeOutAscendingOnceEachAndAreForgotten) {
  constexpr std::size_t kBound = 20'000;
  Marks marks(kBound);
  EXPECT_TRUE(taken(marks).empty());
  std::mt19937 random(5);
  for (const std::size_t count : {1u, 30u, 3000u}) {
    std::set<std::size_t> expected{0, 63, 64, 4095, 4096, kBound - 1};
    for (std::size_t k = 0; k < count; ++k) expected.insert(random() % kBound);
    std::vector<std::size_t> shuffled(expected.begin(), expected.end());
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (const std::size_t number : shuffled) marks.mark(number);
    for (const std::size_t number : shuffled) marks.mark(number);
    EXPECT_EQ(taken(marks), std::vector<std::size_t>(expected.begin(), expected.end()));
    EXPECT_TRUE(taken(marks).empty());
  }
}

TEST(Marks, OfNothingAreNone) {
  Marks marks(0);
  EXPECT_TRUE(taken(marks).empty());
}

}  // namespace
}  // namespace brushfire::detail
