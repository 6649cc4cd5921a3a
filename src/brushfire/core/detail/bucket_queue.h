// A queue of items in buckets of equal width of their keys: constant time; first in, first out within a bucket.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/types.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace brushfire {

// Items in the order in which they came. Its memory grows and stays.
class Pile {
 public:
  std::size_t size() const { return size_; }
  // How many items it can hold before it grows.
  std::size_t room() const { return room_; }
  Index operator[](std::size_t i) const { return items_[i]; }
  void clear() { size_ = 0; }
  const Index* begin() const { return items_.get(); }
  const Index* end() const { return items_.get() + size_; }
  void push(Index item) { push_if(true, item); }
  // Without a branch, for conditions that cannot be foreseen.
  BRUSHFIRE_INLINE void push_if(bool wanted, Index item) {
    if (size_ == room_) reserve(std::max<std::size_t>(16, 2 * room_));
    items_[size_] = item;
    size_ += wanted;
  }
  void reserve(std::size_t room) {
    if (room <= room_) return;
    std::unique_ptr<Index[]> larger(new Index[room]);
    std::copy(begin(), end(), larger.get());
    items_ = std::move(larger);
    room_ = room;
  }
  void swap(Pile& o) noexcept {
    items_.swap(o.items_);
    std::swap(size_, o.size_);
    std::swap(room_, o.room_);
  }

 private:
  std::unique_ptr<Index[]> items_;  // the first size_ are there
  std::size_t size_ = 0, room_ = 0;
};

// A monotone queue: the cursor stands at the bucket that is being emptied and never goes back; what is pushed with an
// earlier bucket goes to the end of the current one. Removal is lazy: an item whose key falls is pushed again and the
// caller recognises the stale entry. The next kRing buckets form a ring, what is farther waits in a heap, so that a
// wide range of keys costs neither memory nor a walk over empty buckets. A bucket keeps items of different kinds apart.
// Not for use from several threads at once.
template <std::size_t kKinds, std::int64_t kRing>
class BasicBucketQueue {
 public:
  using Bucket = std::int64_t;
  static constexpr Bucket kNever = std::numeric_limits<Bucket>::max();

  BasicBucketQueue() : ring_(kRing) {}

  // Empties the queue and puts the cursor to bucket `first`. Costs what is in the queue; keeps the memory.
  void reset(Bucket first = 0) {
    for (; in_ring_ > 0; ++cursor_) clear_current();
    far_.clear();
    pushed_far_ = 0;
    cursor_ = first;
    limit_ = first + kRing;
  }

  Bucket cursor() const { return cursor_; }
  // How many items are in the queue, those of the current bucket included until clear_current().
  std::size_t size() const { return in_ring_ + far_.size(); }

  void push(Index item, Bucket bucket, std::size_t kind = 0) { push_if(true, item, bucket, kind); }
  BRUSHFIRE_INLINE void push_if(bool wanted, Index item, Bucket bucket, std::size_t kind = 0) {
    bucket = std::max(bucket, cursor_);
    if (bucket < limit_) {
      Pile& pile = at(bucket)[kind];
      if (pile.room() == 0) take_spare(pile);
      pile.push_if(wanted, item);
      in_ring_ += wanted;
    } else if (wanted) {
      far_.push_back({bucket, pushed_far_++, item, static_cast<Index>(kind)});
      std::push_heap(far_.begin(), far_.end());
    }
  }

  // The bucket at the cursor. It grows while it is being read where items are pushed into it; take references anew.
  const Pile& current(std::size_t kind = 0) const { return at(cursor_)[kind]; }

  void clear_current() {
    for (Pile& pile : at(cursor_)) {
      in_ring_ -= pile.size();
      pile.clear();
      if (pile.room() > 0) give_spare(pile);
    }
  }

  // The first bucket from the cursor on that is not empty; kNever where there is none.
  Bucket next() const {
    if (in_ring_ == 0) return far_.empty() ? kNever : far_.front().bucket;
    Bucket b = cursor_;
    while (is_empty(at(b))) ++b;
    return b;
  }

  // How many items wait in a bucket of the ring, like that of next(); of those in the heap nothing is known.
  std::size_t size_of(Bucket bucket) const {
    std::size_t size = 0;
    if (bucket < limit_) {
      for (const Pile& pile : at(bucket)) size += pile.size();
    }
    return size;
  }

  // What waits in a bucket, under the same condition.
  const Pile& in(Bucket bucket, std::size_t kind = 0) const { return bucket < limit_ ? at(bucket)[kind] : nothing_; }

  // Moves the cursor to the next bucket that is not empty; false where there is none.
  bool advance() {
    const Bucket bucket = next();
    if (bucket != kNever) move_to(bucket);
    return bucket != kNever;
  }

  // Moves the cursor forward, over empty buckets only.
  void move_to(Bucket bucket) {
    cursor_ = bucket;
    limit_ = bucket + kRing;
    while (!far_.empty() && far_.front().bucket < limit_) fetch_nearest_far();
  }

 private:
  static_assert((kRing & (kRing - 1)) == 0, "a power of two");
  using Piles = std::array<Pile, kKinds>;

  struct Far {
    Bucket bucket;
    std::uint64_t number;  // in the order in which they came
    Index item, kind;
    bool operator<(const Far& o) const { return bucket > o.bucket || (bucket == o.bucket && number > o.number); }
  };

  Piles& at(Bucket bucket) { return ring_[static_cast<std::size_t>(bucket) % kRing]; }
  const Piles& at(Bucket bucket) const { return ring_[static_cast<std::size_t>(bucket) % kRing]; }

  static bool is_empty(const Piles& piles) {
    for (const Pile& pile : piles) {
      if (pile.size() > 0) return false;
    }
    return true;
  }

  void fetch_nearest_far() {
    const Far nearest = far_.front();
    std::pop_heap(far_.begin(), far_.end());
    far_.pop_back();
    push(nearest.item, nearest.bucket, nearest.kind);
  }

  // The memory of emptied buckets is for the next ones to be filled: few buckets hold items at a time. All piles are
  // made as large as the largest was, so that a run like the one before finds room enough whichever it takes.
  void give_spare(Pile& pile) {
    largest_ = std::max(largest_, pile.room());
    spare_.emplace_back();
    spare_.back().swap(pile);
  }
  void take_spare(Pile& pile) {
    if (spare_.empty()) return;
    spare_.back().swap(pile);
    spare_.pop_back();
    pile.reserve(largest_);
  }

  Pile nothing_;
  std::vector<Piles> ring_;  // of buckets from the cursor to the limit
  std::vector<Far> far_;     // a heap, the nearest first
  std::vector<Pile> spare_;  // empty, with room
  std::size_t largest_ = 0;
  std::size_t in_ring_ = 0;
  std::uint64_t pushed_far_ = 0;
  Bucket cursor_ = 0, limit_ = kRing;
};

using BucketQueue = BasicBucketQueue<1, 128>;

}  // namespace brushfire
