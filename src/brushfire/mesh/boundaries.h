// The boundary of a mesh as curves.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <span>
#include <vector>

namespace brushfire {

struct Boundary {
  std::vector<Index> vertices;  // in order, each joined to the next by a boundary edge
  double length = 0;            // in the mesh's units
  bool closed = false;          // the last one is joined to the first, which is not repeated
};

// Every edge of one face, put together: longest first, of equals the one with the lowest vertex. A curve goes on around
// the faces that meet it, so that where several touch in a vertex each stays one; it is closed unless edges of three
// and more faces are in the way. Each begins at its lowest vertex and, where faces are oriented alike, has the surface
// on its left. O(vertices + faces).
std::vector<Boundary> boundaries(const Mesh& mesh);

// The boundary of a region of faces (ascending): where it meets the rest of the mesh, and its share of the mesh's own
// boundary; in the mesh's vertex numbers. Throws Error(IndexOutOfRange) for a face that does not exist.
std::vector<Boundary> boundaries_of(const Mesh& mesh, std::span<const Index> faces);

}  // namespace brushfire
