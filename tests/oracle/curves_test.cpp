// Curves beside the oracle, and the oracle beside the plane.
#include "oracle/polyhedral.h"

#include "curves/planes.h"
#include "curves/random_curves.h"
#include "curves/surfaces.h"

#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire::oracle {
namespace {

CurveSource curve_on(const Mesh& mesh, bool offsets, std::mt19937& random) {
  CurveSource curve = test::random_curve(mesh, 1, random);
  if (offsets) test::give_offsets(mesh, curve, random);
  return curve;
}

// Places are named by doubles, and the closed form is computed in them.
TEST(OracleOfCurves, InThePlaneIsTheNearestSegment) {
  constexpr double kDoubles = 1e-14;
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = test::random_triangulation(random);
    const CurveSource curve = curve_on(mesh, seed % 2 == 1, random);
    const std::vector<Source> sources{source_along(curve)};
    const SurfacePoint target = test::any_point(mesh, random);
    const Truth truth = polyhedral_distance(mesh, sources, kFar, std::span(&target, 1));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.corners(v).empty()) continue;
      const double planar = test::planar_distance(mesh, curve, mesh.positions()[v]);
      EXPECT_NEAR(static_cast<double>(truth.distance[v]), planar, kDoubles * (1 + std::abs(planar)))
          << "seed " << seed << ", vertex " << v;
    }
    const double planar = test::planar_distance(mesh, curve, position(mesh, target));
    EXPECT_NEAR(static_cast<double>(truth.target[0]), planar, kDoubles * (1 + std::abs(planar))) << "seed " << seed;
  }
}

TEST(ExactFromCurves, IsWhatTheOracleSaysOnEverySurface) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    if (mesh.face_count() > 200) continue;
    for (unsigned seed = 0; seed < 4; ++seed) {
      std::mt19937 random(seed);
      const std::vector<Source> sources{source_along(curve_on(mesh, seed % 2 == 1, random))};
      const Truth truth = polyhedral_distance(mesh, sources);
      const DistanceField field = distance(mesh, sources, {.method = Method::Exact});
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (truth.distance[v] == kFar && field.distance[v] == kInfinity) continue;
        EXPECT_NEAR(field.distance[v], static_cast<double>(truth.distance[v]), field.error_bound[v])
            << name << ", seed " << seed << ", vertex " << v;
      }
    }
  }
}

// Two rows of vertices on one line, whose faces have no area, and a face on either side. A segment along the line whose
// value grows as fast as it is long sends its own light along the line only: what lies beside is lit by its end.
TEST(ExactFromCurves, ASteepSegmentInFacesWithoutAreaLightsWhatLiesBeside) {
  const std::vector<Vec3> positions{{-0.1, 0, 0}, {0.2, 0, 0}, {0.4, 0, 0}, {0.6, 0, 0}, {0.0, 0, 0}, {0.2, 0, 0},
                                    {0.4, 0, 0},  {0.6, 0, 0}, {0.1, 1, 0}, {0.3, 1, 0}, {0.5, 1, 0}};
  const std::vector<Face> faces{{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},  {2, 3, 7}, {2, 7, 6},
                                {4, 5, 8}, {5, 9, 8}, {5, 6, 9}, {6, 10, 9}, {6, 7, 10}};
  const Mesh mesh(positions, faces);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (int turn = 0; turn < 200; ++turn) {
    const Index face = 2 + turn % 2;
    const double at = anywhere(random), to = anywhere(random);
    CurveSource curve{{{face, {1 - at, at, 0}}, {face, {1 - to, to, 0}}}};
    curve.offsets = {-0.1, -0.1 + locate(mesh, curve).segments.front().length};
    const std::vector<Source> sources{source_along(curve)};
    const Truth truth = polyhedral_distance(mesh, sources);
    const DistanceField field = distance(mesh, sources, {.method = Method::Exact});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_NEAR(field.distance[v], static_cast<double>(truth.distance[v]), field.error_bound[v])
          << "face " << face << ", from " << at << " to " << to << ", vertex " << v;
    }
  }
}

}  // namespace
}  // namespace brushfire::oracle
