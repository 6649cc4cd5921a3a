// Thread teams, and what is known about memory.
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/core/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace brushfire {
namespace {

TEST(ThreadTeam, CallsEveryIndexOnceWhateverTheNumberOfThreadsAndLoops) {
  for (const unsigned threads : {1u, 2u, 7u}) {
    ThreadTeam team(threads);
    EXPECT_LE(team.size(), threads);
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<int> calls(count, 0);
      team.run(count, [&](unsigned worker, std::size_t i) {
        EXPECT_LT(worker, team.size());
        ++calls[i];  // no two threads share an index
      });
      EXPECT_EQ(calls, std::vector<int>(count, 1)) << threads << " threads";
    }
  }
}

TEST(ThreadTeam, WhatALoopWroteIsVisibleToTheNext) {
  ThreadTeam team(4);
  std::vector<std::size_t> values(257, 0);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::size_t> next(values.size());
    team.run(values.size(), [&](unsigned, std::size_t i) { next[i] = values[(i + 1) % values.size()] + i; });
    values = next;
  }
  std::size_t sum = 0;
  for (const std::size_t v : values) sum += v;
  EXPECT_EQ(sum, 200u * (256u * 257u / 2));
}

TEST(ThreadTeam, LoopsInQuickSuccessionMissNoIndexWhetherThreadsSleepOrSpinInBetween) {
  for (const auto idle : {ThreadTeam::Idle::Sleeps, ThreadTeam::Idle::Spins}) {
    ThreadTeam team(5, idle);
    std::vector<std::uint64_t> sums(16, 0);
    constexpr std::uint64_t kLoops = 3000;
    for (std::uint64_t loop = 0; loop < kLoops; ++loop) {
      const std::size_t count = loop % (sums.size() + 1);
      team.run(count, [&](unsigned, std::size_t i) { sums[i] += loop; });
    }
    std::vector<std::uint64_t> expected(sums.size(), 0);
    for (std::uint64_t loop = 0; loop < kLoops; ++loop) {
      for (std::size_t i = 0; i < loop % (sums.size() + 1); ++i) expected[i] += loop;
    }
    EXPECT_EQ(sums, expected);
  }
}

TEST(ThreadTeam, ThrowsTheExceptionOfTheLowestIndexAndCanBeUsedAgain) {
  ThreadTeam team(4);
  for (int round = 0; round < 50; ++round) {
    try {
      team.run(100, [](unsigned, std::size_t i) {
        if (i >= 3) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "3");
    }
  }
  std::atomic<int> calls{0};
  team.run(10, [&](unsigned, std::size_t) { ++calls; });
  EXPECT_EQ(calls, 10);
}

TEST(ThreadTeam, StopsGivingOutWorkWhenCancelled) {
  CancelToken cancel;
  std::atomic<std::size_t> calls{0};
  try {
    parallel_for(1000000, 3, [&](unsigned, std::size_t i) { ++calls, i == 10 ? cancel.cancel() : void(); }, &cancel);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::Cancelled);
  }
  EXPECT_LT(calls, 1000000u);
}

TEST(Memory, WhatDoesNotFitIsRefusedWithBothNumbersAndTheAdvice) {
  EXPECT_NO_THROW(require_memory(1000, 1000, "a list", "shorten it"));
  try {
    require_memory(102'400'000'000, 21'300'000'000, "a list", "shorten it");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::TooLarge);
    EXPECT_STREQ(e.what(), "a list needs 102 GB, but 21.3 GB are available: shorten it");
  }
  EXPECT_EQ(bytes_as_text(0), "0 bytes");
  EXPECT_EQ(bytes_as_text(999), "999 bytes");
  EXPECT_EQ(bytes_as_text(999'600), "1 MB");
  EXPECT_GT(available_memory(), 1'000'000u);
}

}  // namespace
}  // namespace brushfire
