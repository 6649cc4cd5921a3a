// Meshes whose vertices were moved at random, and fields that know their paths: for derivatives.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <random>
#include <span>
#include <vector>

namespace brushfire::test {

inline DistanceField traced(const Domain& domain, std::span<const Source> sources) {
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  return distance(domain, sources, options);
}

// So that no two paths are equally long by symmetry, and none goes straight through a vertex.
inline Mesh jittered(const Mesh& mesh, double by, unsigned seed) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> any(-by, by);
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  for (Vec3& p : positions) p = p + Vec3{any(dice), any(dice), any(dice)};
  return Mesh(positions, mesh.faces());
}

}  // namespace brushfire::test
