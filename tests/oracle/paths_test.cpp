// Shortest paths on awkward meshes: as long as the field says, and judged good by coordinates where there are any.
#include "oracle/zoo.h"
#include "support/path_checker.h"
#include "support/random_points.h"

#include <brushfire/queries/path.h>

#include <gtest/gtest.h>

#include <random>

namespace brushfire::oracle {
namespace {

void expect_good_paths(const Mesh& mesh, int pairs, std::uint32_t seed, const std::string& name) {
  PathFinder finder(mesh);
  DistanceSolver solver(mesh);
  std::mt19937 random(seed);
  for (int i = 0; i < pairs; ++i) {
    const SurfacePoint from = test::any_point(mesh, random), to = test::any_point(mesh, random);
    const SurfacePath path = finder.between(from, to);
    if (!mesh.positions().empty()) {
      ASSERT_EQ(test::judge(mesh, path), "") << name << ", pair " << i << ", seed " << seed;
    }
    DistanceOptions options;
    options.method = Method::Exact;
    options.targets = {to};
    const Source source{from};
    const double d = solver.distance(std::span(&source, 1), options).target_distance[0];
    if (d == kInfinity) {
      ASSERT_EQ(path.length, kInfinity) << name << ", pair " << i << ", seed " << seed;
    } else {
      ASSERT_NEAR(path.length, d, 1e-10 * std::max(d, 1e-3 * mesh.unit()))
          << name << ", pair " << i << ", seed " << seed;
    }
  }
}

bool has_usable_face(const Mesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.is_face_usable(f)) return true;
  }
  return false;
}

TEST(AwkwardPaths, InTheZooAreGoodAndAsLongAsTheFieldSays) {
  for (const Specimen& s : awkward_meshes()) {
    if (has_usable_face(s.mesh)) expect_good_paths(s.mesh, 60, 1, s.name);
  }
}

// Faces without area, edges without length and over many faces, vertices in several fans, all in one small space.
TEST(AwkwardPaths, InSoupsAreGoodAndAsLongAsTheFieldSays) {
  for (std::uint32_t seed = 1; seed <= 240; ++seed) {
    expect_good_paths(random_soup(seed, 12 + seed % 20, 30 + seed % 40), 8, seed, "soup");
  }
}

TEST(AwkwardPaths, ThroughRowsWithoutAltitudeAreGoodAndAsLongAsTheFieldSays) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) expect_good_paths(needle_grid(seed, 8, 0), 40, seed, "flat rows");
}

}  // namespace
}  // namespace brushfire::oracle
