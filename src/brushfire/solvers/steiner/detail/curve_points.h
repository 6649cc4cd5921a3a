// Curves as sources of weighted runs: as points on them, each a source of its own.
#pragma once

#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/steiner/detail/point_layout.h>

#include <span>
#include <vector>

namespace brushfire::steiner {

struct PointSource {
  SurfacePoint point;  // of the caller's mesh
  double offset = 0;
  Index label = 0;  // position in the caller's list
};

// The points among the sources, and in the place of every curve its places; of each segment along an edge the layout's
// points on it; of one through a face as many as the face's densest edge has, less the shorter it is; and of every
// segment the feet of the corners of its faces. What is found from these are costs of real paths from the curve. Throws
// Error(InvalidArgument) where the offset changes along a curve, and what locate() throws. `layout` may be null where
// there are no curves.
std::vector<PointSource> with_points_of_curves(const WeightedMesh& mesh, const PointLayout* layout,
                                               std::span<const Source> sources);

}  // namespace brushfire::steiner
