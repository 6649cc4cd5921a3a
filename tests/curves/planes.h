// Convex regions of the plane.
#pragma once

#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/mesh.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/random_points.h"

namespace brushfire::test {

// Random points in an ellipse, joined by a Delaunay triangulation of another ellipse: any triangulation.
inline Mesh random_triangulation(std::mt19937& random) {
  const int count = 5 + static_cast<int>(random() % 60);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * test::uniform(random), radius = std::sqrt(test::uniform(random));
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const Mesh round = delaunay(points).mesh();
  const double height = std::pow(10.0, -1.3 * test::uniform(random));
  std::vector<Vec3> positions(round.positions().begin(), round.positions().end());
  for (Vec3& p : positions) p.y *= height;
  return Mesh(positions, round.faces());
}

}  // namespace brushfire::test
