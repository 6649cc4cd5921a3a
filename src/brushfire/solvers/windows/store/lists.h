// The windows that wait on the halfedges of faces: linked lists in one pool.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>
#include <brushfire/solvers/windows/store/prefetch.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// All windows that wait on one face are in one list, whose head is in the face's record (WindowFace::waiting); they are
// few. Those of a halfedge are taken together when it comes up in the queue. Freed places are used again, last one
// first, so that a run in steady state allocates nothing.
class WindowLists {
 public:
  // `bucket`: in which the window is to be taken (EventQueue::bucket_of). Returns true where no window of the halfedge
  // has waited for a bucket as early.
  [[gnu::always_inline]] bool push(Index& first, Index h, const Window& w, std::int64_t bucket) {
    std::int64_t earliest = std::numeric_limits<std::int64_t>::max();
    for (Index i = first; i != kNoIndex; i = pool_[i].next) {
      if (pool_[i].halfedge == h) {
        earliest = pool_[i].bucket;
        break;
      }
    }
    const Index place = allocate();
    Waiting& p = pool_[place];
    p.window = w;
    p.bucket = std::min(bucket, earliest);
    p.halfedge = h;
    p.next = first;
    first = place;
    return bucket < earliest;
  }

  // Takes the windows of h out of the list that begins with `first`: visit(window), last one first.
  template <class Visit>
  void take(Index& first, Index h, Visit&& visit) {
    Index* link = &first;
    while (*link != kNoIndex) {
      Waiting& p = pool_[*link];
      if (p.halfedge != h) {
        link = &p.next;
        continue;
      }
      visit(p.window);
      const Index place = *link;
      *link = p.next;
      p.next = free_;
      free_ = place;
    }
  }

  // Brings into the cache what take() will need.
  void prefetch_list(Index first) const {
    if (first == kNoIndex) return;
    const char* place = reinterpret_cast<const char*>(&pool_[first]);
    prefetch(place);
    prefetch(place + 64);
  }

  // The heads are left to the caller.
  void clear() {
    pool_.clear();
    free_ = kNoIndex;
  }

 private:
  struct Waiting {
    Window window;
    std::int64_t bucket = 0;  // the earliest of this window and those of the same halfedge behind it
    Index halfedge = kNoIndex;
    Index next = kNoIndex;
  };

  [[gnu::always_inline]] Index allocate() {
    if (free_ == kNoIndex) {
      pool_.emplace_back();
      return static_cast<Index>(pool_.size() - 1);
    }
    const Index place = free_;
    free_ = pool_[place].next;
    return place;
  }

  std::vector<Waiting> pool_;
  Index free_ = kNoIndex;  // freed places, linked by next
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
