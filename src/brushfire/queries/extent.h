// How large a surface is by its own distances: its diameter and its radius, with proof.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>

#include <array>

namespace brushfire {

struct ExtentOptions {
  // The bounds of each of the two may stay apart by this share: upper <= (1 + tolerance) * lower. >= 0.
  double tolerance = 1e-9;
  Index max_runs = 0;  // stop after so many exact fields with the bounds reached by then; 0: no limit
  unsigned threads = 1;
  Progress progress = nullptr;
  const CancelToken* cancel = nullptr;
};

// Between vertices, along the surface; of the component with the greatest diameter. Points inside faces are at most the
// longest edge farther from one another.
struct Extent {
  double diameter_lower = 0, diameter_upper = 0;  // diameter_lower is the distance of `pair`
  std::array<Index, 2> pair{kNoIndex, kNoIndex};  // the two vertices
  double radius_lower = 0, radius_upper = 0;      // radius_upper is the distance of the vertex farthest from `centre`
  Index centre = kNoIndex;                        // the vertex from which no vertex is farther than that
  Index runs = 0;
};

// Bounds that hold, to rounding: every exact field narrows, by the triangle inequality, how far away from every vertex
// the farthest one can be. Surfaces with one longest extent take some tens of fields; on a sphere, where all vertices
// are equally far from their opposites, it takes a field from every one of them: max_runs says when to stop. The lower
// and upper bounds reached by then are returned; both zero and no vertices where no face is open.
// Throws Error(InvalidArgument) for a tolerance that is not >= 0.
//
// Based on: Takes, Kosters, "Determining the diameter of small world networks", 2011 (bounds of eccentricities, which
// hold in any metric space).
Extent extent(const Domain& domain, const ExtentOptions& options = {});

}  // namespace brushfire
