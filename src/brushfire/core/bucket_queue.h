// A queue of items in buckets of equal width of their keys: constant time, order inside a bucket is first in, first
// out.
#pragma once

#include <brushfire/core/inline.h>
#include <brushfire/core/types.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace brushfire {

// Items in the order in which they came. Its memory grows and stays.
class Pile {
 public:
  std::size_t size() const { return size_; }
  Index operator[](std::size_t i) const { return items_[i]; }
  void clear() { size_ = 0; }
  const Index* begin() const { return items_.data(); }
  const Index* end() const { return items_.data() + size_; }
  void push(Index item) { push_if(true, item); }
  // Without a branch, for conditions that cannot be foreseen.
  BRUSHFIRE_INLINE void push_if(bool wanted, Index item) {
    if (size_ == items_.size()) grow();
    items_[size_] = item;
    size_ += wanted;
  }

 private:
  void grow() { items_.resize(std::max<std::size_t>(16, 2 * items_.size())); }

  std::vector<Index> items_;  // the first size_ are there
  std::size_t size_ = 0;
};

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
      Pile& bucket = ring_[static_cast<std::size_t>(b % kRing)];
      in_ring_ -= bucket.size();
      bucket.clear();
    }
    far_.clear();
    cursor_ = 0;
    nearest_far_ = kNever;
  }

  Bucket cursor() const { return cursor_; }

  void push(Index item, Bucket bucket) { push_if(true, item, bucket); }
  BRUSHFIRE_INLINE void push_if(bool wanted, Index item, Bucket bucket) {
    bucket = std::max(bucket, cursor_);
    if (bucket - cursor_ < kRing) {
      ring_[static_cast<std::size_t>(bucket) % kRing].push_if(wanted, item);
      in_ring_ += wanted;
    } else if (wanted) {
      far_.emplace_back(bucket, item);
      nearest_far_ = std::min(nearest_far_, bucket);
    }
  }

  // The bucket at the cursor. It grows while it is being read where items are pushed into it; take references anew.
  const Pile& current() const { return ring_[static_cast<std::size_t>(cursor_ % kRing)]; }

  void clear_current() {
    Pile& bucket = ring_[static_cast<std::size_t>(cursor_ % kRing)];
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
      if (current().size() > 0) return true;
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

  std::vector<Pile> ring_;
  std::vector<std::pair<Bucket, Index>> far_;
  std::size_t in_ring_ = 0;
  Bucket cursor_ = 0;
  Bucket nearest_far_ = kNever;
};

}  // namespace brushfire
