// Farthest-point sampling: vertices spread evenly over the surface.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <span>
#include <vector>

namespace brushfire {

struct Samples {
  std::vector<Index> vertices;  // in the order in which they were taken
  // [vertices] how far each sample was from those before it: never rising after the given ones; +inf for the first, and
  // for the first in a component of its own.
  std::vector<double> separation;
  std::vector<double> distance;  // [vertex_count] from the nearest sample; +inf where none reaches
  std::vector<Index> nearest;    // [vertex_count] its place in `vertices`; kNoIndex where none reaches
  double covering_radius = 0;    // the greatest finite or infinite distance of a vertex that is in an open face
};

// Takes `first` (or, where it is empty, the lowest vertex that is in a face) and then again and again the vertex
// farthest from all samples so far, the lowest of equals, until there are `count` samples or every vertex is at
// distance 0. The first samples of a longer run are those of a shorter one. Vertices in no face are never taken; +inf
// is farther than any number, so every component gets its sample early on.
//
// Each sample is a run limited to the distance that still matters, so all of them together cost about log(count) whole
// fields. `options` are those of the runs (method, precision, cancel; max_distance: what lies farther counts as not
// reached); targets are ignored. Throws Error(IndexOutOfRange) and Error(InvalidArgument) for a first vertex that does
// not exist, is in no face or repeats, Error(InvalidArgument) for more first vertices than `count`.
// Based on: Eldar, Lindenbaum, Porat, Zeevi, "The Farthest Point Strategy for Progressive Image Sampling", 1997.
Samples farthest_points(const Domain& domain, Index count, std::span<const Index> first = {},
                        const DistanceOptions& options = {});

}  // namespace brushfire
