// The k nearest of many sources, per vertex.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>

#include <span>
#include <vector>

namespace brushfire {

struct NearestSources {
  Index count = 0;               // sources per vertex: k, or all where there are fewer
  std::vector<double> distance;  // [vertex_count * count] of each vertex one after the other, ascending; +inf: no more
  std::vector<Index> source;     // [vertex_count * count] places in the caller's list, of equal ones the lowest first
};

// The `count` nearest sources of every vertex, by distance plus offset. Every source runs on its own, as far as it can
// still matter: the first of them over the whole mesh, all N together about k log N times over it. options and errors
// are those of distance(), targets are ignored; Error(InvalidArgument) for a count of 0.
NearestSources nearest_sources(const Domain& domain, std::span<const Source> sources, Index count,
                               const DistanceOptions& options = {});

}  // namespace brushfire
