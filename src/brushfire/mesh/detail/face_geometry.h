// Lengths and area of a face from the positions of its corners: the same bits whoever asks.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <array>
#include <cmath>
#include <span>

namespace brushfire::detail {

// The length of a vector whose squares may vanish.
BRUSHFIRE_INLINE double length_of(Vec3 e) {
  const double squared = dot(e, e);
  if (squared > 0x1p-900) return std::sqrt(squared);
  constexpr double kUp = 0x1p500;
  return norm(kUp * e) / kUp;
}

// Twice the area from the two shorter edges: rounding of a cross product grows with the product of the lengths.
BRUSHFIRE_INLINE double double_area_of(const std::array<Vec3, 3>& edge, const std::array<double, 3>& length) {
  std::size_t longest = length[1] > length[0] ? 1 : 0;
  longest = length[2] > length[longest] ? 2 : longest;
  return length_of(cross(edge[longest == 2 ? 0 : longest + 1], edge[longest == 0 ? 2 : longest - 1]));
}

// scale * (b - a). Rounding of a difference is symmetric, so both sides of an edge get the same length to the bit.
BRUSHFIRE_INLINE Vec3 scaled_difference(Vec3 a, Vec3 b, double scale) {
  const Vec3 e = b - a;
  if (std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z)) return scale * e;
  return (2 * scale) * (0.5 * b - 0.5 * a);  // coordinates near the largest double on both sides of zero
}

// The edges of a face, scaled.
BRUSHFIRE_INLINE std::array<Vec3, 3> edges_of(std::span<const Vec3> positions, const Face& t, double scale) {
  const Vec3 a = positions[t[0]], b = positions[t[1]], c = positions[t[2]];
  return {scaled_difference(a, b, scale), scaled_difference(b, c, scale), scaled_difference(c, a, scale)};
}

BRUSHFIRE_INLINE std::array<double, 3> lengths_of(const std::array<Vec3, 3>& edge) {
  return {length_of(edge[0]), length_of(edge[1]), length_of(edge[2])};
}

BRUSHFIRE_INLINE Mesh::FaceGeometry geometry_of(std::span<const Vec3> positions, const Face& t, double scale) {
  const std::array<Vec3, 3> edge = edges_of(positions, t, scale);
  const std::array<double, 3> lengths = lengths_of(edge);
  return {lengths, double_area_of(edge, lengths)};
}

}  // namespace brushfire::detail
