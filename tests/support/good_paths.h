// Shortest paths between random points of a mesh: judged by coordinates where there are any, as long as the field says,
// the same in both directions.
#pragma once

#include "support/path_checker.h"
#include "support/random_points.h"

#include <brushfire/queries/path.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace brushfire::test {

inline void expect_good_paths(const Mesh& mesh, int pairs, std::uint32_t seed, const std::string& name) {
  PathFinder finder(mesh);
  DistanceSolver solver(mesh);
  std::mt19937 random(seed);
  for (int i = 0; i < pairs; ++i) {
    SCOPED_TRACE(name + ", pair " + std::to_string(i) + ", seed " + std::to_string(seed));
    const SurfacePoint from = any_point(mesh, random), to = any_point(mesh, random);
    const SurfacePath path = finder.between(from, to);
    if (mesh.has_positions()) {
      ASSERT_EQ(judge(mesh, path), "");
    }
    DistanceOptions options;
    options.method = Method::Exact;
    options.targets = {to};
    const Source source{from};
    const double d = solver.distance(std::span(&source, 1), options).target_distance[0];
    if (d == kInfinity) {
      ASSERT_TRUE(path.points.empty());
      ASSERT_EQ(path.length, kInfinity);
      continue;
    }
    const double room = 1e-10 * std::max(d, 1e-3 * mesh.unit());
    ASSERT_NEAR(path.length, d, room);
    ASSERT_NEAR(finder.between(to, from).length, d, room) << "reversed";
  }
}

}  // namespace brushfire::test
