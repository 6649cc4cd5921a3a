// Small complexes with random weights.
#pragma once

#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/steiner/weights.h>

#include <algorithm>
#include <cmath>

namespace brushfire::testing_support {

inline constexpr std::uint64_t kKinds = 6, kFansAtAVertex = 3;

// A small complex of one of several kinds, shaken.
inline Mesh random_complex(std::uint64_t kind, Random& random) {
  Shape shape;
  switch (kind) {
    case 0:
      shape = shapes::plane(static_cast<Index>(1 + random.below(3)), static_cast<Index>(1 + random.below(3)));
      break;
    case 1:
      shape = shapes::icosphere(0);
      break;
    case 2:
      shape = shapes::book(3, 1, 2);
      break;
    case kFansAtAVertex:
      shape = shapes::bow_tie(2, 4);
      break;
    case 4:
      shape = shapes::cube(1);
      break;
    default:
      shape = shapes::cone(2, 4, 1, random.uniform(0.1, 3));
  }
  const double shake = random.uniform(0, 0.3), stretch = std::exp(random.uniform(-2, 2));
  for (Vec3& p : shape.positions) {
    p = p + Vec3{random.uniform(-shake, shake), random.uniform(-shake, shake), random.uniform(-shake, shake)};
    p.x *= stretch;
  }
  return shape.mesh();
}

inline Weights random_weights(const Mesh& mesh, bool with_walls, Random& random) {
  Weights weights;
  const std::uint64_t kind = with_walls ? random.below(5) : random.below(3);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double u = random.uniform();
    weights.face.push_back(kind == 0   ? 1 + std::floor(4 * u)
                           : kind == 1 ? 1 + 9 * u
                           : kind == 2 ? (u < 0.5 ? 1 : 1e9)
                           : kind == 3 ? (u < 0.2 ? kInfinity : 1 + u)
                                       : 1);
  }
  const std::uint64_t special = random.below(4);
  for (std::uint64_t i = 0; i < special; ++i) {
    const auto h = static_cast<Index>(random.below(mesh.halfedge_count()));
    EdgeCost edge{{mesh.from(h), mesh.to(h)}, kInfinity, 0};
    if (random.below(2) == 0) edge.along = random.uniform(0.1, 1);
    if (with_walls && random.below(2) == 0) edge.crossing = random.below(4) == 0 ? kInfinity : random.uniform(0, 1);
    bool again = false;
    for (const EdgeCost& e : weights.edges) {
      again = again || std::minmax(e.vertices[0], e.vertices[1]) == std::minmax(edge.vertices[0], edge.vertices[1]);
    }
    if (!again) weights.edges.push_back(edge);
  }
  return weights;
}

}  // namespace brushfire::testing_support
