// Rows in buckets of their keys, however far apart these are: weights of 1 beside 1e9 spread keys over 1e9 buckets.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/types.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

namespace brushfire::steiner {

// As BucketQueue, whose far items wait in a list that is looked through again and again; here they wait in a heap.
class RowQueue {
 public:
  using Bucket = std::int64_t;
  static constexpr Bucket kNever = std::numeric_limits<Bucket>::max();

  RowQueue() : ring_(kRing) {}

  void reset() {
    for (Pile& pile : ring_) pile.clear();
    far_.clear();
    cursor_ = 0;
    in_ring_ = 0;
    pushed_ = 0;
  }

  Bucket cursor() const { return cursor_; }

  // Not before the cursor.
  void push(Index row, Bucket bucket) {
    if (bucket < cursor_ + kRing) {
      at(bucket).push(row);
      ++in_ring_;
    } else {
      far_.emplace_back(bucket, pushed_++, row);
      std::push_heap(far_.begin(), far_.end(), std::greater<>());
    }
  }

  // The bucket at the cursor; it grows while it is being read where rows are pushed into it.
  const Pile& current() const { return ring_[static_cast<std::size_t>(cursor_) % kRing]; }

  void clear_current() {
    in_ring_ -= at(cursor_).size();
    at(cursor_).clear();
  }

  // To the next bucket that is not empty; false where there is none.
  bool advance() {
    if (in_ring_ == 0) {
      if (far_.empty()) return false;
      cursor_ = std::get<0>(far_.front());
    } else {
      while (at(cursor_).size() == 0) ++cursor_;
      if (!far_.empty()) cursor_ = std::min(cursor_, std::get<0>(far_.front()));
    }
    while (!far_.empty() && std::get<0>(far_.front()) < cursor_ + kRing) {
      at(std::get<0>(far_.front())).push(std::get<2>(far_.front()));
      ++in_ring_;
      std::pop_heap(far_.begin(), far_.end(), std::greater<>());
      far_.pop_back();
    }
    return true;
  }

 private:
  static constexpr Bucket kRing = 128;

  Pile& at(Bucket bucket) { return ring_[static_cast<std::size_t>(bucket) % kRing]; }

  std::vector<Pile> ring_;  // buckets from the cursor on
  std::size_t in_ring_ = 0;
  Bucket cursor_ = 0;
  std::uint64_t pushed_ = 0;  // of equal buckets the first comes first
  std::vector<std::tuple<Bucket, std::uint64_t, Index>> far_;
};

}  // namespace brushfire::steiner
