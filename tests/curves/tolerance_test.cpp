// The tolerance holds for curves: values and bounds beside an exact run.
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <random>

#include "curves/random_curves.h"
#include "curves/surfaces.h"
#include "support/engine_run.h"

namespace brushfire {
namespace {

void expect_kept(const Mesh& mesh, const std::vector<Source>& sources, double start, double tolerance, Bound bound,
                 const std::string& what) {
  const auto engine = windows::make_windows(mesh, windows::kPartBits, windows::Merging::Always);
  const DistanceField exact = test::run(*engine, mesh, sources, {.method = Method::Exact});
  const DistanceField merged = test::run(*engine, mesh, sources, {.tolerance = tolerance, .bound = bound});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (exact.distance[v] == kInfinity && merged.distance[v] == kInfinity) continue;
    SCOPED_TRACE(what + ", vertex " + std::to_string(v));
    const double rounded = exact.error_bound[v], error = merged.distance[v] - exact.distance[v];
    ASSERT_LE(std::abs(error), merged.error_bound[v] + rounded);
    ASSERT_LE(merged.error_bound[v], tolerance * (exact.distance[v] - start) + 4 * rounded);
    if (bound == Bound::Lower) {
      ASSERT_LE(error, rounded);
    }
    if (bound == Bound::Upper) {
      ASSERT_GE(error, -rounded);
    }
  }
}

TEST(CurvesWithATolerance, KeepItWithTheirBounds) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    for (unsigned seed = 0; seed < 9; ++seed) {
      std::mt19937 random(seed);
      CurveSource curve;
      curve.places = test::random_walk(mesh, 2 + static_cast<int>(random() % 9), random);
      if (seed % 2 == 1) test::give_offsets(mesh, curve, random);
      std::vector<Source> sources{source_along(curve)};
      if (seed % 3 == 0) sources.push_back({test::any_point(mesh, random), 0.1});
      const double start = locate(mesh, curve).least_offset / mesh.unit();
      constexpr Bound kBounds[]{Bound::Estimate, Bound::Lower, Bound::Upper};
      for (const double tolerance : {1e-1, 1e-3}) {
        expect_kept(mesh, sources, std::min(start, seed % 3 == 0 ? 0.1 / mesh.unit() : start), tolerance,
                    kBounds[seed % 3], name + ", seed " + std::to_string(seed));
      }
    }
  }
}

}  // namespace
}  // namespace brushfire
