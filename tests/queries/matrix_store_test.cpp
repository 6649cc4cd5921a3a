// What jobs stand on: the ledger's locks, the store's places, the journal of symmetric blocks.
#include <brushfire/core/error.h>
#include <brushfire/queries/detail/little_endian.h>
#include <brushfire/queries/detail/matrix_store.h>
#include <brushfire/queries/detail/row_ledger.h>
#include <brushfire/queries/detail/symmetrize.h>

#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/io_support.h"

namespace brushfire::test {
namespace {

namespace fs = std::filesystem;

class MatrixFiles : public testing::Test {
 protected:
  std::string path(const char* name) const { return folder_ / name; }
  detail::RowLedger ledger(std::uint64_t matrix = 7) const {
    detail::LedgerHead head;
    head.matrix = matrix;
    head.rows = head.columns = head.entries = 10;
    head.words = "ten rows";
    return {path("d.rows"), head, {}, [] { return true; }, [] {}};
  }

  TemporaryDirectory folder_;
};

TEST_F(MatrixFiles, ARowThatAProcessIsAtIsNobodyElsesAndFreeOnceTheProcessIsKilled) {
  ledger().mark(2);
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const detail::RowLedger own = ledger();
    const bool is_mine = own.claim(3) && !own.claim(2);
    if (write(ready[1], is_mine ? "y" : "n", 1) != 1) _exit(1);
    for (;;) pause();
  }
  char answer = 0;
  ASSERT_EQ(read(ready[0], &answer, 1), 1);
  EXPECT_EQ(answer, 'y');
  const detail::RowLedger mine = ledger();
  EXPECT_EQ(mine.found(), 1u);
  EXPECT_FALSE(mine.claim(3));
  EXPECT_FALSE(mine.is_free(3));
  EXPECT_TRUE(mine.claim(4));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(mine.is_free(3));
  EXPECT_TRUE(mine.claim(3));
  close(ready[0]), close(ready[1]);
}

TEST_F(MatrixFiles, ALedgerOfAnotherMatrixIsRefusedWithWhatItIsOf) {
  ledger().mark(2);
  try {
    ledger(8);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("ten rows"), std::string::npos) << e.what();
  }
  EXPECT_EQ(ledger().done(), 1u);
}

TEST_F(MatrixFiles, RowsBeyondFourGigabytesHaveTheirPlace) {
  detail::StoredMatrix m;
  m.rows = 20'000, m.columns = 70'000;  // 5.6 GB, of which one row is written
  if (fs::space(path(".")).available < m.rows * m.row_bytes()) GTEST_SKIP() << "no room for 5.6 GB";
  const auto store = detail::open_store(path("d.npy"), m, {});
  store->begin();
  const std::vector<float> row(m.columns, 1.5F);
  store->write(m.rows - 1, 0, detail::as_little_endian(std::span<const float>(row)));
  std::string bytes(4, ' ');
  store->read(m.rows - 1, m.row_bytes() - 4, bytes);
  EXPECT_EQ(detail::load<float>(bytes.data(), std::endian::little), 1.5F);
  store->read(0, 0, bytes);
  EXPECT_EQ(detail::load<float>(bytes.data(), std::endian::little), 0.0F);
}

TEST_F(MatrixFiles, WhatTheDiskHasNoRoomForIsRefusedWithTheRowsThatWouldFit) {
  EXPECT_NO_THROW(detail::require_disk(path("d.npy"), 10, 10));
  try {
    detail::require_disk(path("d.npy"), std::uint64_t{1} << 40, std::uint64_t{1} << 20);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::FileNotWritable);
    EXPECT_NE(std::string(e.what()).find("rows would fit"), std::string::npos) << e.what();
  }
}

// A square matrix in memory that fails at its `fails_at`-th write.
class FailingStore : public detail::MatrixStore {
 public:
  explicit FailingStore(std::size_t size) : size_(size), values_(size * size) {
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k] = static_cast<float>(std::sin(static_cast<double>(k)));
  }
  void begin() override {}
  bool is_there() const override { return true; }
  void write(std::uint64_t row, std::uint64_t from, std::span<const char> bytes) const override {
    if (--writes_left == 0) throw Error(ErrorCode::FileNotWritable, "killed");
    std::copy(bytes.begin(), bytes.end(), place(row, from));
  }
  void read(std::uint64_t row, std::uint64_t from, std::span<char> bytes) const override {
    std::copy_n(place(row, from), bytes.size(), bytes.data());
  }
  void finish() const override {}
  bool is_finished() const override { return false; }
  const std::vector<float>& values() const { return values_; }

  mutable long writes_left = -1;  // then it fails, once

 private:
  char* place(std::uint64_t row, std::uint64_t from) const {
    return reinterpret_cast<char*>(values_.data() + row * size_) + from;
  }
  std::size_t size_;
  mutable std::vector<float> values_;
};

TEST_F(MatrixFiles, SymmetryThatIsInterruptedAtAnyWriteEndsInTheSameBits) {
  constexpr std::size_t kSize = 700;  // two blocks of rows: three pairs
  const FailingStore whole(kSize);
  detail::symmetrize(whole, kSize, ValueType::Float32, Symmetry::Mean, path("whole.pair"));
  const FailingStore plain(kSize);
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j < kSize; ++j) {
      const float a = plain.values()[i * kSize + j], b = plain.values()[j * kSize + i];
      ASSERT_EQ(whole.values()[i * kSize + j], a / 2 + b / 2);
    }
  }
  for (const long at : {1L, 300L, 900L, 1100L, 1400L, 1700L, 2050L}) {
    const std::string journal = path("d.pair") + std::to_string(at);
    FailingStore store(kSize);
    store.writes_left = at;
    EXPECT_THROW(detail::symmetrize(store, kSize, ValueType::Float32, Symmetry::Mean, journal), Error) << at;
    detail::symmetrize(store, kSize, ValueType::Float32, Symmetry::Mean, journal);
    EXPECT_EQ(store.values(), whole.values()) << at;
  }
}

}  // namespace
}  // namespace brushfire::test
