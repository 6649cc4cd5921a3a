// The queue of buckets beside a map of lists.
#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/detail/random.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace brushfire {
namespace {

using Queue = BasicBucketQueue<2, 16>;
using Piles = std::array<std::vector<Index>, 2>;

// Pushes into both, near and far (beyond the ring), while buckets are emptied.
void expect_same_order(Queue& queue, std::uint64_t seed, Index items, double far_share) {
  Random random(seed);
  std::map<Queue::Bucket, Piles> model;
  Index pushed = 0;
  const auto push = [&] {
    const Queue::Bucket ahead = random.uniform() < far_share ? random.below(1'000'000) : random.below(20);
    const std::size_t kind = random.below(2);
    queue.push(pushed, queue.cursor() + ahead, kind);
    model[queue.cursor() + ahead][kind].push_back(pushed++);
  };
  push();
  std::size_t taken = 0;
  while (queue.advance()) {
    ASSERT_EQ(queue.cursor(), model.begin()->first) << "seed " << seed;
    std::array<std::size_t, 2> read{};
    while (read[0] + read[1] < queue.size_of(queue.cursor())) {
      const std::size_t kind = read[0] < queue.current(0).size() ? 0 : 1;
      ASSERT_EQ(queue.current(kind)[read[kind]], model.begin()->second[kind][read[kind]]) << "seed " << seed;
      ++read[kind];
      ++taken;
      for (int k = 0; k < 3 && pushed < items; ++k) push();
    }
    queue.clear_current();
    model.erase(model.begin());
  }
  EXPECT_EQ(taken, items);
  EXPECT_EQ(queue.size(), 0u);
}

TEST(BucketQueue, TakesItemsInOrderOfTheirBucketsThenAsTheyCame) {
  Queue queue;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    queue.reset();
    expect_same_order(queue, seed, 3000, seed % 2 ? 0.01 : 0.5);
  }
}

TEST(BucketQueue, IsEmptyAfterAResetWhateverWasInIt) {
  Queue queue;
  for (Index i = 0; i < 100; ++i) queue.push(i, i * i, i % 2);
  ASSERT_TRUE(queue.advance());
  queue.reset(1000);
  EXPECT_EQ(queue.size(), 0u);
  EXPECT_EQ(queue.next(), Queue::kNever);
  queue.push(7, 3);  // before the cursor: into the current bucket
  EXPECT_EQ(queue.next(), 1000);
  EXPECT_EQ(queue.current()[0], 7u);
}

}  // namespace
}  // namespace brushfire
