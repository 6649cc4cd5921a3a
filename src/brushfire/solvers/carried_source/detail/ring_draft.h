// The sides and the updates of a regular ring, before they are written.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/solvers/carried_source/detail/need.h>
#include <brushfire/solvers/carried_source/detail/record_draft.h>
#include <brushfire/solvers/carried_source/detail/sides.h>

#include <cstdint>

namespace brushfire::carried_source {

// What the end of a ring's side knows of the way back, and of the two updates whose target it is: over the edge before
// the side, and over the one behind it.
template <class T>
struct RingEnd {
  T c, s;
  SightSets sets;
  std::uint8_t sector, bends;
  bool takes_ahead, takes_behind;
  std::uint32_t ahead, behind;                    // what it says of these, as bits of an Update
  std::uint32_t supports_ahead, supports_behind;  // and of the updates that it supports, of the sides around it
};

// A ring's sides, and its corners.
template <class T>
struct DraftRing {
  Index count;
  const RingSide<T>* side[kLanes];
  Index end_vertex[kLanes];
  RingEnd<T> end[kLanes];
  // Of corners: both sides, and across; 1 where there is no more corner.
  alignas(32) T first[kLanes], second[kLanes], across[kLanes];
  // Of its two updates.
  alignas(32) T need_ahead[kLanes], bulge_ahead[kLanes], need_behind[kLanes], bulge_behind[kLanes];
};

template <class T>
BRUSHFIRE_INLINE void look_from_ring(const RingSide<T>& there, const RingSide<T>& next, RingEnd<T>& e, T& across) {
  e.c = there.c, e.s = there.s, across = next.length;
  e.sets = there.sets;
  e.sector = there.number, e.bends = there.bends ? 1 : 0;
  e.takes_ahead = !there.is_split, e.takes_behind = !next.is_split;
  e.ahead = std::uint32_t{there.number} << Update::kSectorShift | Update::kSameTurn;
  e.behind = std::uint32_t{next.number} << Update::kSectorShift | (next.next() == 0 ? Update::kSeam : 0);
  e.supports_ahead = Update::kThere, e.supports_behind = 0;
}

template <class T>
BRUSHFIRE_INLINE void find_needs(DraftRing<T>& ring) {
  using V = lanes::portable::Lanes<T, kLanes>;
  using lanes::portable::load, lanes::portable::store;
  const V first = load<V>(ring.first), second = load<V>(ring.second), across = load<V>(ring.across);
  const Need<V> ahead = need_of(second, across, first), behind = need_of(first, across, second);
  store(ring.need_ahead, ahead.need), store(ring.bulge_ahead, ahead.bulge);
  store(ring.need_behind, behind.need), store(ring.bulge_behind, behind.bulge);
}

// Over the edge before the side, and over the one behind it.
template <class T>
BRUSHFIRE_INLINE RingUpdate<T> ahead(const DraftRing<T>& ring, Index i, Index before) {
  const std::uint32_t bits = ring.end[i].ahead | ring.end[before].supports_ahead | (i == 0 ? Update::kAcross : 0);
  return {before, bits, ring.first[before], {ring.need_ahead[before], ring.bulge_ahead[before]}};
}
template <class T>
BRUSHFIRE_INLINE RingUpdate<T> behind(const DraftRing<T>& ring, Index i, Index next) {
  const std::uint32_t bits =
      ring.end[i].behind | ring.end[next].supports_behind | Update::kHere | (next == 0 ? Update::kAcross : 0);
  return {next, bits, ring.first[next], {ring.need_behind[i], ring.bulge_behind[i]}};
}

}  // namespace brushfire::carried_source
