// In a convex region of the plane the distance from a curve is that of the nearest of its segments, however the region
// is triangulated.
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "curves/planes.h"
#include "curves/random_curves.h"
#include "support/engine_run.h"

namespace brushfire {
namespace {

using test::random_triangulation;

constexpr double kRelative = 1e-12;
// A place is named by three doubles: some epsilons of the region's size, which is 2.
constexpr double kPlaces = 32 * std::numeric_limits<double>::epsilon();

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
