// Puts the sides and triangles around one vertex into blocks.
#pragma once

#include <brushfire/core/populate.h>
#include <brushfire/solvers/fast_marching/ring_blocks.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <brushfire/solvers/fast_marching/vector_target.h>

namespace brushfire::detail {

// A triangle (v; a, b) with v in the origin of its plane: |a|, |b|, a . b, |a x b|.
struct Corner {
  Index a = kNoIndex, b = kNoIndex;  // places
  double length_a = 0, length_b = 0, dot = 0, cross = 0;

  Corner mirrored() const { return {b, a, length_b, length_a, dot, cross}; }
};

// Writes blocks one after the other. The block at hand is the last one.
template <class T>
class LaneWriter {
 public:
  // `none`: the end of sides that are not there; `expected` blocks (there may be more).
  LaneWriter(Index none, std::size_t expected) : none_(none) {
    grow(expected + 1);
    populate_more();
  }

  // Corners of which each ends on the side where the next one begins; `closed`: the last one on that of the first.
  void add_fan(std::span<const Corner> fan, bool closed) {
    const Index count = static_cast<Index>(fan.size());
    if (count_ + count + (closed ? 0 : 1) > kLanes) finish();
    if (closed && count <= kLanes) {
      const Index first = count_;
      for (const Corner& c : fan) add_triangle(c, count_ + 1 < first + count ? count_ + 1 : first);
      return;
    }
    for (Index i = 0; i < count;) {
      const Index room = kLanes - 1 - count_;  // one stays for the side that ends the piece
      for (const Index end = std::min(count, i + room); i < end; ++i) add_triangle(fan[i], count_ + 1);
      add_edge(fan[i - 1].b, fan[i - 1].length_b);
      if (i < count) finish();
    }
  }

  // A side without a triangle.
  void add_edge(Index a, double length) {
    if (count_ == kLanes) finish();
    set({a, none_, length, 0, kNan, 0}, count_);
  }

  // An unfolded triangle, whose second side may be one of those that are there. It offers values to its first end.
  void add_unfolded(const Corner& c) {
    Index second = second_side(c);
    if (count_ + (second == kLanes ? 2 : 1) > kLanes) {
      finish();
      second = kLanes;
    }
    const bool there = second < kLanes;
    add_triangle(c, there ? second : count_ + 1);
    if (!there) add_edge(c.b, c.length_b);
  }

  // A whole block of which so many sides are used; no other one has been begun.
  BRUSHFIRE_INLINE void add_block(const RingBlock<T>& block, const LaneLinks& links, Index count) {
    blocks_[done_] = block;
    links_[done_] = links;
    count_ = filled_ = count;
  }

  // Completes the block that has been begun; the next one follows it.
  BRUSHFIRE_INLINE void finish() {
    if (count_ == 0) return;
    complete();
    count_ = filled_ = 0;
    if (++done_ == blocks_.size()) grow(done_ + done_ / 2);
    if (done_ == populated_) populate_more();
  }

  Index blocks_done() const { return done_; }
  const RingBlock<T>& block(Index i) const { return blocks_[i]; }

  // All blocks, once.
  void take(UninitializedArray<RingBlock<T>>& blocks, UninitializedArray<LaneLinks>& links) {
    blocks_.resize(done_);
    links_.resize(done_);
    blocks = std::move(blocks_);
    links = std::move(links_);
  }

 private:
  // Of a whole block the rest is blank already.
  void complete() {
    while (filled_ == 0 && count_ < kLanes) add_edge(none_, kInfinity);
  }

  // No triangles.
  static constexpr LaneLinks kAlone = {{0x00, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}};

  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

  void add_triangle(const Corner& c, Index second) { set(c, second); }

  // The side that ends where the second one of c does, at that length (those of unfolded sides are computed another way
  // than those of edges); kLanes: none.
  Index second_side(const Corner& c) const {
    if (count_ == 0) return kLanes;
    constexpr T kSame = 16 * std::numeric_limits<T>::epsilon();
    const RingBlock<T>& block = blocks_[done_];
    std::uint32_t sides = 0;  // whose ends are that one; what lies behind the used ones was never written
    for (Index k = 0; k < count_; ++k) sides |= (block.end[k] == c.b ? 1u : 0u) << k;
    for (; sides != 0; sides &= sides - 1) {
      const auto k = static_cast<Index>(std::countr_zero(sides));
      if (std::abs(block.length[k] - static_cast<T>(c.length_b)) <= kSame * block.length[k]) return k;
    }
    return kLanes;
  }

  void set(const Corner& c, Index second) {
    RingBlock<T>& block = blocks_[done_];
    if (count_ == 0) std::fill_n(block.end, kLanes, none_), links_[done_] = kAlone;
    block.end[count_] = c.a;
    block.length[count_] = static_cast<T>(c.length_a);
    block.dot[count_] = static_cast<T>(c.dot);
    block.cross[count_] = static_cast<T>(c.cross);
    LaneLinks& links = links_[done_];
    links.links[count_] = static_cast<std::uint8_t>((links.links[count_] & 0xf0) | second);
    if (second != count_ && links.back(second) == second) {
      links.links[second] = static_cast<std::uint8_t>(links.second(second) | count_ << 4);
    }
    ++count_;
  }

  // Some megabytes ahead, and no more than there is room for.
  void populate_more() {
    constexpr std::size_t kBlocks = (std::size_t{2} << 20) / sizeof(RingBlock<T>);
    const std::size_t count = std::min(kBlocks, blocks_.size() - done_);
    populate(&blocks_[done_], count * sizeof(RingBlock<T>));
    populated_ = done_ + static_cast<Index>(kBlocks);
  }

  void grow(std::size_t size) {
    blocks_.resize(size);
    links_.resize(size);
  }

  UninitializedArray<RingBlock<T>> blocks_;
  UninitializedArray<LaneLinks> links_;
  Index none_, done_ = 0;         // blocks that are complete
  Index populated_ = 0;           // where pages are present up to
  Index count_ = 0, filled_ = 0;  // sides of the one at hand, and how many of them came by filled()
};

}  // namespace brushfire::detail
