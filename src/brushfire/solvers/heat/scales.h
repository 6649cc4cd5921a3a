// How large the components of a triangulation are: so that one beside another a thousand times its size is neither
// drowned in rounding nor in what is done for the other.
//
// Based on: Sharp, Crane, "A Laplacian for nonmanifold triangle meshes", 2020 (mollification).
#pragma once

#include <brushfire/mesh/detail/components.h>
#include <brushfire/solvers/heat/triangulation.h>

#include <vector>

namespace brushfire::heat {

// [components.count] the mean over the edges of each.
std::vector<double> mean_edge_lengths(const Triangulation& t, const detail::Components& components);

// [components.count] which of them are as good as a point, by their lengths before mollification: the products of such
// lengths are no numbers. (The mesh's own unit is about its largest length.)
std::vector<bool> points_among(const Triangulation& t, const detail::Components& components);

// Adds to every edge of a component the same length, the least after which in every triangle the sum of two edges
// exceeds the third by `share` of the component's mean edge: nothing at all on sound meshes, and no triangle without
// area afterwards. A point becomes triangles of that share of the whole mesh's mean edge.
void mollify(Triangulation& t, const detail::Components& components, double share = 1e-5);

// Times in units of a component's squared mean edge within which both equations keep their digits: past the one end
// heat is the same everywhere, past the other there is none beyond an edge.
inline constexpr double kLeastFactor = 1e-12, kLargestFactor = 1e6;

struct Times {
  double all = 1;          // that of the mesh, in mesh.unit() squared
  std::vector<double> of;  // [components.count] the same, brought into the range above
};

// `time` in mesh.unit() squared, or time_factor times the squared mean of all edges where that is 0. Throws
// Error(InvalidArgument) for a time out of the range.
Times times_of(const Triangulation& t, const detail::Components& components, double time_factor, double time);

}  // namespace brushfire::heat
