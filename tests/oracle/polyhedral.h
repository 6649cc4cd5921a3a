// The truth: polyhedral distances on any triangle complex, in long double, by the simplest scheme that is exact.
//
// A tree of windows, taken from a queue in order of distance, as in "Shortest paths on a polyhedron" (Chen and Han
// 1990); a window is a wedge of straight rays that enters a face through one edge, together with the unfolded place
// of the vertex or source that the rays come from. No lists, no trimming of windows against each other. What makes
// the tree finite are four rules, and the reason why each of them is safe stands beside it in polyhedral.cpp.
// Meant to be read and believed, not to be fast: 10 to 100 times slower than a good solver.
#pragma once

#include "oracle/complex.h"

#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::oracle {

struct Truth {
  std::vector<Real> distance;  // [vertices]; infinity: unreachable, or farther than the radius
  std::vector<Real> target;    // [targets]
  std::uint64_t windows = 0;   // taken from the queue
};

// Distances from the nearest of the sources (distance plus offset) to all vertices and to `targets`.
Truth polyhedral_distance(const Mesh& mesh, std::span<const Source> sources, Real radius = kFar,
                          std::span<const SurfacePoint> targets = {});

}  // namespace brushfire::oracle
