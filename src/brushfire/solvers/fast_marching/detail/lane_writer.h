// Puts the sides and triangles around vertices into blocks.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace brushfire::fast_marching {

// A triangle (v; a, b) with v in the origin of its plane: |a|, |b|, a . b, |a x b|.
struct Corner {
  Index a = kNoIndex, b = kNoIndex;  // places
  double length_a = 0, length_b = 0, dot = 0, cross = 0;

  Corner mirrored() const { return {b, a, length_b, length_a, dot, cross}; }
};

// Begins the rings of the vertices in ascending order, and adds to any that has been begun.
template <class T>
class LaneWriter {
 public:
  explicit LaneWriter(Index vertex_count) : none_(vertex_count) {
    grow(room_for(vertex_count));
    first_pages_ = {blocks_.data(), vertex_count * sizeof(RingBlock<T>)};
    heads_.reserve(std::size_t{vertex_count} + vertex_count / 4 + 1);  // ghosts will follow
    heads_.resize(vertex_count);
    prefault(heads_);
    next_.reserve(vertex_count / 2);
    prefault(links_.data(), vertex_count * sizeof(LaneLinks));
  }

  // Vertices up to `end` are about to begin their rings.
  void make_room(Index end) { first_pages_.reach(blocks_.data() + end); }
  // The first block of vertex v, and how its sides are linked: to be written.
  RingBlock<T>* first_block(Index v) { return blocks_.data() + v; }
  LaneLinks* first_links(Index v) { return links_.data() + v; }
  // The ring of v is what was written there, or empty.
  BRUSHFIRE_INLINE void begin(Index v) { heads_[v] = {}; }
  void begin_empty(Index v) {
    blank(v);
    begin(v);
  }

  // Corners of which each ends on the side where the next one begins; `closed`: the last one on that of the first.
  void add_fan(Index v, std::span<const Corner> fan, bool closed) {
    const Index count = static_cast<Index>(fan.size());
    Lane at = free_lane(v);
    if (at.lane > 0 && at.lane + count + (closed ? 0 : 1) > kLanes) at = next_block(v, at);
    if (closed && count <= kLanes) {
      const Index first = at.lane;
      for (const Corner& c : fan) set(at, c, at.lane + 1 < first + count ? at.lane + 1 : first);
      return;
    }
    for (Index i = 0; i < count;) {
      const Index room = kLanes - 1 - at.lane;  // one stays for the side that ends the piece
      for (const Index end = std::min(count, i + room); i < end; ++i) set(at, fan[i], at.lane + 1);
      set_edge(at, fan[i - 1].b, fan[i - 1].length_b);
      if (i < count) at = next_block(v, at);
    }
  }

  // A side without a triangle.
  void add_edge(Index v, Index a, double length) {
    Lane at = free_lane(v);
    if (at.lane == kLanes) at = next_block(v, at);
    set_edge(at, a, length);
  }

  // An unfolded triangle, whose second side may be one of those that are there. It is for updates of its first end.
  void add_unfolded(Index v, const Corner& c) {
    Lane at{v, free_lane_of(v)};
    Index second = second_side(at, c);
    if ((second == kLanes || at.lane == kLanes) && heads_[v].more != 0) {
      at = free_lane(v);  // those in between are full, or nearly
      second = second_side(at, c);
    }
    if (at.lane + (second == kLanes ? 2 : 1) > kLanes) {
      at = next_block(v, at);
      second = kLanes;
    }
    const bool there = second < kLanes;
    set(at, c, there ? second : at.lane + 1);
    if (!there) set_edge(at, c.b, c.length_b);
  }

  void prefetch_ring(Index v) const {
    prefetch(&blocks_[v]);
    prefetch(&blocks_[v].dot);
    prefetch(&links_[v]);
  }

  // All that was written, once.
  void take(Rings<T>& rings) {
    blocks_.resize(none_ + next_.size());
    links_.resize(none_ + next_.size());
    rings.blocks = std::move(blocks_);
    rings.heads = std::move(heads_);
    rings.layout.links = std::move(links_);
    rings.layout.next = std::move(next_);
    rings.layout.vertex_count = none_;
  }

 private:
  // Where the next side goes; lane kLanes: nowhere.
  struct Lane {
    Index block, lane;
  };

  static constexpr Index kLongRing = 8;  // blocks: the last one is remembered

  // In the last block of v.
  Lane free_lane(Index v) const {
    Index last = v, blocks = 0;
    for (Index i = heads_[v].more; i != 0; i = next_[i - none_]) {
      last = i;
      if (++blocks == kLongRing) return far_lane(v, i);
    }
    return {last, free_lane_of(last)};
  }
  // From block i on, or from where the last search has ended.
  [[gnu::noinline]] Lane far_lane(Index v, Index i) const {
    Index& last = last_blocks_.try_emplace(v, i).first->second;
    while (next_[last - none_] != 0) last = next_[last - none_];
    return {last, free_lane_of(last)};
  }
  Index free_lane_of(Index block) const {
    constexpr std::uint32_t kAll = 1u << kLanes;
    return static_cast<Index>(std::countr_zero(lanes_with(blocks_[block], none_) | kAll));
  }

  // The sides that end in w: a bit for each.
  static std::uint32_t lanes_with(const RingBlock<T>& block, Index w) {
    using namespace lanes::portable;
    return bits(load<Numbers8>(block.end) == w);
  }

  Lane next_block(Index v, Lane after) {
    const Index block = none_ + static_cast<Index>(next_.size());
    if (block == blocks_.size()) grow(blocks_.size() + blocks_.size() / 2);
    next_pages_.reach(&blocks_[block]);
    next_.push_back(0);
    blank(block);
    (after.block == v ? heads_[v].more : next_[after.block - none_]) = block;
    return {block, 0};
  }

  static constexpr T kNever = std::numeric_limits<T>::infinity(), kNone = std::numeric_limits<T>::quiet_NaN();

  void blank(Index i) {
    RingBlock<T>& block = blocks_[i];
    for (Index k = 0; k < kLanes; ++k) {
      block.end[k] = none_, block.length[k] = kNever, block.dot[k] = kNone, block.cross[k] = 0;
    }
    links_[i] = {{0x00, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}};  // no triangles
  }

  // The side that ends where the second one of c does, at that length (those of unfolded sides are computed another way
  // than those of edges); kLanes: none.
  Index second_side(Lane at, const Corner& c) const {
    constexpr T kSame = 16 * std::numeric_limits<T>::epsilon();
    const RingBlock<T>& block = blocks_[at.block];
    for (std::uint32_t sides = lanes_with(block, c.b); sides != 0; sides &= sides - 1) {
      const auto k = static_cast<Index>(std::countr_zero(sides));
      if (std::abs(block.length[k] - static_cast<T>(c.length_b)) <= kSame * block.length[k]) return k;
    }
    return kLanes;
  }

  void set_edge(Lane& at, Index a, double length) {
    RingBlock<T>& block = blocks_[at.block];
    block.end[at.lane] = a;
    block.length[at.lane] = static_cast<T>(length);
    ++at.lane;
  }

  void set(Lane& at, const Corner& c, Index second) {
    RingBlock<T>& block = blocks_[at.block];
    block.end[at.lane] = c.a;
    block.length[at.lane] = static_cast<T>(c.length_a);
    block.dot[at.lane] = static_cast<T>(c.dot);
    block.cross[at.lane] = static_cast<T>(c.cross);
    LaneLinks& links = links_[at.block];
    links.links[at.lane] = static_cast<std::uint8_t>((links.links[at.lane] & 0xf0) | second);
    if (links.back(second) == second) {
      links.links[second] = static_cast<std::uint8_t>(links.second(second) | at.lane << 4);
    }
    ++at.lane;
  }

  // What is not written costs nothing. glibc keeps freed memory up to twice the largest array that it has seen freed,
  // of those up to 32 megabytes; with two blocks a vertex that is more than a solver takes in all, which then need not
  // be asked for anew, page by page, by the next one.
  static std::size_t room_for(std::size_t vertex_count) {
    constexpr std::size_t kKept = std::size_t{32} << 20;
    const std::size_t two = 2 * vertex_count + 1;
    return two * sizeof(RingBlock<T>) < kKept ? two : vertex_count + vertex_count / 2 + 1;
  }

  void grow(std::size_t size) {
    blocks_.resize(size);
    links_.resize(size);
    const std::size_t written = none_ + next_.size();
    next_pages_ = {blocks_.data() + written, (size - written) * sizeof(RingBlock<T>)};
  }

  Index none_;                               // the end of sides that are not there
  UninitializedArray<RingBlock<T>> blocks_;  // the first ones of all vertices, then further ones
  UninitializedArray<LaneLinks> links_;      // [blocks]
  UninitializedArray<typename Rings<T>::Head> heads_;
  std::vector<Index> next_;
  mutable std::unordered_map<Index, Index> last_blocks_;  // of vertices with long rings, as far as they were gone along
  PagesAhead first_pages_, next_pages_;                   // of the first blocks, and of the others
};

}  // namespace brushfire::fast_marching
