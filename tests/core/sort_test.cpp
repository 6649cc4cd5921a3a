// The merge sort that modules of WebAssembly have in place of std::sort; natively nothing else calls it.
#include <brushfire/core/detail/random.h>
#include <brushfire/core/detail/sort.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

// Of few different keys, so that many are equal; `make(key, position)`.
template <class Make, class Order>
void expect_stable(const Make& make, const Order& order) {
  Random random(1);
  for (std::size_t count = 0; count < 200; ++count) {
    std::vector<decltype(make(0u, 0u))> items;
    for (std::size_t k = 0; k < count; ++k) {
      items.push_back(make(static_cast<std::uint32_t>(random.below(20)), static_cast<std::uint32_t>(k)));
    }
    auto expected = items;
    std::stable_sort(expected.begin(), expected.end(), order);
    if (count > 0) detail::sort_bytes(items.data(), items.size(), order);
    EXPECT_EQ(items, expected) << count;
  }
}

TEST(Sort, SortsNumbersPairsTuplesAndArraysAsTheStandardLibraryDoes) {
  expect_stable([](auto key, auto) { return key; }, std::less<>());
  expect_stable([](auto key, auto) { return 0.5 * key; }, std::greater<>());
  expect_stable([](auto key, auto k) { return std::pair(key, k); },
                [](const auto& a, const auto& b) { return a.first < b.first; });
  expect_stable([](auto key, auto k) { return std::tuple(key, 1.5 * k, k); },
                [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
  expect_stable([](auto key, auto k) { return std::array<std::uint64_t, 5>{key, k, key, k, 7}; },
                [](const auto& a, const auto& b) { return a[0] < b[0]; });
}

TEST(Sort, AnOrderThatThrowsIsHeardOf) {
  std::vector<int> items(100);
  for (int k = 0; k < 100; ++k) items[k] = 100 - k;
  const auto order = [](int a, int b) { return a == 1 || b == 1 ? throw std::string("enough") : a < b; };
  EXPECT_THROW(detail::sort_bytes(items.data(), items.size(), order), std::string);
}

TEST(Sort, OnlyWhatMayBeMovedAsBytesIs) {
  EXPECT_TRUE((detail::kMovesAsBytes<std::tuple<int, double>>));
  EXPECT_FALSE(detail::kMovesAsBytes<std::string>);
  std::vector<std::string> words{"b", "c", "a"};
  detail::sort(words.begin(), words.end());
  EXPECT_EQ(words, (std::vector<std::string>{"a", "b", "c"}));
}

}  // namespace
}  // namespace brushfire
