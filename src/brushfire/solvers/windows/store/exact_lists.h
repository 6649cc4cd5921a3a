// The windows of an exact run: whole lists in blocks of columns, waiting at halfedges.
#pragma once

#include <brushfire/solvers/windows/algebra/columns.h>
#include <brushfire/solvers/windows/store/prefetch.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

inline constexpr std::size_t kLine = 64;  // of a cache, in bytes

// Memory for 4 << size_class windows, in whole lines, and kRoomBehind their last numbers.
struct WindowBlock {
  std::byte* data = nullptr;
  unsigned size_class = 0;

  Index capacity() const { return Index{4} << size_class; }
  std::size_t bytes() const {
    const std::size_t used = capacity() * (5 * sizeof(Real) + sizeof(Index)) + kRoomBehind * sizeof(Index);
    return (used + kLine - 1) / kLine * kLine;
  }
  WindowColumns columns() const {
    const std::size_t n = capacity();
    Real* const d = reinterpret_cast<Real*>(data);
    return {d, d + n, d + 2 * n, d + 3 * n, d + 4 * n, reinterpret_cast<Index*>(d + 5 * n)};
  }
};

// Blocks cut from chunks; freed ones are used again, so that a run in steady state allocates nothing.
class BlockPool {
 public:
  WindowBlock allocate(Index windows) {
    WindowBlock block;
    block.size_class = static_cast<unsigned>(std::bit_width((std::max(windows, Index{1}) - 1) >> 2));
    std::vector<std::byte*>& free = free_[block.size_class];
    if (free.empty()) {
      block.data = cut(block.bytes());
    } else {
      block.data = free.back();
      free.pop_back();
    }
    return block;
  }
  void release(const WindowBlock& block) { free_[block.size_class].push_back(block.data); }
  void clear();  // forgets all blocks, keeps the memory of the first chunk

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 18;  // bytes
  std::byte* cut(std::size_t bytes);
  static std::byte* first_line(std::vector<std::byte>& chunk);

  std::vector<std::vector<std::byte>> chunks_;
  std::byte* unused_ = nullptr;
  std::size_t left_ = 0;
  std::array<std::vector<std::byte*>, 32> free_;
};

// Where windows come to a halfedge from: in this order they lie from its start to its end, because shortest paths do
// not cross.
enum class Origin : std::uint8_t {
  Start,     // over the other edge at the halfedge's start
  Apex,      // from the vertex opposite, in the face behind
  End,       // over the other edge at the halfedge's end
  Anywhere,  // one by one from special faces and sources
};

// A list that is being worked on.
struct WindowList {
  WindowBlock block;
  Index size = 0;
  unsigned age = 0;     // how many faces its windows have crossed since they were last trimmed
  bool ordered = true;  // from left to right, as far as is known
  bool mixed = false;   // some may be linear

  WindowColumns columns() const {
    WindowColumns c = block.columns();
    c.mixed = mixed;
    return c;
  }
};

// What waits on the halfedges of faces: up to one list of each origin, more only where a list is known to be out of
// order. The lists of one face are linked, by halfedge and origin; the head is in the face's record
// (WindowFace::waiting).
class ExactLists {
 public:
  bool empty(Index first, Index h) const { return find(first, h) == kNoIndex; }
  // The key under which h's lists were queued last; infinity before that. Something must wait at h.
  Real& key(Index first, Index h) { return links_[find(first, h)].key; }

  // The list waits at h from now on; its block is the caller's no longer.
  void put(Index& first, Index h, Origin origin, const WindowList& list);
  void put(Index& first, Index h, Origin origin, const Window& w, BlockPool& blocks);
  // All that waits at h as one list, from origin to origin; something must. The caller releases the block.
  WindowList take(Index& first, Index h, BlockPool& blocks);

  void prefetch_list(Index first) const {
    if (first != kNoIndex) prefetch(&links_[first]);
  }
  void prefetch_windows(Index first) const;
  // The heads are left to the caller.
  void clear();

 private:
  struct Link {
    WindowList list;
    Real key = kInfinity;  // of a halfedge's first link
    Index halfedge = kNoIndex;
    Index next = kNoIndex;
    Origin origin = Origin::Start;
  };
  Index find(Index first, Index h) const {
    while (first != kNoIndex && links_[first].halfedge != h) first = links_[first].next;
    return first;
  }
  Index allocate_link() {
    const Index link = free_link_;
    if (link == kNoIndex) {
      links_.emplace_back();
      return static_cast<Index>(links_.size() - 1);
    }
    free_link_ = links_[link].next;
    return link;
  }

  std::vector<Link> links_;
  Index free_link_ = kNoIndex;  // freed ones, linked by next
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
