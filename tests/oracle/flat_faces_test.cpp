// Method::Exact on faces without area: they are the limits of thin ones, and conduct from edge to edge at no cost.
#include "oracle/deviation.h"
#include "oracle/zoo.h"

#include <brushfire/mesh/report.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/engine_run.h"

namespace brushfire::oracle {
namespace {

constexpr double kPromise = 1e-12;

Deviation bounded_comparison(const Mesh& mesh, const SurfacePoint& from, std::span<const SurfacePoint> targets = {}) {
  const Source source{from, 0};
  return exact_against_oracle(mesh, std::span(&source, 1), kInfinity, targets);
}

void expect_exact_from_everywhere(const Mesh& mesh, std::uint32_t seed, const std::string& name) {
  std::mt19937 random(seed);
  const std::vector<SurfacePoint> targets{random_vertex(mesh, random), random_edge_point(mesh, random),
                                          random_face_point(mesh, random)};
  for (const SurfacePoint& from :
       {random_vertex(mesh, random), random_edge_point(mesh, random), random_face_point(mesh, random)}) {
    const Deviation d = bounded_comparison(mesh, from, targets);
    EXPECT_TRUE(d.within(kPromise)) << name << ", seed " << seed << ": " << d.text();
  }
}

TEST(FlatFaces, VertexInTheMiddleOfAnEdgeLightsTheFaceBeyond) {
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {2, 3, 0}},
                  std::vector<Face>{{0, 1, 2}, {0, 2, 3}});
  EXPECT_TRUE(bounded_comparison(mesh, vertex_point(mesh, 1)).within(kPromise));
}

TEST(FlatFaces, SourceInsideLightsTheFaceBeyondItsEdges) {
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, -1, 0}},
                  std::vector<Face>{{0, 1, 2}, {1, 0, 3}});
  EXPECT_TRUE(bounded_comparison(mesh, {0, {0.25, 0.5, 0.25}}).within(kPromise));
  EXPECT_TRUE(bounded_comparison(mesh, {0, {0, 0.5, 0.5}}).within(kPromise));
}

TEST(FlatFaces, SourceInAFaceWithACollapsedEdgeLightsBothNeighbours) {
  const Mesh mesh(std::vector<Vec3>{{1, 2, 2}, {1, 2, 2}, {0, 0, 0}, {2, 0, 0}},
                  std::vector<Face>{{0, 1, 2}, {0, 3, 2}});
  EXPECT_TRUE(bounded_comparison(mesh, {0, {0.25, 0.125, 0.625}}).within(kPromise));
}

TEST(FlatFaces, DuplicatesDoNotKeepAFrontGoingRoundForEver) {
  const Mesh mesh(std::vector<Vec3>{{1, 1, 1}, {0, 2, 2}, {0, 0, 0}, {0, 0, 0}, {1, 0, 1}},
                  std::vector<Face>{{0, 1, 2}, {3, 4, 0}, {4, 3, 2}, {3, 2, 4}});
  EXPECT_TRUE(bounded_comparison(mesh, vertex_point(mesh, 1)).within(kPromise));
  const Mesh pillow(std::vector<Vec3>{{0, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 0}, {2, 3, 3}},
                    std::vector<Face>{{0, 1, 2}, {3, 2, 4}, {0, 2, 4}, {2, 3, 4}});
  EXPECT_TRUE(bounded_comparison(pillow, {0, {0.25, 0.25, 0.5}}).within(kPromise));
}

TEST(FlatFaces, AwkwardMeshesEqualTheOracle) {
  for (const Specimen& s : awkward_meshes()) {
    if (s.mesh.report().zero_area_faces == 0) continue;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) expect_exact_from_everywhere(s.mesh, seed, s.name);
  }
}

TEST(FlatFaces, SoupsOnALatticeEqualTheOracle) {
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    const Mesh mesh = random_soup(seed, 5 + seed % 9, 4 + seed % 21, 3 + static_cast<int>(seed % 5));
    expect_exact_from_everywhere(mesh, seed, "soup");
  }
}

// Rows of faces without altitude, or next to none, between ordinary ones: a vertex of one side of a row lies on the
// edges of the other, so its light leaves through one point of an interval, beside light that ties with it there.
TEST(FlatFaces, RowsOfHardlyAnyAltitudeEqualTheOracle) {
  for (const double altitude : {0.0, 1e-17, 1e-16, 1e-14, 1e-13, 1e-12, 1e-9, 1e-7}) {
    for (std::uint32_t grid = 1; grid <= 16; ++grid) {
      const Mesh mesh = needle_grid(grid, 8, altitude);
      for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE("altitude " + std::to_string(altitude) + ", grid " + std::to_string(grid));
        expect_exact_from_everywhere(mesh, seed, "rows");
      }
    }
  }
}

TEST(FlatFaces, TolerancesAreKeptOnRowsOfHardlyAnyAltitude) {
  for (const double altitude : {0.0, 1e-16, 1e-13, 1e-9}) {
    for (std::uint32_t grid = 1; grid <= 16; ++grid) {
      const Mesh mesh = needle_grid(grid, 8, altitude);
      std::mt19937 random(grid);
      for (const double tolerance : {1e-2, 1e-4}) {
        const Source source{random_face_point(mesh, random)};
        DistanceOptions options;
        options.tolerance = tolerance;
        const auto engine = windows::make_windows(mesh, windows::kPartBits, windows::Merging::Always);
        const DistanceField field = test::run(*engine, mesh, {source}, options);  // in mesh.unit()
        const Truth truth = polyhedral_distance(mesh, std::span(&source, 1));
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          const double d = static_cast<double>(truth.distance[v]) / mesh.unit();
          EXPECT_LE(std::abs(field.distance[v] - d), field.error_bound[v]) << altitude << ", grid " << grid;
          EXPECT_LE(field.error_bound[v], tolerance * d) << altitude << ", grid " << grid << ", vertex " << v;
        }
      }
    }
  }
}

}  // namespace
}  // namespace brushfire::oracle
