// The triangles around every vertex, laid out for vector registers.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/targets.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/fast_marching/detail/face_costs.h>
#include <brushfire/solvers/partition/vertex_partition.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace brushfire::fast_marching {

inline constexpr Index kLanes = 8;

// Up to eight sides from one vertex v to others, and the triangles between them, real or unfolded. Triangle k has side
// k (its end: a) and the side that LaneLinks names (its end: b); in its plane, with v in the origin: |a|, a . b and |a
// x b|. A side that is no triangle's first has dot = NaN; an unused one has |a| = +inf, too, and ends in the vertex
// beyond the last.
template <class T>
struct alignas(64) RingBlock {
  Index end[kLanes];
  T length[kLanes], dot[kLanes], cross[kLanes];
};

// How the sides of a block make triangles, a byte for each.
struct LaneLinks {
  // Bits 0-2 of links[k]: the second side of triangle k (k itself: no triangle). Bits 4-6: the triangle whose second
  // side is side k (k itself: none). Bit 3: the corner at the end of the first side is obtuse and no unfolding splits
  // it (see FrontOverEdge, any_order); bit 7: the same at the end of the second.
  std::uint8_t links[kLanes];

  static constexpr std::uint8_t kAnyOrderFirst = 8, kAnyOrderSecond = 128;
  Index second(Index k) const { return links[k] & 7u; }
  Index back(Index k) const { return links[k] >> 4 & 7u; }
  bool any_order_first(Index k) const { return (links[k] & kAnyOrderFirst) != 0; }
  bool any_order_second(Index k) const { return (links[k] & kAnyOrderSecond) != 0; }
};

// What does not depend on T.
struct RingLayout {
  Index vertex_count = 0;
  UninitializedArray<LaneLinks> links;  // [blocks]
  std::vector<Index> next;              // [blocks beyond the first ones] the vertex's next one; 0: none
  double mean_edge = 1;                 // in mesh.unit()
  int longest_unfolding = 1;            // faces that the longest unfolding of a corner crosses
  partition::VertexPartition parts;
};

// Block v is the first one of vertex v; further ones follow those of all vertices.
template <class T>
struct Rings {
  struct Head {
    T correction = 0;  // by how much the curvature of a front falls that passes the vertex
    Index more = 0;    // its second block; 0: none
  };

  RingLayout layout;
  UninitializedArray<RingBlock<T>> blocks;
  UninitializedArray<Head> heads;  // [places] ghosts have no blocks

  // The block of v that comes after block i; 0: none.
  BRUSHFIRE_INLINE Index next_block(Index v, Index i) const {
    return i == v ? heads[v].more : layout.next[i - layout.vertex_count];
  }
};

// O(vertices + faces), and what the unfolding of obtuse corners takes. The mesh should be in a local order. Results
// depend on the size of the parts, a power of two; kNoIndex: the whole mesh. With costs corners are unfolded into a
// face of the same weight only, and each weight around a vertex has sides of its own.
template <class T>
Rings<T> build_rings(const Mesh& mesh, Index part_size, Variant variant = Variant::Best, const FaceCosts& costs = {});

extern template Rings<float> build_rings<float>(const Mesh& mesh, Index part_size, Variant variant,
                                                const FaceCosts& costs);
extern template Rings<double> build_rings<double>(const Mesh& mesh, Index part_size, Variant variant,
                                                  const FaceCosts& costs);

}  // namespace brushfire::fast_marching
