// The order of events: buckets of equal width over the distance, first in first out within a bucket.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/partition/rounds.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace brushfire::windows {

// Two kinds of events: window lists (by halfedge) and vertices at which paths bend. A bucket's vertices come after its
// lists, so that they see final values and directions. Nothing depends on the order but speed: an event may come too
// early or twice. Keys below the current bucket go into it.
class EventQueue {
 public:
  EventQueue() : buckets_(kBuckets) {}

  // Buckets of this width from number `current` on; later ones may be pushed.
  void reset(double width, std::int64_t current) {
    if (!empty()) {  // left over from a run that was stopped
      for (Bucket& b : buckets_) b.clear();
      far_.clear();
    }
    buckets_[current_ % kBuckets].clear();  // events that were taken stay until their bucket is done
    inverse_width_ = 1 / width;
    current_ = current;
    near_count_ = 0;
    list_position_ = vertex_position_ = 0;
    vertices_turn_ = false;
  }

  bool empty() const { return near_count_ == 0 && far_.empty(); }
  // Whether the two keys fall into one bucket.
  bool same_bucket(double a, double b) const { return number(a) == number(b); }
  // The bucket of a key.
  std::int64_t bucket_of(double key) const { return number(key); }

  void push_list(Index h, double key) { push({key, h, true}, number(key)); }
  void push_list(Index h, double key, std::int64_t bucket) { push({key, h, true}, bucket); }
  void push_vertex(Index v, double key) { push({key, v, false}, number(key)); }

  struct Event {
    double key;
    Index index;
    bool is_list;
  };
  // Goes on to the next bucket with events up to number `last`; false where there is none.
  bool advance_to(std::int64_t last) {
    while (true) {
      Bucket& b = buckets_[current_ % kBuckets];
      if (list_position_ < b.lists.size() || vertex_position_ < b.vertices.size()) return true;
      spare_.give(b.lists);
      spare_.give(b.vertices);
      list_position_ = vertex_position_ = 0;
      if (empty()) current_ = std::max(current_, last);
      if (current_ >= last) return false;
      advance(last);
    }
  }
  // Takes the next event of the buckets up to number `last`; false where there is none.
  [[gnu::always_inline]] bool pop(std::int64_t last, Event& event) {
    do {
      Bucket& b = buckets_[current_ % kBuckets];
      if (list_position_ < b.lists.size()) {
        --near_count_;
        event = {0, b.lists[list_position_++], true};
        return true;
      }
      if (vertex_position_ < b.vertices.size()) {
        --near_count_;
        event = {0, b.vertices[vertex_position_++], false};
        return true;
      }
    } while (advance_to(last));
    return false;
  }
  // The same, but once vertices are taken, all that are there: where hundreds of vertices side by side send light past
  // each other's edges, the lists that one sends would go round all of the others before these had their turn.
  bool pop_by_turns(std::int64_t last, Event& event) {
    do {
      Bucket& b = buckets_[current_ % kBuckets];
      const bool lists = list_position_ < b.lists.size(), vertices = vertex_position_ < b.vertices.size();
      vertices_turn_ = vertices && (vertices_turn_ || !lists);
      if (!lists && !vertices) continue;
      --near_count_;
      event =
          vertices_turn_ ? Event{0, b.vertices[vertex_position_++], false} : Event{0, b.lists[list_position_++], true};
      return true;
    } while (advance_to(last));
    return false;
  }
  // The number of the bucket of the next event, and how many events it holds.
  partition::Outlook outlook() const {
    partition::Outlook next;
    if (!far_.empty()) next.bucket = far_.front().bucket;
    if (near_count_ == 0) return next;
    std::int64_t n = current_;
    std::size_t taken = list_position_ + vertex_position_;
    while (buckets_[n % kBuckets].size() == taken) ++n, taken = 0;
    return n <= next.bucket ? partition::Outlook{n, buckets_[n % kBuckets].size() - taken} : next;
  }
  // The halfedge of the list event that is `ahead` places behind the next one, where known; for prefetching.
  Index peek_list(std::size_t ahead) const {
    const Bucket& b = buckets_[current_ % kBuckets];
    return list_position_ + ahead < b.lists.size() ? b.lists[list_position_ + ahead] : kNoIndex;
  }
  // Likewise of vertices.
  Index peek_vertex(std::size_t ahead) const {
    const Bucket& b = buckets_[current_ % kBuckets];
    return vertex_position_ + ahead < b.vertices.size() ? b.vertices[vertex_position_ + ahead] : kNoIndex;
  }

 private:
  static constexpr std::int64_t kBuckets = 1 << 10;
  struct Bucket {
    std::vector<Index> lists, vertices;
    std::size_t size() const { return lists.size() + vertices.size(); }
    void clear() {
      lists.clear();
      vertices.clear();
    }
  };

  // Memory of emptied buckets, for the next ones to be filled: few buckets hold events at a time. All are made as large
  // as the largest was, so that a run like the one before finds room enough whichever it takes.
  class Spare {
   public:
    void give(std::vector<Index>& events) {
      events.clear();
      if (events.capacity() == 0) return;
      largest_ = std::max(largest_, events.capacity());
      free_.emplace_back();
      free_.back().swap(events);
    }
    void take(std::vector<Index>& events) {
      if (free_.empty()) return;
      events.swap(free_.back());
      free_.pop_back();
      events.reserve(largest_);
    }

   private:
    std::vector<std::vector<Index>> free_;
    std::size_t largest_ = 0;
  };

  std::int64_t number(double key) const {
    constexpr double kLastBucket = 4e18;  // keys beyond what 64 bits count share the last bucket
    return static_cast<std::int64_t>(std::min(key * inverse_width_, kLastBucket));
  }

  [[gnu::always_inline]] void push(const Event& e, std::int64_t bucket) {
    const std::int64_t n = std::max(bucket, current_);
    if (n - current_ >= kBuckets) {
      push_far(e, n);
      return;
    }
    Bucket& b = buckets_[n % kBuckets];
    std::vector<Index>& events = e.is_list ? b.lists : b.vertices;
    if (events.capacity() == 0) spare_.take(events);
    events.push_back(e.index);
    ++near_count_;
  }
  void push_far(const Event& e, std::int64_t bucket) {
    far_.push_back({bucket, far_count_++, e.index, e.is_list});
    std::push_heap(far_.begin(), far_.end());
  }

  // The ring of buckets begins anew at multiples of its size, or where the next far event is if the ring is empty.
  void advance(std::int64_t last) {
    ++current_;
    if (far_.empty() || (near_count_ > 0 && current_ % (kBuckets / 2) != 0)) return;
    if (near_count_ == 0) current_ = std::max(current_, std::min(last, far_.front().bucket));
    while (!far_.empty() && far_.front().bucket - current_ < kBuckets) {
      std::pop_heap(far_.begin(), far_.end());
      const FarEvent e = far_.back();
      far_.pop_back();
      push({0, e.index, e.is_list}, e.bucket);
    }
  }

  // Beyond the ring: a heap, so that it is no matter how many there are, nor how far beyond.
  struct FarEvent {
    std::int64_t bucket;
    std::uint64_t number;  // in the order in which they came
    Index index;
    bool is_list;
    bool operator<(const FarEvent& o) const { return bucket > o.bucket || (bucket == o.bucket && number > o.number); }
  };

  std::vector<Bucket> buckets_;
  Spare spare_;
  std::vector<FarEvent> far_;
  std::uint64_t far_count_ = 0;
  std::int64_t current_ = 0;
  std::int64_t near_count_ = 0;
  std::size_t list_position_ = 0, vertex_position_ = 0;
  double inverse_width_ = 1;
  bool vertices_turn_ = false;
};

}  // namespace brushfire::windows
