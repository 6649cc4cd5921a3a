// Pyramids without a floor whose rim is uneven, for what happens around a vertex.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <cmath>
#include <random>
#include <vector>

namespace brushfire::test {

// Of `count` faces, vertex 0 being the tip. The rim has the radius 1, or down to 2^-octaves at random.
inline Mesh uneven_wheel(Index count, double height, double octaves, std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Vec3> positions{{0, 0, height}};
  std::vector<Face> faces;
  for (Index k = 0; k < count; ++k) {
    const double angle = 2 * kPi * k / count, radius = octaves == 0 ? 1 : std::exp2(-octaves * part(random));
    positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    faces.push_back({0, 1 + k, 1 + (k + 1) % count});
  }
  return {positions, faces};
}

}  // namespace brushfire::test
