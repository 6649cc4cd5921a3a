// Random surfaces with random walls in them, and what both ways of cutting them are compared by.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/shapes.h>

#include "../support/random_points.h"
#include "cut_by_hand.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace brushfire::test {

struct WalledCase {
  Mesh mesh;
  Barriers barriers;
};

// Blocked blobs, single faces, chains of edges, and vertices.
inline WalledCase random_walls(std::mt19937& random) {
  WalledCase c;
  switch (random() % 4) {
    case 0:
      c.mesh = shapes::noise_terrain(13, 11, 0.3, random()).mesh();
      break;
    case 1:
      c.mesh = shapes::folded_sphere(2, 4, 0.2, random()).mesh();
      break;
    case 2:
      c.mesh = shapes::torus(16, 9).mesh();
      break;
    default:
      c.mesh = shapes::plane(9, 12).mesh();
  }
  const Mesh& m = c.mesh;
  if (random() % 2) {
    std::vector<std::uint8_t> open(m.vertex_count());
    for (auto& o : open) o = random() % 10 != 0;
    c.barriers.faces = closed_faces(m, open);
  }
  if (random() % 2) {
    for (int i = 0; i < 12; ++i) c.barriers.faces.push_back(static_cast<Index>(random() % m.face_count()));
  }
  if (random() % 2) {
    Index h = static_cast<Index>(random() % m.halfedge_count());
    for (int i = 0; i < 25; ++i) {
      c.barriers.edges.push_back({m.from(h), m.to(h)});
      const auto around = m.corners(m.to(h));
      h = around[random() % around.size()];
    }
  }
  if (random() % 3 == 0) c.barriers.vertices.push_back(static_cast<Index>(random() % m.vertex_count()));
  return c;
}

inline SurfacePoint open_point(const Domain& domain, std::mt19937& random) {
  while (true) {
    const SurfacePoint p = any_point(domain.mesh(), random);
    if (!domain.on_open(p).empty()) return p;
  }
}

inline std::vector<double> least_by_hand(const ByHand& hand, std::span<const double> distance, Index count) {
  std::vector<double> least(count, kInfinity);
  for (Index v = 0; v < distance.size(); ++v) {
    if (hand.vertex[v] != kNoIndex) least[hand.vertex[v]] = std::min(least[hand.vertex[v]], distance[v]);
  }
  return least;
}

// inf where one of them is, or where they are not as many.
inline double difference(std::span<const double> a, std::span<const double> b) {
  double worst = a.size() == b.size() ? 0 : kInfinity;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] != b[i]) worst = std::max(worst, std::abs(a[i] - b[i]));
  }
  return worst;
}

constexpr double kRounding = 1e-12;

}  // namespace brushfire::test
