// The order of events: buckets of equal width over the distance, first in first out within a bucket.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/partition/rounds.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace brushfire::windows {

// Two kinds of events: window lists (by halfedge) and vertices at which paths bend. A bucket's vertices come after its
// lists, so that they see final values and directions. Nothing depends on the order but speed: an event may come too
// early or twice. Keys below the current bucket go into it.
class EventQueue {
 public:
  // Keys beyond what 64 bits count share it.
  static constexpr std::int64_t kLastBucket = 4'000'000'000'000'000'000;

  // Buckets of this width from number `current` on; later ones may be pushed.
  void reset(double width, std::int64_t current) {
    buckets_.reset(current);
    inverse_width_ = 1 / width;
    taken_lists_ = taken_vertices_ = 0;
    vertices_turn_ = false;
  }

  bool empty() const { return buckets_.size() == taken(); }
  // Whether the two keys fall into one bucket.
  bool same_bucket(double a, double b) const { return bucket_of(a) == bucket_of(b); }
  std::int64_t bucket_of(double key) const {
    return static_cast<std::int64_t>(std::min(key * inverse_width_, static_cast<double>(kLastBucket)));
  }

  void push_list(Index h, double key) { push_list_into(bucket_of(key), h); }
  void push_list_into(std::int64_t bucket, Index h) { buckets_.push(h, bucket, kLists); }
  void push_vertex(Index v, double key) { buckets_.push(v, bucket_of(key), kVertices); }

  struct Event {
    Index index;
    bool is_list;
  };
  // Goes on to the next bucket with events up to number `last`; false where there is none.
  bool advance_to(std::int64_t last) {
    while (taken() == buckets_.size_of(buckets_.cursor())) {
      buckets_.clear_current();
      taken_lists_ = taken_vertices_ = 0;
      if (buckets_.cursor() >= last) return false;
      buckets_.move_to(std::min(buckets_.next(), last));
    }
    return true;
  }
  // Takes the next event of the buckets up to number `last`; false where there is none.
  [[gnu::always_inline]] bool pop(std::int64_t last, Event& event) {
    do {
      if (taken_lists_ < lists().size()) {
        event = {lists()[taken_lists_++], true};
        return true;
      }
      if (taken_vertices_ < vertices().size()) {
        event = {vertices()[taken_vertices_++], false};
        return true;
      }
    } while (advance_to(last));
    return false;
  }
  // The same, but once vertices are taken, all that are there: where hundreds of vertices side by side send light past
  // each other's edges, the lists that one sends would go round all of the others before these had their turn.
  bool pop_by_turns(std::int64_t last, Event& event) {
    do {
      const bool has_lists = taken_lists_ < lists().size(), has_vertices = taken_vertices_ < vertices().size();
      vertices_turn_ = has_vertices && (vertices_turn_ || !has_lists);
      if (!has_lists && !has_vertices) continue;
      event = vertices_turn_ ? Event{vertices()[taken_vertices_++], false} : Event{lists()[taken_lists_++], true};
      return true;
    } while (advance_to(last));
    return false;
  }
  // The number of the bucket of the next event, and how many events it holds. Between rounds: no bucket is half taken.
  partition::Outlook outlook() const {
    assert(taken() == 0);
    const std::int64_t next = buckets_.next();
    return {next, buckets_.size_of(next)};
  }
  // The halfedge of the list event that is `ahead` places behind the next one, where known; for prefetching.
  Index peek_list(std::size_t ahead) const { return peek(lists(), taken_lists_ + ahead); }
  // Likewise of vertices.
  Index peek_vertex(std::size_t ahead) const { return peek(vertices(), taken_vertices_ + ahead); }

 private:
  enum Kind : std::size_t { kLists, kVertices };

  const Pile& lists() const { return buckets_.current(kLists); }
  const Pile& vertices() const { return buckets_.current(kVertices); }
  static Index peek(const Pile& pile, std::size_t i) { return i < pile.size() ? pile[i] : kNoIndex; }
  std::size_t taken() const { return taken_lists_ + taken_vertices_; }

  BasicBucketQueue<2, 1 << 10> buckets_;
  std::size_t taken_lists_ = 0, taken_vertices_ = 0;  // of the current bucket
  double inverse_width_ = 1;
  bool vertices_turn_ = false;
};

}  // namespace brushfire::windows
