// Which faces meet at which vertex and over which edge: counting sorts over the index array, no hash maps.
#pragma once

#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/mesh/mesh.h>

#include <span>
#include <vector>

namespace brushfire::detail {

// The corners at each vertex: corners[offset[v] .. offset[v+1]), ascending.
struct VertexCorners {
  UninitializedArray<Index> offset;  // [vertex_count + 1]
  UninitializedArray<Index> corner;  // [halfedge_count]
  Index count(Index v) const { return offset[v + 1] - offset[v]; }
};

VertexCorners build_corners(Index vertex_count, std::span<const Face> faces);

// The ring over each edge (Mesh::opposite), ascending around each ring. O(halfedges x faces at a vertex) at worst;
// linear where valences are bounded.
UninitializedArray<Index> build_opposite(std::span<const Face> faces, const VertexCorners& corners);

// Makes every halfedge of the ring of h its own opposite.
void open_ring(Index h, UninitializedArray<Index>& opposite);

std::vector<Link> build_links(std::span<const Face> faces, const VertexCorners& corners,
                              std::span<const Index> opposite);

}  // namespace brushfire::detail
