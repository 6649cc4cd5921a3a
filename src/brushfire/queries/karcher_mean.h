// The mean of points on a surface.
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/surface_point.h>

#include <span>

namespace brushfire {

struct KarcherMeanOptions {
  double tolerance = 1e-6;  // stop where the next step is shorter than this share of the points' mean distance
  Index max_steps = 100;
  const CancelToken* cancel = nullptr;
};

struct KarcherMean {
  SurfacePoint point;      // nowhere where no place is reached by all
  double deviation = 0;    // root of the weighted mean of the squared distances from it
  double last_step = 0;    // how far the next step would have gone
  Index steps = 0;         // exact fields that were computed
  bool converged = false;  // last_step is within the tolerance, or no step makes the deviation smaller
};

// The point with the least weighted sum of squared distances from the points (Karcher's, or Fréchet's mean), found from
// the best of the points by walking down: each step goes along the mean of the directions and distances in which the
// shortest paths to the points leave (the logarithmic map), shortened until the sum falls. Where the points lie within
// a convex disc there is one such point; for points all over a surface it is a local one. `weights`: empty or one per
// point, >= 0, not all 0. Throws Error(InvalidArgument) for no points, bad weights, and a point behind a wall; Error as
// locate() does. A step costs one exact field that ends at the farthest point.
//
// Based on: Karcher, "Riemannian center of mass and mollifier smoothing", 1977.
KarcherMean karcher_mean(const Domain& domain, std::span<const SurfacePoint> points,
                         std::span<const double> weights = {}, const KarcherMeanOptions& options = {});

}  // namespace brushfire
