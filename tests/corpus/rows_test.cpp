// Rows of carried-source, sixteen at a time, on the families of awkward complexes: no holes, whatever the mesh.
#include "corpus/families.h"

#include <brushfire/queries/distance_matrix.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire::corpus {
namespace {

constexpr std::uint64_t kSeed = 20261130, kCases = 20;

std::vector<double> dijkstra(const Mesh& mesh, Index from) {
  DistanceOptions options;
  options.method = Method::Dijkstra;
  const Source source{vertex_point(mesh, from)};
  return distance(mesh, {&source, 1}, options).distance;
}

// Edges reach what anything reaches, and no way along them is shorter than the distance.
TEST(GroupedRows, OfEveryFamilyReachWhatEdgesReachAndAreNoLonger) {
  MatrixOptions options;
  options.distance.method = Method::CarriedSource;
  for (const Family& family : small_families()) {
    for (std::uint64_t i = 0; i < kCases; ++i) {
      const Mesh mesh = make_case(family, kSeed, i).mesh;
      const std::size_t n = mesh.vertex_count();
      const std::vector<double> matrix = distance_matrix<double>(mesh, {}, {}, options);
      for (Index v = 0; v < n; ++v) {
        if (mesh.corners(v).empty()) continue;
        const std::vector<double> along_edges = dijkstra(mesh, v);
        for (Index u = 0; u < n; ++u) {
          const double d = matrix[v * n + u];
          ASSERT_EQ(std::isfinite(d), std::isfinite(along_edges[u]))
              << family.name << ' ' << i << ", seed " << kSeed << ": " << v << " to " << u;
          if (!std::isfinite(d)) continue;
          ASSERT_LE(d, along_edges[u] * (1 + 1e-4))
              << family.name << ' ' << i << ", seed " << kSeed << ": " << v << " to " << u;
        }
      }
    }
  }
}

}  // namespace
}  // namespace brushfire::corpus
