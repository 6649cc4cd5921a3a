// An order of vertices and faces in which neighbours on the surface are near each other in memory.
//
// Solvers renumber by it inside; no user ever sees the new numbers.
#pragma once

#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <span>

namespace brushfire {

struct VertexOrder {
  UninitializedArray<Index> vertices;     // [vertex_count] the vertex at each place: new number to old
  UninitializedArray<Index> vertex_rank;  // [vertex_count] the place of each vertex: old number to new
};

struct LocalityOrder : VertexOrder {
  UninitializedArray<Index> faces;  // [face_count] new to old, by the least place of a face's vertices, then by number
};

// Along a Hilbert curve through the bounding cube of the positions (2^10 cells a side, 2^8 below 2^17 vertices);
// breadth first, from the lowest vertex of each component, where the mesh has no positions. Ties by number, so the
// result is unique. O(vertices + faces): a radix sort.
LocalityOrder locality_order(const Mesh& mesh);

// Its vertices alone, and its faces from old to new, once the vertices are known.
VertexOrder vertex_locality_order(const Mesh& mesh);
UninitializedArray<Index> face_ranks(std::span<const Face> faces, std::span<const Index> vertex_rank);

// Whether the numbers that a mesh has will do: nearly all edges, and faces that follow each other, join vertices with
// near numbers. Looks at some thousand faces.
bool is_local(const Mesh& mesh);

}  // namespace brushfire
