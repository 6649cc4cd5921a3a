// Memory that is made present all at once.
#include <brushfire/core/detail/prefault.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace brushfire {
namespace {

TEST(Prefault, KeepsWhatIsThere) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100'000}, std::size_t{3'000'001}}) {
    UninitializedArray<std::uint32_t> numbers(size);
    prefault(numbers);
    std::iota(numbers.begin(), numbers.end(), 0u);
    prefault(numbers);
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(numbers[i], i);
  }
}

TEST(Prefault, TakesAnyPartOfAnArray) {
  std::vector<std::byte> bytes(std::size_t{5} << 20, std::byte{7});
  for (const std::size_t begin : {0u, 1u, 4095u, 4096u, 1'000'003u}) {
    prefault(bytes.data() + begin, bytes.size() - begin - 5);
  }
  EXPECT_EQ(bytes, std::vector<std::byte>(bytes.size(), std::byte{7}));
}

}  // namespace
}  // namespace brushfire
