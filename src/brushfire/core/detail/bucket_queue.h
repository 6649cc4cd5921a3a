// A queue of items in buckets of equal width of their keys: constant time, order inside a bucket is first in, first
// out.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/types.h>

#include <algorithm>
#include <cstdint>
#include <limits>
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
  static constexpr Bucket kNever = std::numeric_limits<Bucket>::max();

  BucketQueue() : ring_(kRing) {}

  // Empties the queue and puts the cursor to bucket 0. Costs what is in the queue; keeps the memory.
  void reset() {
    for (Bucket b = cursor_; in_ring_ > 0; ++b) {
      Pile& bucket = at(b);
      in_ring_ -= bucket.size();
      bucket.clear();
    }
    far_.clear();
    cursor_ = 0;
    limit_ = kRing;
    nearest_far_ = kNever;
  }

  Bucket cursor() const { return cursor_; }

  void push(Index item, Bucket bucket) { push_if(true, item, bucket); }
  BRUSHFIRE_INLINE void push_if(bool wanted, Index item, Bucket bucket) {
    bucket = std::max(bucket, cursor_);
    if (bucket < limit_) {
      at(bucket).push_if(wanted, item);
      in_ring_ += wanted;
    } else if (wanted) {
      far_.emplace_back(bucket, item);
      nearest_far_ = std::min(nearest_far_, bucket);
    }
  }

  // The bucket at the cursor. It grows while it is being read where items are pushed into it; take references anew.
  const Pile& current() const { return at(cursor_); }

  void clear_current() {
    Pile& bucket = at(cursor_);
    in_ring_ -= bucket.size();
    bucket.clear();
  }

  // The first bucket from the cursor on that is not empty; kNever where there is none.
  Bucket next() const {
    if (in_ring_ == 0) return nearest_far_;
    Bucket b = cursor_;
    while (at(b).size() == 0) ++b;
    return b;
  }

  // What waits in a bucket that is near, like that of next(); of far ones nothing is known.
  const Pile& in(Bucket bucket) const { return bucket < limit_ ? at(bucket) : nothing_; }

  // Moves the cursor to the next bucket that is not empty; false where there is none.
  bool advance() {
    const Bucket bucket = next();
    if (bucket != kNever) move_to(bucket);
    return bucket != kNever;
  }

  // Moves the cursor forward, over empty buckets only.
  void move_to(Bucket bucket) {
    cursor_ = bucket;
    // Not at every step: all far items are looked at.
    if (limit_ - cursor_ > kRing / 2) return;
    limit_ = cursor_ + kRing;
    if (nearest_far_ < limit_) fetch_far();
  }

 private:
  static constexpr Bucket kRing = 128;  // a power of two

  Pile& at(Bucket bucket) { return ring_[static_cast<std::size_t>(bucket) % kRing]; }
  const Pile& at(Bucket bucket) const { return ring_[static_cast<std::size_t>(bucket) % kRing]; }

  void fetch_far() {
    waiting_.swap(far_);
    nearest_far_ = kNever;
    for (const auto& [bucket, item] : waiting_) push(item, bucket);
    waiting_.clear();
  }

  Pile nothing_;
  std::vector<Pile> ring_;  // of buckets from the cursor to the limit
  std::vector<std::pair<Bucket, Index>> far_, waiting_;
  std::size_t in_ring_ = 0;
  Bucket cursor_ = 0, limit_ = kRing;
  Bucket nearest_far_ = kNever;
};

}  // namespace brushfire
