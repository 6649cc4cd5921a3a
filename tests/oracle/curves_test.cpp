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

}  // namespace
}  // namespace brushfire::oracle
