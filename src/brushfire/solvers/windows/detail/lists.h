// The windows that wait on each halfedge: linked lists in one pool.
#pragma once

#include <brushfire/solvers/windows/detail/prefetch.h>
#include <brushfire/solvers/windows/detail/window.h>

#include <vector>

namespace brushfire::detail {

// A list is taken as a whole, when its halfedge's turn has come. Freed windows are used again, last one first, so that
// a run in steady state allocates nothing.
class WindowLists {
 public:
  explicit WindowLists(Index halfedge_count) : first_(halfedge_count, kNoIndex) {}

  bool empty(Index h) const { return first_[h] == kNoIndex; }
  // The least key of the list's windows; the list must not be empty.
  double key(Index h) const { return keys_[first_[h]]; }

  // Returns true where the list's least key has fallen (or there was no list).
  bool push(Index h, const Window& w, double key) {
    const Index head = first_[h];
    const Index slot = allocate();
    const bool lower = head == kNoIndex || key < keys_[head];
    pool_[slot] = w;
    pool_[slot].next = head;
    keys_[slot] = lower ? key : keys_[head];
    first_[h] = slot;
    return lower;
  }

  // Moves the list of h to the end of `out`.
  void take(Index h, std::vector<Window>& out) {
    Index slot = first_[h];
    first_[h] = kNoIndex;
    while (slot != kNoIndex) {
      out.push_back(pool_[slot]);
      const Index next = pool_[slot].next;
      pool_[slot].next = free_;
      free_ = slot;
      slot = next;
    }
  }

  // The only window of h, if there is exactly one: moves it to `out`.
  bool take_single(Index h, Window& out) {
    const Index slot = first_[h];
    if (pool_[slot].next != kNoIndex) return false;
    first_[h] = kNoIndex;
    out = pool_[slot];
    pool_[slot].next = free_;
    free_ = slot;
    return true;
  }

  // Brings into the cache what push() and take() will need.
  void prefetch_head(Index h) const { prefetch(&first_[h]); }
  void prefetch_list(Index h) const {
    if (first_[h] == kNoIndex) return;
    const char* window = reinterpret_cast<const char*>(&pool_[first_[h]]);
    prefetch(window);
    prefetch(window + 64);
  }

  // The most windows that ever waited at once.
  std::size_t peak() const { return pool_.size(); }
  void clear() {
    std::fill(first_.begin(), first_.end(), kNoIndex);
    pool_.clear();
    keys_.clear();
    free_ = kNoIndex;
  }

 private:
  Index allocate() {
    if (free_ == kNoIndex) {
      pool_.emplace_back();
      keys_.push_back(0);
      return static_cast<Index>(pool_.size() - 1);
    }
    const Index slot = free_;
    free_ = pool_[slot].next;
    return slot;
  }

  std::vector<Index> first_;  // [halfedge_count]
  std::vector<Window> pool_;  // [slot]
  std::vector<double> keys_;  // [slot] least key from here to the list's end
  Index free_ = kNoIndex;     // freed slots, linked by Window::next
};

}  // namespace brushfire::detail
