// Sheets for tests of weights, whose faces can be told by where they lie.
#pragma once

#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace brushfire::test {

// [0, width] x [0, height] in cells of a quarter, shaken but for what lies on the sides and on whole numbers of x or y.
inline Mesh shaken_sheet(double width, double height, std::uint64_t seed) {
  Shape shape = shapes::plane(static_cast<Index>(4 * width), static_cast<Index>(4 * height), width, height);
  Random random(seed);
  for (Vec3& p : shape.positions) {
    const double dx = random.uniform(-0.07, 0.07), dy = random.uniform(-0.07, 0.07);
    const bool on_x = p.x == std::floor(p.x), on_y = p.y == std::floor(p.y);
    if (!on_x) p.x += dx;
    if (!on_y) p.y += dy;
  }
  return shape.mesh();
}

// [0, n] x [0, n] in unit squares of two faces each, as high as `height(x, y)`, row by row; vertex y * (n + 1) + x,
// faces 2 (y n + x) and the next one.
template <class Height>
Mesh squares(Index n, Height&& height) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index y = 0; y <= n; ++y) {
    for (Index x = 0; x <= n; ++x) positions.push_back({double(x), double(y), height(x, y)});
  }
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const Index v = y * (n + 1) + x;
      faces.push_back({v, v + 1, v + n + 2});
      faces.push_back({v, v + n + 2, v + n + 1});
    }
  }
  return Mesh(positions, faces);
}

inline std::vector<Source> sources_at(const Mesh& mesh, const std::vector<Index>& vertices) {
  std::vector<Source> sources;
  for (const Index v : vertices) sources.push_back({vertex_point(mesh, v)});
  return sources;
}

}  // namespace brushfire::test
