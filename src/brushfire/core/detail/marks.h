// Numbers below a bound, marked in any order and taken in ascending order: for sorting what a run has reached.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace brushfire::detail {

// A bit for each number, and one for every 64 of them that says whether any is marked.
class Marks {
 public:
  Marks() = default;
  explicit Marks(std::size_t bound) : words_(bound / 64 + 1), groups_(bound / 4096 + 1) {}

  void mark(std::size_t number) {
    words_[number / 64] |= std::uint64_t{1} << number % 64;
    groups_[number / 4096] |= std::uint64_t{1} << number / 64 % 64;
  }

  // body(number) for each, ascending; forgets them. O(numbers + bound / 4096).
  template <class Body>
  void take(const Body& body) {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      for (std::uint64_t group = std::exchange(groups_[g], 0); group != 0; group &= group - 1) {
        const std::size_t w = 64 * g + static_cast<std::size_t>(std::countr_zero(group));
        for (std::uint64_t word = std::exchange(words_[w], 0); word != 0; word &= word - 1) {
          body(64 * w + static_cast<std::size_t>(std::countr_zero(word)));
        }
      }
    }
  }

 private:
  std::vector<std::uint64_t> words_, groups_;
};

}  // namespace brushfire::detail
