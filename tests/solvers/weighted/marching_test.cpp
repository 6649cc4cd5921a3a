// Fast marching over weights: no bounds, but near to them, and right where a closed form is known.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "random_weighted.h"
#include "support/relative_errors.h"
#include "support/sheets.h"

namespace brushfire {
namespace {

Vec3 middle(const Mesh& mesh, Index f) {
  const Face& t = mesh.faces()[f];
  const auto& x = mesh.positions();
  return (1.0 / 3) * (x[t[0]] + x[t[1]] + x[t[2]]);
}

Weights by_place(const Mesh& mesh, const std::function<double(Vec3)>& cost) {
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f) weights.face.push_back(cost(middle(mesh, f)));
  return weights;
}

WeightedField march(const Domain& mesh, const Weights& weights, const SurfacePoint& from,
                    std::vector<SurfacePoint> targets = {}, Method method = Method::KimmelSethian) {
  return weighted_distance(mesh, weights, std::vector<Source>{{from}},
                           {.marching = method, .targets = std::move(targets)});
}

TEST(WeightedMarching, OneWeightEverywhereIsThatTimesTheDistance) {
  const Mesh mesh = shapes::icosphere(4).mesh();
  Weights weights{.face = std::vector<double>(mesh.face_count(), 3.0)};
  const WeightedField field = march(mesh, weights, vertex_point(mesh, 0));
  EXPECT_EQ(field.engine, WeightedEngine::Marching);
  EXPECT_TRUE(field.lower.empty());
  std::vector<double> truth = distance(mesh, std::vector<Source>{{vertex_point(mesh, 0)}}).distance;
  for (double& d : truth) d *= 3;
  const test::RelativeErrors off = test::relative_errors(field.distance, truth);
  EXPECT_LT(off.mean, 2e-2);
  EXPECT_LT(off.largest, 0.2);
}

// Where one is as fast as 1 + x, a path is an arc of a circle, and takes arcosh(1 + |p - q|^2 / (2 v(p) v(q))).
TEST(WeightedMarching, ConvergesWhereSpeedGrowsAlongAnAxis) {
  std::vector<double> mean;
  for (const Index n : {16, 32, 64}) {
    const Mesh mesh = shapes::plane(n, n, 4, 4).mesh();
    const double left = mesh.positions()[0].x;
    const auto speed = [&](Vec3 p) { return 1 + p.x - left; };
    const Weights weights = by_place(mesh, [&](Vec3 p) { return 1 / speed(p); });
    const Vec3 from = mesh.positions()[0];
    std::vector<double> truth;
    for (const Vec3& p : mesh.positions()) {
      truth.push_back(std::acosh(1 + dot(p - from, p - from) / (2 * speed(p) * speed(from))));
    }
    const WeightedField field = march(mesh, weights, vertex_point(mesh, 0));
    mean.push_back(test::relative_errors(field.distance, truth).mean);
  }
  EXPECT_LT(mean[2], 1.5e-2) << mean[0] << " " << mean[1];
  EXPECT_LT(mean[1], 0.8 * mean[0]);  // the error that straight fronts make around a point goes like h log h
  EXPECT_LT(mean[2], 0.8 * mean[1]);
}

TEST(WeightedMarching, LiesNearTheBoundsWhereFrontsRefract) {
  const Mesh mesh = test::shaken_sheet(6, 4, 3);
  for (const double n : {2.0, 10.0}) {
    const Weights weights = by_place(mesh, [&](Vec3 p) { return p.x > 3 ? n : 1.0; });
    for (const SurfacePoint& from : {vertex_point(mesh, 8), SurfacePoint{20, {0.2, 0.3, 0.5}}}) {
      const WeightedField truth = weighted_distance(mesh, weights, std::vector<Source>{{from}}, {.tolerance = 1e-4});
      const test::RelativeErrors off = test::relative_errors(march(mesh, weights, from).distance, truth.distance);
      EXPECT_LT(off.mean, 0.05) << n;
      EXPECT_LT(off.largest, 0.5) << n;
    }
  }
}

TEST(WeightedMarching, ReachesWhatCanBeReachedInRandomComplexes) {
  Random random(11);
  double most_above = 0, most_below = 0;
  for (int i = 0; i < 120; ++i) {
    const Mesh mesh = testing_support::random_complex(random.below(testing_support::kKinds), random);
    Weights weights = testing_support::random_weights(mesh, true, random);
    weights.edges.clear();
    const Index f = static_cast<Index>(random.below(mesh.face_count()));
    if (weights.face[f] == kInfinity) continue;
    const SurfacePoint from{f, {0.2, 0.3, 0.5}};
    const SurfacePoint to{static_cast<Index>(random.below(mesh.face_count())), {0.6, 0.3, 0.1}};
    const WeightedField truth =
        weighted_distance(mesh, weights, std::vector<Source>{{from}}, {.tolerance = 0.01, .targets = {}});
    const WeightedField found = march(mesh, weights, from), found_there = march(mesh, weights, from, {to});
    const WeightedField target =
        weighted_distance(mesh, weights, std::vector<Source>{{from}}, {.tolerance = 0.01, .targets = {to}});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(found.distance[v] == kInfinity, truth.distance[v] == kInfinity) << i << " " << v;
      if (!(truth.distance[v] > 0) || truth.distance[v] == kInfinity) continue;
      most_above = std::max(most_above, found.distance[v] / truth.distance[v]);
      most_below = std::max(most_below, truth.lower[v] / found.distance[v]);
    }
    ASSERT_EQ(found_there.target_distance[0] == kInfinity, target.target_distance[0] == kInfinity) << i;
  }
  EXPECT_LT(most_above, 10);  // one path along a cheap edge between faces 1e9 times as dear is not seen
  EXPECT_LT(most_below, 2);
}

TEST(WeightedMarching, PassesNoWallAndReadsTargets) {
  const Mesh mesh = test::squares(8, [](Index, Index) { return 0.0; });
  const Weights weights = by_place(mesh, [](Vec3 p) { return p.x > 4 && p.x < 5 ? kInfinity : p.y > 4 ? 2.0 : 1.0; });
  const SurfacePoint near{2 * 8 * 2, {0.2, 0.3, 0.5}}, far{2 * 7, {0.2, 0.3, 0.5}};
  const WeightedField field = march(mesh, weights, vertex_point(mesh, 0), {near, far});
  EXPECT_EQ(field.distance[8], kInfinity);
  EXPECT_NEAR(field.distance[4], 4, 1e-5);
  EXPECT_NEAR(field.distance[8 * 9], 12, 0.1);
  const double truth = weighted_distance(mesh, weights, std::vector<Source>{{vertex_point(mesh, 0)}},
                                         {.tolerance = 1e-3, .targets = {near}})
                           .target_distance[0];
  EXPECT_NEAR(field.target_distance[0], truth, 0.06 * truth);
  EXPECT_EQ(field.target_distance[1], kInfinity);
  EXPECT_EQ(field.target_source[0], 0);
}

TEST(WeightedMarching, NearAndFarWeightsEnd) {
  const Mesh mesh = shapes::icosphere(4).mesh();
  const Weights weights = by_place(mesh, [](Vec3 p) { return p.x * p.y > 0 ? 1e9 : 1.0; });
  const WeightedField field = march(mesh, weights, vertex_point(mesh, 0));
  const WeightedField truth = weighted_distance(mesh, weights, std::vector<Source>{{vertex_point(mesh, 0)}});
  EXPECT_EQ(field.reached, mesh.vertex_count());
  EXPECT_LT(test::relative_errors(field.distance, truth.distance).mean, 0.05);
}

// Round fronts fell below what they came from, and then below nothing.
TEST(WeightedMarching, NeverCollapsesOnStretchedMeshes) {
  Shape shape = shapes::icosphere(4);
  for (Vec3& p : shape.positions) p.x *= 10;
  const Mesh mesh = shape.mesh();
  Random random(4);
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f) weights.face.push_back(random.uniform(1, 10));
  const std::vector<Source> sources{{vertex_point(mesh, 0)}};
  const std::vector<double> least = distance(mesh, sources).distance;
  const WeightedField field = march(mesh, weights, vertex_point(mesh, 0));
  for (Index v = 1; v < mesh.vertex_count(); ++v) EXPECT_GT(field.distance[v], 0.9 * least[v]) << v;
  EXPECT_THROW(march(mesh, weights, vertex_point(mesh, 0), {}, Method::NovotniKlein), Error);
}

TEST(WeightedMarching, IsWhatDistanceOptionsComputeWhereAWeightingSaysSo) {
  const Mesh mesh = test::squares(8, [](Index, Index) { return 0.0; });
  const Weights weights = by_place(mesh, [](Vec3 p) { return 1 + p.x; });
  DistanceOptions options;
  options.weighting =
      std::make_shared<const Weighting>(mesh, weights, WeightingOptions{.marching = Method::KimmelSethian});
  EXPECT_EQ(distance(mesh, std::vector<Source>{{vertex_point(mesh, 3)}}, options).distance,
            march(mesh, weights, vertex_point(mesh, 3)).distance);
  options.bound = Bound::Lower;
  EXPECT_THROW(distance(mesh, std::vector<Source>{{vertex_point(mesh, 3)}}, options), Error);
}

TEST(WeightedMarching, RefusesWhatItCannotSee) {
  const Mesh mesh = test::squares(4, [](Index, Index) { return 0.0; });
  Weights roads = by_place(mesh, [](Vec3) { return 2.0; });
  roads.edges.push_back({{0, 1}, 0.5});
  EXPECT_THROW(march(mesh, roads, vertex_point(mesh, 0)), Error);
  Weights slopes;
  slopes.pace = SlopePace::tobler();
  EXPECT_THROW(march(mesh, slopes, vertex_point(mesh, 0)), Error);
  const Weights weights = by_place(mesh, [](Vec3 p) { return 1 + p.x; });
  CurveSource curve;
  curve.places = {vertex_point(mesh, 0), vertex_point(mesh, 1)};
  EXPECT_THROW(march(mesh, weights, vertex_point(mesh, 0), {}, Method::CarriedSource), Error);
  EXPECT_THROW(
      weighted_distance(mesh, weights, std::vector<Source>{source_along(curve)}, {.marching = Method::KimmelSethian}),
      Error);
}

}  // namespace
}  // namespace brushfire
