// Whether single precision is enough for marching on a mesh.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <algorithm>

namespace brushfire::detail {

// Marching holds fourth powers of lengths, in units of the mean edge: those have to fit into a float.
inline bool fits_float(const Mesh& mesh) {
  constexpr double kLongest = 0x1p24;
  double longest = 0;
  if (mesh.has_positions()) {
    const auto [low, high] = mesh.bounds();
    const Vec3 extent = (1 / mesh.unit()) * high - (1 / mesh.unit()) * low;
    longest = std::max({extent.x, extent.y, extent.z});
  } else {
    for (const double l : mesh.lengths()) longest = std::max(longest, l);
  }
  return longest < kLongest;
}

}  // namespace brushfire::detail
