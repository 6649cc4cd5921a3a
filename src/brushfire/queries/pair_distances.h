// Distances of many pairs of vertices of one mesh, such as where a correspondence puts vertices and where they belong.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const std::vector<std::array<brushfire::Index, 2>> pairs{{0, 1}, {0, 2}, {1, 2}};
//     const std::vector<double> apart = brushfire::pair_distances(mesh, pairs);
//     std::printf("from vertex 1 to vertex 2: %g\n", apart[2]);
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/queries/distance_matrix.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// From the first vertex of each pair to the second: [pairs], in the mesh's units; +inf where nothing leads.
//
// Pairs are grouped by where they start: one run for each such vertex, which stops when it has reached the ends of its
// pairs. Without weights the distance is the same in both directions (for Method::Exact to rounding, for others to
// their error), and runs start at whichever side of all pairs has fewer vertices. What a pair gets does not depend on
// the number of threads. `options.distance` as for a matrix. Throws Error(IndexOutOfRange) for a vertex that there is
// not, and what distance() throws.
std::vector<double> pair_distances(const Domain& domain, std::span<const std::array<Index, 2>> pairs,
                                   const MatrixOptions& options = {});

// What distances are divided by where meshes of different sizes are compared: the square root of the area of the
// surface, the whole of it. Throws Error(InvalidArgument) where it has none.
double root_of_area(const Mesh& mesh);

}  // namespace brushfire
