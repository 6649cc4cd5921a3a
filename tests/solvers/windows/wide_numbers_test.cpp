// The two numbers that windows are made of, beside each other, and what decides between them.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/windows/engine.h>
#include <brushfire/solvers/windows/propagation/rounding.h>
#include <brushfire/solvers/windows/store/trails.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "oracle/zoo.h"
#include "support/engine_run.h"

namespace brushfire {
namespace {

constexpr unsigned kOnePart = 31;

// A rough ball, and the same with one vertex `far` away.
Mesh ball(double far = 1) {
  Shape shape = shapes::icosphere(2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> around(0.8, 1.2);
  for (Vec3& p : shape.positions) p = around(random) * p;
  shape.positions[17] = far * shape.positions[17];
  return shape.mesh();
}

// A frame over an edge of such a face has the rounding of that edge, however near the source is.
TEST(Rounding, KnowsTheEdgesOfFacesOneOfWhoseEdgesHasNoLength) {
  windows::Unevenness folded;
  folded.add(2, 2, 0);
  EXPECT_GE(windows::rounding_of(folded).absolute, 2 * windows::kEpsilon);
}

// A source is turned from frame to frame; where all faces are alike it comes nearer, or goes away, by the same each
// time.
TEST(Rounding, CountsTheFacesThatAPathCrosses) {
  for (const double step : {0.01, 1.0, 2.7}) {
    const Mesh mesh = oracle::strip(100'000, step);
    const Source source{vertex_point(mesh, 0)};
    DistanceOptions options;
    options.method = Method::Exact;
    const DistanceField field = distance(mesh, std::span(&source, 1), options);
    const auto positions = mesh.positions();
    double most = 0, each_face = 0;
    for (Index v = 1; v < mesh.vertex_count(); ++v) {
      const long double x = static_cast<long double>(positions[v].x) - positions[0].x, y = positions[v].y;
      const auto error = static_cast<double>(std::abs(field.distance[v] - std::sqrt(x * x + y * y)));
      most = std::max(most, error / field.error_bound[v]);
      if (v > 1000) each_face = std::max(each_face, error / (windows::kEpsilon * field.distance[v] * v));
    }
    std::printf("strip of 1e5 faces, step %g: %.2f epsilons a face, %.3f of the bound\n", step, each_face, most);
    EXPECT_LT(most, 0.5) << step;
    EXPECT_LT(field.max_error_bound, 1e-8) << step;
  }
}

TEST(WideNumbers, GiveWhatDoublesGiveOnOrdinaryMeshes) {
  const Mesh mesh = ball();
  const auto narrow = windows::in_doubles::make_engine(mesh, kOnePart, windows::Merging::Always);
  const auto wide = windows::in_double_doubles::make_engine(mesh, kOnePart, windows::Merging::Always);
  for (const double tolerance : {0.0, 1e-3}) {
    DistanceOptions options;
    options.tolerance = tolerance;
    for (const Source& source : {Source{vertex_point(mesh, 5)}, Source{{12, {0.2, 0.3, 0.5}}}}) {
      const DistanceField a = test::run(*narrow, mesh, {source}, options);
      const DistanceField b = test::run(*wide, mesh, {source}, options);
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_NEAR(a.distance[v], b.distance[v], tolerance > 0 ? 2 * tolerance * a.distance[v] : a.error_bound[v]);
        EXPECT_LE(b.error_bound[v], a.error_bound[v] + tolerance * a.distance[v]);
      }
    }
  }
}

TEST(WideNumbers, AreWithinTheBoundsOfDoublesOnUnevenMeshes) {
  for (const double far : {1e2, 1e4, 1e6, 1e8}) {
    const Mesh mesh = ball(far);
    const auto narrow = windows::in_doubles::make_engine(mesh, kOnePart, windows::Merging::Always);
    const auto wide = windows::in_double_doubles::make_engine(mesh, kOnePart, windows::Merging::Always);
    EXPECT_LT(wide->doubt(), 1e-6 * narrow->doubt());
    DistanceOptions options;
    options.method = Method::Exact;
    const std::vector<Source> sources{{vertex_point(mesh, 5)}};
    const DistanceField a = test::run(*narrow, mesh, sources, options);
    const DistanceField b = test::run(*wide, mesh, sources, options);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_LE(std::abs(a.distance[v] - b.distance[v]), a.error_bound[v] + b.error_bound[v]) << far << ' ' << v;
    }
  }
}

// Two triangles with a face between them that has two vertices at one place: its edges are the same segment.
TEST(WideNumbers, LightCrossesAFaceWithAnEdgeOfNoLength) {
  const std::vector<Vec3> p{{0, 0, 2}, {0, 0, 0}, {0, 0, 0}, {-1, 0, 1}, {1, 0, 1}};
  const std::vector<Face> faces{{0, 1, 3}, {0, 2, 1}, {0, 4, 2}};
  const Mesh mesh(p, faces);
  const auto narrow = windows::in_doubles::make_engine(mesh, kOnePart, windows::Merging::Always);
  const auto wide = windows::in_double_doubles::make_engine(mesh, kOnePart, windows::Merging::Always);
  for (const SurfacePoint& at : {SurfacePoint{1, {0.25, 0.75, 0}}, SurfacePoint{1, {0.25, 0, 0.75}},
                                 SurfacePoint{1, {0.25, 0.25, 0.5}}, SurfacePoint{0, {0.25, 0.75, 0}}}) {
    for (const auto* engine : {&narrow, &wide}) {
      DistanceOptions options;
      options.method = Method::Exact;
      const DistanceField field = test::run(**engine, mesh, {Source{at}}, options);
      for (const Index v : {3u, 4u}) EXPECT_NEAR(mesh.unit() * field.distance[v], std::hypot(1, 0.5), 1e-14) << v;
    }
  }
}

TEST(WideNumbers, PathsAreAsLongAsTheirField) {
  const Mesh mesh = ball(1e7);
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  const std::vector<Source> sources{{vertex_point(mesh, 5)}};
  const DistanceField field = distance(mesh, sources, options);
  ASSERT_NE(field.windows, nullptr);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    double length = 0;
    for (Index at = v; at != kNoIndex;) {
      const WindowField::Leg leg = field.windows->last_leg(at);
      ASSERT_FALSE(leg.points.empty()) << v;
      length += leg.length;
      at = leg.vertex;
    }
    EXPECT_NEAR(length, field.distance[v], 1e-11 * field.distance[v]) << v;
  }
}

TEST(Rounding, OrdinaryMeshesAreSureToTenDigitsAndUnevenOnesAreNot) {
  windows::Unevenness even, uneven;
  even.add(1, 1.5, 2);
  uneven.add(1, 1e6, 1e6);
  EXPECT_LT(windows::rounding_of(even).doubt, 1e-12);
  EXPECT_GT(windows::rounding_of(uneven).doubt, 1e-4);
  EXPECT_EQ(windows::rounding_of(uneven).of(0), 0);  // a source is where it is
}

TEST(Rounding, AnEdgeThatOnlyFacesWithoutAreaHaveIsAsShortAsAnyOther) {
  windows::Unevenness u;
  u.add(1e6, 1e6, 1e6);
  const double before = windows::rounding_of(u).doubt;
  u.add(0, 1, 1);
  EXPECT_NEAR(windows::rounding_of(u).doubt, 1e6 * before, before);
}

TEST(Rounding, NothingIsPromisedWhereProductsLeaveTheRangeOfDoubles) {
  windows::Unevenness u;
  u.add(1e-200, 1, 1);
  EXPECT_EQ(windows::rounding_of(u).absolute, std::numeric_limits<double>::infinity());
}

TEST(Trails, AFaceIsFoundAgainSoonerOrLater) {
  windows::Trails trails;
  Index trail = kNoIndex;
  EXPECT_FALSE(trails.has_been(trail, 7));
  trail = trails.with(trail, 7);
  EXPECT_TRUE(trails.has_been(trail, 7));
  // Far back only at powers of two.
  for (Index face = 100; face < 300; ++face) trail = trails.with(trail, face);
  EXPECT_FALSE(trails.has_been(trail, 7));
  bool found = false;
  for (Index face = 300; face < 400 && !found; ++face) {
    trail = trails.with(trail, face);
    found = trails.has_been(trail, 7);
  }
  EXPECT_TRUE(found);
}

// Light that comes round faces without area to a vertex reads less than the straight way, by the rounding of their
// frames.
TEST(WideNumbers, KeepTheToleranceAtAVertexThatASourceIsBeside) {
  const std::vector<Vec3> positions{{1.25, 0, -3},      {0, 0, -4}, {3.75, 0, -1},
                                    {0.9375, 0, -3.25}, {0, -4, 0}, {0, 0, -4}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
  const Mesh mesh(positions, faces);
  constexpr double kPlace = 2 * windows::kEpsilon * 5.6;  // what three weights say of a place in such a face
  for (const double share : {2.0133697375606322e-11, 1e-10, 1e-9, 1e-8, 1e-6}) {
    const Source source{{3, {1 - share, share, 0}}};
    for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
      DistanceOptions options;
      options.method = Method::Windows;
      options.tolerance = tolerance;
      const DistanceField field = distance(mesh, std::span(&source, 1), options);
      EXPECT_LE(field.error_bound[0], tolerance * field.distance[0] + kPlace) << share << ", " << tolerance;
    }
  }
}

}  // namespace
}  // namespace brushfire
