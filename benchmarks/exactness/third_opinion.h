// CGAL's exact polyhedral distances, where CGAL is installed: an opinion on our results, not a truth (its kernel here
// computes in doubles, and it refuses meshes that are not consistently oriented manifolds).
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <string>
#include <vector>

namespace brushfire::benchmark {

struct Opinion {
  std::string verdict;           // "ok", or why there are no distances
  std::vector<double> distance;  // [vertices]; infinity: unreachable
};

// Runs in a process of its own, so that a crash or a hang (more than `seconds` of processor time) is a verdict.
Opinion third_opinion(const Mesh& mesh, const SurfacePoint& source, unsigned seconds = 60);

}  // namespace brushfire::benchmark
