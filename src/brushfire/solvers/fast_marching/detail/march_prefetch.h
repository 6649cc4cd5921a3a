// What the march will need soon, asked for ahead of time.
#pragma once

#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/fast_marching/detail/march_state.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>

#include <cstddef>

namespace brushfire::fast_marching {

// What a vertex that comes up soon will need: first what says where its further blocks are, then the blocks.
template <class T>
BRUSHFIRE_INLINE void prefetch_state(const Rings<T>& rings, const MarchState<T>& s, Index v) {
  prefetch(&s.front_at[v]);
  prefetch(&rings.heads[v]);
  prefetch(&s.open[v]);
}
template <class T>
BRUSHFIRE_INLINE void prefetch_block(const RingBlock<T>& block) {
  constexpr std::size_t kCacheLine = 64;
  const char* const at = reinterpret_cast<const char*>(&block);
  for (std::size_t i = 0; i < sizeof block; i += kCacheLine) prefetch(at + i);
}
template <class T>
BRUSHFIRE_INLINE void prefetch_blocks(const Rings<T>& rings, Index v) {
  if (v >= rings.layout.vertex_count) return;  // a ghost
  prefetch(&rings.layout.links[v]);
  prefetch_block(rings.blocks[v]);
  const Index more = rings.heads[v].more;  // none: block 0, which does no harm
  prefetch(&rings.layout.links[more]);
  prefetch_block(rings.blocks[more]);
}
// The values at the ends of the sides in its first block.
template <class T>
BRUSHFIRE_INLINE void prefetch_ends(const Rings<T>& rings, const MarchState<T>& s, Index v) {
  if (v >= rings.layout.vertex_count) return;
  for (const Index end : rings.blocks[v].end) prefetch(&s.front_at[end]);
}

inline constexpr std::size_t kStatesAhead = 12, kBlocksAhead = 5, kEndsAhead = 2;

template <class T>
BRUSHFIRE_INLINE void prefetch_after(const Rings<T>& rings, const MarchState<T>& s, const Pile& bucket, std::size_t i) {
  if (i + kStatesAhead < bucket.size()) prefetch_state(rings, s, bucket[i + kStatesAhead]);
  if (i + kBlocksAhead < bucket.size()) prefetch_blocks(rings, bucket[i + kBlocksAhead]);
  if (i + kEndsAhead < bucket.size()) prefetch_ends(rings, s, bucket[i + kEndsAhead]);
}

}  // namespace brushfire::fast_marching
