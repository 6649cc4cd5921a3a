// From positions to a unit, lengths and areas.
#include <brushfire/mesh/detail/geometry.h>

#include <brushfire/core/cancel.h>
#include <brushfire/mesh/detail/face_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace brushfire::detail {
namespace {

// So far inside the range of doubles that inverses and squares stay finite.
constexpr double kSmallestUnit = 0x1p-1000;
constexpr double kLargestUnit = 0x1p1000;

// The mean length of the edges of every `stride`-th face, and the greatest coordinate there. Measured in units of that,
// where nothing overflows.
struct Sample {
  double mean = 0, largest = 0;
};

Sample sample_edges(std::span<const Vec3> positions, std::span<const Face> faces, std::size_t stride) {
  Sample sample;
  for (std::size_t f = 0; f < faces.size(); f += stride) {
    for (const Index v : faces[f]) {
      const Vec3& p = positions[v];
      sample.largest = std::max({sample.largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  const double unit = power_of_two_below(sample.largest);
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < faces.size(); f += stride, count += 3) {
    const std::array<double, 3> length = lengths_of(edges_of(positions, faces[f], 1 / unit));
    sum += length[0] + length[1] + length[2];
  }
  if (count > 0) sample.mean = sum / count * unit;
  return sample;
}

// How far two powers of two apart squares and fourth powers keep their digits.
constexpr double kOneSize = 0x1p100;

}  // namespace

double power_of_two_below(double x) {
  return x > 0 ? std::clamp(std::ldexp(1.0, std::ilogb(x)), kSmallestUnit, kLargestUnit) : 1.0;
}

double unit_from_positions(std::span<const Vec3> positions, std::span<const Face> faces, const Box& bounds) {
  constexpr std::size_t kSample = 4096;
  Sample sample = sample_edges(positions, faces, std::max<std::size_t>(1, faces.size() / kSample));
  const auto [low, high] = bounds;
  const double largest = std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z});
  if (faces.size() > kSample && !(sample.mean > largest / kOneSize)) sample = sample_edges(positions, faces, 1);
  return power_of_two_below(sample.mean);
}

double unit_from_lengths(std::span<const double> lengths) {
  double sum = 0, largest = 0;
  for (const double l : lengths) largest = std::max(largest, l);
  const double scale = 1 / power_of_two_below(largest);
  for (const double l : lengths) sum += l * scale;
  return lengths.empty() ? 1 : power_of_two_below(sum / static_cast<double>(lengths.size()) / scale);
}

Geometry geometry_from_positions(std::span<const Vec3> positions, std::span<const Face> faces, double unit) {
  Geometry g;
  g.lengths.resize(3 * faces.size());
  g.double_areas.resize(faces.size());
  in_pieces(faces.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::array<Vec3, 3> edge = edges_of(positions, faces[f], 1 / unit);
      const std::array<double, 3> length = lengths_of(edge);
      std::copy(length.begin(), length.end(), &g.lengths[3 * f]);
      g.double_areas[f] = double_area_of(edge, length);
    }
  });
  return g;
}

}  // namespace brushfire::detail
