// A curve as the many points that it is made of: never nearer than the curve, and nearer and nearer to it.
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "curves/random_curves.h"
#include "curves/samples.h"
#include "curves/surfaces.h"

namespace brushfire {
namespace {

using test::longest_segment;
using test::samples;

// By how much samples are farther: the least and the largest excess over all vertices.
struct Excess {
  double least = 0, largest = 0;
};
Excess excess(const Mesh& mesh, const CurveSource& curve, const DistanceField& field, int pieces) {
  const DistanceField sampled = distance(mesh, samples(mesh, curve, pieces), {.method = Method::Exact});
  Excess e;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (sampled.distance[v] == kInfinity && field.distance[v] == kInfinity) continue;
    const double more = sampled.distance[v] - field.distance[v];
    e.least = std::min(e.least, more + field.error_bound[v] + sampled.error_bound[v]);
    e.largest = std::max(e.largest, more);
  }
  return e;
}

// A way that starts between two samples is at most as much longer as one is away.
TEST(CurvesAsSamples, AreNeverFartherThanTheSamplesAndNoNearerThanHalfTheirSpacing) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    for (unsigned seed = 0; seed < 12; ++seed) {
      std::mt19937 random(seed);
      CurveSource curve;
      curve.places = test::random_walk(mesh, 2 + static_cast<int>(random() % 8), random);
      if (seed % 2 == 1) test::give_offsets(mesh, curve, random);
      const DistanceField field = distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact});
      constexpr int kPieces = 16;
      const Excess e = excess(mesh, curve, field, kPieces);
      const double slope = curve.offsets.empty() ? 1 : 2;  // the offset may change with the place
      EXPECT_GE(e.least, 0) << name << ", seed " << seed;
      EXPECT_LE(e.largest, slope * 0.5 * longest_segment(mesh, curve) / kPieces + 1e-12) << name << ", seed " << seed;
    }
  }
}

// What samples s apart miss falls with the square of s: a quarter for half the spacing.
TEST(CurvesAsSamples, AreWhatSamplesConvergeToInSecondOrder) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  double coarse = 0, fine = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    CurveSource curve;
    curve.places = test::random_walk(mesh, 8, random);
    const DistanceField field = distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact});
    const DistanceField some = distance(mesh, samples(mesh, curve, 8), {.method = Method::Exact});
    const DistanceField more = distance(mesh, samples(mesh, curve, 32), {.method = Method::Exact});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      coarse += some.distance[v] - field.distance[v];
      fine += more.distance[v] - field.distance[v];
    }
  }
  EXPECT_GT(coarse, 0);
  EXPECT_LT(fine, coarse / 12);  // a sixteenth, and not a quarter
}

}  // namespace
}  // namespace brushfire
