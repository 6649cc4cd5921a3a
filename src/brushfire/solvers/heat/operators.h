// The matrices of the heat method on a triangulation: the cotangent Laplacian and the lumped masses.
//
// Based on: Pinkall, Polthier, "Computing discrete minimal surfaces and their conjugates", 1993.
#pragma once

#include <brushfire/solvers/heat/cholesky.h>
#include <brushfire/solvers/heat/triangulation.h>

#include <vector>

namespace brushfire::heat {

// What the matrices on one triangulation have in common. Sums over the sheets are divided by their number: both are
// those of the surface, in mesh.unit().
struct Operators {
  Pattern pattern;
  std::vector<double> laplacian;  // [pattern.row] positive semidefinite: its off-diagonal entries are <= 0 on Delaunay
  std::vector<double> mass;       // [vertex_count] a third of the area of the triangles around
  std::vector<int> edge_entry;  // [halfedges] the entry of its two ends, the diagonal's of its tail where they are one
};

Operators operators_of(const Triangulation& t);

}  // namespace brushfire::heat
