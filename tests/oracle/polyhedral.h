// The truth: polyhedral distances on any triangle complex, in wide arithmetic, by the simplest scheme that is exact.
//
// A tree of windows, taken from a queue in order of distance, as in "Shortest paths on a polyhedron" (Chen and Han
// 1990); a window is a wedge of straight rays that enters a face through one edge, together with the unfolded place
// of the vertex or source that the rays come from, or a strip of parallel rays, from a segment of a curve. No lists, no
// trimming of windows against each other. What makes the tree finite are four rules, and the reason why each of them is
// safe stands beside it in polyhedral.cpp.
// Meant to be read and believed, not to be fast: 10 to 100 times slower than a good solver.
// Of the library it uses what names places: locate(), of points and of curves.
#pragma once

#include "oracle/complex.h"

#include <brushfire/solvers/distance.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire::oracle {

// What the oracle computes in. Its results are rounded to long double. Long double is quick, and right where lengths
// differ by factors of a thousand; where they differ by 1e12, directions need the digits of Quad; Octuple says whether
// Quad had enough of them.
enum class Arithmetic : std::uint8_t { LongDouble, Quad, Octuple };

struct Truth {
  std::vector<Real> distance;  // [vertices]; infinity: unreachable, or farther than the radius
  std::vector<Real> target;    // [targets]
  std::uint64_t windows = 0;   // taken from the queue
};

// Distances from the nearest of the sources (distance plus offset) to all vertices and to `targets`.
Truth polyhedral_distance(const Mesh& mesh, std::span<const Source> sources, Real radius = kFar,
                          std::span<const SurfacePoint> targets = {}, Arithmetic arithmetic = Arithmetic::LongDouble);

}  // namespace brushfire::oracle
