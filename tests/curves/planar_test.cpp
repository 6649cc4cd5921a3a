// In a convex region of the plane the distance from a curve is that of the nearest of its segments, however the region
// is triangulated.
#include <brushfire/mesh/delaunay.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "curves/random_curves.h"
#include "support/engine_run.h"

namespace brushfire {
namespace {

constexpr double kRelative = 1e-12;
// A place is named by three doubles: some epsilons of the region's size, which is 2.
constexpr double kPlaces = 32 * std::numeric_limits<double>::epsilon();

// Random points in an ellipse, joined by a Delaunay triangulation of another ellipse: any triangulation.
Mesh random_triangulation(std::mt19937& random) {
  const int count = 5 + static_cast<int>(random() % 60);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * test::uniform(random), radius = std::sqrt(test::uniform(random));
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const Mesh round = delaunay(points).mesh();
  const double height = std::pow(10.0, -1.3 * test::uniform(random));
  std::vector<Vec3> positions(round.positions().begin(), round.positions().end());
  for (Vec3& p : positions) p.y *= height;
  return Mesh(positions, round.faces());
}

double worst_excess(const Mesh& mesh, const CurveSource& curve, const DistanceField& field) {
  double worst = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corners(v).empty()) continue;
    const double truth = test::planar_distance(mesh, curve, mesh.positions()[v]);
    worst = std::max(worst, std::abs(field.distance[v] - truth) / (kRelative * std::abs(truth) + kPlaces));
  }
  return worst;
}

void expect_exact(int curves, Method method, double tolerance, bool offsets) {
  for (int seed = 0; seed < curves; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const Mesh mesh = random_triangulation(random);
    CurveSource curve = test::random_curve(mesh, 1, random);
    if (offsets) test::give_offsets(mesh, curve, random);
    const std::vector<Source> sources{source_along(curve)};
    DistanceOptions options{.method = method, .tolerance = tolerance};
    const DistanceField field = distance(mesh, sources, options);
    ASSERT_LE(worst_excess(mesh, curve, field), 1) << "seed " << seed;
  }
}

TEST(CurvesInThePlane, AreAsFarAsTheirNearestSegment) { expect_exact(1000, Method::Exact, 0, false); }
TEST(CurvesInThePlane, WithOffsetsAreTheLeastOfOffsetAndWay) { expect_exact(1000, Method::Exact, 0, true); }

// Where one segment explains everything, merging costs nothing but rounding.
TEST(CurvesInThePlane, KeepTheToleranceAndItsBound) {
  for (int seed = 0; seed < 300; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const Mesh mesh = random_triangulation(random);
    const CurveSource curve = test::random_curve(mesh, 1, random);
    const auto engine = windows::make_windows(mesh, windows::kPartBits, windows::Merging::Always);
    for (const double tolerance : {1e-1, 1e-2, 1e-4}) {
      const DistanceField field = test::run(*engine, mesh, {source_along(curve)}, {.tolerance = tolerance});
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.corners(v).empty()) continue;
        const double truth = test::planar_distance(mesh, curve, mesh.positions()[v]);
        const double d = field.distance[v] * mesh.unit(), bound = field.error_bound[v] * mesh.unit();
        ASSERT_LE(std::abs(d - truth), bound + kPlaces) << "seed " << seed << ", vertex " << v;
        ASSERT_LE(bound, tolerance * truth + kPlaces) << "seed " << seed << ", vertex " << v;
      }
    }
  }
}

}  // namespace
}  // namespace brushfire
