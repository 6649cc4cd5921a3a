// What a record is made of before it is written, and what writes it.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/solvers/carried_source/detail/need.h>
#include <brushfire/solvers/carried_source/detail/records.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace brushfire::carried_source {

template <class T>
struct DraftSide {
  Index end;
  DarkSets dark;
  Side<T> side;
};

template <class T>
struct DraftUpdate {
  std::uint64_t order;  // by target, then support, then sector
  std::uint32_t bits;   // of an Update, but for the support
  T length;             // of the edge
  Need<T> need;

  Index target() const { return static_cast<Index>(order >> 32); }
  Index support() const { return static_cast<Index>(order) >> 4; }
};
template <class T>
BRUSHFIRE_INLINE DraftUpdate<T> update_of(Index support, Index target, std::uint32_t bits, T length, Need<T> need) {
  const std::uint32_t sector = bits >> Update::kSectorShift & 15u;
  return {std::uint64_t{target} << 32 | support << 4 | sector, bits, length, need};
}
template <class T>
bool comes_before(const DraftUpdate<T>& a, const DraftUpdate<T>& b) {
  return a.order < b.order || (a.order == b.order && a.length < b.length);
}
// What a ring's side is offered over one of the edges beside it.
template <class T>
struct RingUpdate {
  Index support;
  std::uint32_t bits;
  T length;
  Need<T> need;
};

// Few, most of them in order.
template <class T>
void sort_updates(UninitializedArray<DraftUpdate<T>>& updates) {
  constexpr std::size_t kFew = 64;
  if (updates.size() > kFew) {
    return detail::sort(updates.begin(), updates.end(),
                        [](const auto& a, const auto& b) { return comes_before(a, b); });
  }
  for (std::size_t i = 1; i < updates.size(); ++i) {
    const DraftUpdate<T> u = updates[i];
    std::size_t at = i;
    for (; at > 0 && comes_before(u, updates[at - 1]); --at) updates[at] = updates[at - 1];
    updates[at] = u;
  }
}

// How much memory a record takes at most, and where its parts lie.
template <class T>
std::size_t aligned(std::size_t bytes) {
  return (bytes + alignof(Side<T>) - 1) / alignof(Side<T>) * alignof(Side<T>);
}
template <class T>
std::size_t most_bytes(Index sides, Index updates, bool has_lenses) {
  const std::size_t front = sizeof(RecordHead<T>) + (sides + 1) * sizeof(SideEnd<T>) + updates * sizeof(Update);
  const std::size_t back = sizeof(Side<T>) + sizeof(DarkSets) + (has_lenses ? sizeof(LensNumbers) : 0);
  return aligned<T>(aligned<T>(front) + sides * back);
}

template <class T>
DraftUpdate<T> as_draft(const RingUpdate<T>& u, Index target) {
  return update_of<T>(u.support, target, u.bits, u.length, u.need);
}

// What is written of a vertex: the ends of its sides one by one, with the updates of each. Handed on by value, so
// that it stays in registers.
template <class T>
struct RecordPen {
  SideEnd<T>* end;
  Update *update, *first;
  T reach = 0;
  SideEnd<T> side{};  // at hand

  BRUSHFIRE_INLINE void begin_side(Index vertex, T length) {
    side = {vertex, length, 0, static_cast<Index>(update - first)};
  }
  BRUSHFIRE_INLINE void put(const RingUpdate<T>& u) {
    *update++ = {u.bits | u.support << Update::kSupportShift};
    side.need = std::min(side.need, u.need.need), side.bulge = std::max(side.bulge, u.need.bulge);
    reach = std::max(reach, u.length);
  }
  BRUSHFIRE_INLINE void put(const DraftUpdate<T>& u) { put(RingUpdate<T>{u.support(), u.bits, u.length, u.need}); }
  BRUSHFIRE_INLINE void end_side() { *end++ = side; }
};

template <class T>
RecordPen<T> pen_at(std::byte* at, Index sides) {
  auto* const ends = reinterpret_cast<SideEnd<T>*>(at + sizeof(RecordHead<T>));
  auto* const updates = reinterpret_cast<Update*>(ends + sides + 1);
  return {ends, updates, updates};
}

}  // namespace brushfire::carried_source
