// The triangles around every vertex, laid out for vector registers and in an order that keeps neighbours close.
#pragma once

#include <brushfire/core/uninitialized.h>
#include <brushfire/mesh/mesh.h>

#include <cstddef>
#include <vector>

namespace brushfire::detail {

inline constexpr Index kLanes = 8;

// Eight triangles (v; a, b) of one vertex v, real or unfolded: in the plane of the triangle, with v in the origin,
// |a|, |b|, a . b and a x b. Negative |a|: the corner at a is obtuse and no unfolding splits it (see UpdateTriangle,
// any_order); the same for b. A lane that is no triangle but an edge va has |b| = +inf and a . b = NaN; an unused lane
// has |a| = +inf, too. Both name the vertex beyond the last for what they lack.
template <class T>
struct alignas(64) RingBlock {
  Index a[kLanes], b[kLanes];
  T length_a[kLanes], length_b[kLanes], dot[kLanes], cross[kLanes];
};

// Where the blocks of each vertex are, and which place each vertex has: everything that does not depend on T.
struct RingLayout {
  std::vector<Index> place;         // [vertex_count] of each vertex in the internal order
  std::vector<Index> vertex;        // [vertex_count] the inverse
  std::vector<Index> block_offset;  // [vertex_count + 1] by place
  double mean_edge = 1;             // in mesh.unit()
  int longest_unfolding = 1;        // faces that the longest unfolding of a corner crosses
};

template <class T>
struct Rings {
  RingLayout layout;
  UninitializedArray<RingBlock<T>> blocks;
  std::vector<T> bend;  // [vertex_count] by place: by how much the curvature of a front falls that passes the vertex
};

// O(vertices + faces), and what the unfolding of obtuse corners takes.
template <class T>
Rings<T> build_rings(const Mesh& mesh);

extern template Rings<float> build_rings<float>(const Mesh& mesh);
extern template Rings<double> build_rings<double>(const Mesh& mesh);

}  // namespace brushfire::detail
