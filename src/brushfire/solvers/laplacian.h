// The Laplacian of any triangle mesh, for other programs to build on: cotangents, intrinsic Delaunay triangulation.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>

#include <vector>

namespace brushfire {

struct Laplacian {
  // Both triangles and the diagonal, columns ascending. Symmetric, rows sum to 0, positive semidefinite; with
  // `delaunay` no entry off the diagonal is above 1e-6.
  std::vector<Index> row, column;
  std::vector<double> value;
  std::vector<double> mass;  // [rows] a third of the area around each vertex, in units of the mesh squared
};

// Of any mesh: borders, edges of three faces and mirrored faces by way of the tufted cover, faces without area by
// mollification. delaunay false: on the faces as they are, where weights may be negative. In a domain with walls rows
// are vertices of domain.open(), so that nothing passes a wall: those of the mesh, then further sides of vertices that
// walls part. O(vertices + faces).
//
// Based on: Sharp, Crane, "A Laplacian for nonmanifold triangle meshes", 2020.
Laplacian laplacian_of(const Domain& domain, bool delaunay = true);

}  // namespace brushfire
