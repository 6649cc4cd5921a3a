// A queue of items in buckets of equal width of their keys: constant time, order inside a bucket is first in, first
// out.
#pragma once

#include <brushfire/core/types.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace brushfire {

// A monotone queue: the cursor stands at the bucket that is being emptied and never goes back; what is pushed with an
// earlier bucket goes to the end of the current one. Removal is lazy: an item whose key falls is pushed again and the
// caller recognises the stale entry. Near buckets form a ring, far ones wait in one list, so that a wide range of keys
// costs neither memory nor a walk over empty buckets. Not for use from several threads at once.
class BucketQueue {
 public:
  using Bucket = std::int64_t;

  BucketQueue() : ring_(kRing) {}

  // Empties the queue and puts the cursor to bucket 0. Costs what is in the queue; keeps the memory.
  void reset() {
    for (Bucket b = cursor_; in_ring_ > 0 && b < cursor_ + kRing; ++b) {
      std::vector<Index>& bucket = ring_[static_cast<std::size_t>(b % kRing)];
      in_ring_ -= bucket.size();
      bucket.clear();
    }
    far_.clear();
    cursor_ = 0;
    nearest_far_ = kNever;
  }

  Bucket cursor() const { return cursor_; }

  void push(Index item, Bucket bucket) {
    bucket = std::max(bucket, cursor_);
    if (bucket - cursor_ < kRing) {
      ring_[static_cast<std::size_t>(bucket % kRing)].push_back(item);
      ++in_ring_;
    } else {
      far_.emplace_back(bucket, item);
      nearest_far_ = std::min(nearest_far_, bucket);
    }
  }

  // The bucket at the cursor. It grows while it is being read where items are pushed into it; take references anew.
  const std::vector<Index>& current() const { return ring_[static_cast<std::size_t>(cursor_ % kRing)]; }

  void clear_current() {
    std::vector<Index>& bucket = ring_[static_cast<std::size_t>(cursor_ % kRing)];
    in_ring_ -= bucket.size();
    bucket.clear();
  }

  // Moves the cursor to the next bucket that is not empty; false where there is none.
  bool advance() {
    while (true) {
      if (in_ring_ == 0) {
        if (far_.empty()) return false;
        cursor_ = nearest_far_;
      }
      if (nearest_far_ - cursor_ < kRing) fetch_far();
      if (!current().empty()) return true;
      ++cursor_;
    }
  }

 private:
  static constexpr Bucket kRing = 1024;  // a power of two
  static constexpr Bucket kNever = std::numeric_limits<Bucket>::max();

  void fetch_far() {
    std::vector<std::pair<Bucket, Index>> waiting;
    waiting.swap(far_);
    nearest_far_ = kNever;
    for (const auto& [bucket, item] : waiting) push(item, bucket);
  }

  std::vector<std::vector<Index>> ring_;
  std::vector<std::pair<Bucket, Index>> far_;
  std::size_t in_ring_ = 0;
  Bucket cursor_ = 0;
  Bucket nearest_far_ = kNever;
};

}  // namespace brushfire
