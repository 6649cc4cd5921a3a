// Costs that follow changes are those of a fresh run, to the bit.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/weighted_path.h>
#include <brushfire/solvers/weighted/replanner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/sheets.h"

namespace brushfire {
namespace {

using test::sources_at;

Mesh terrain(Index n, double roughness) {
  std::mt19937 random(3);
  return test::squares(n, [&](Index, Index) { return std::uniform_real_distribution(0.0, roughness)(random); });
}

Weights random_weights(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    weights.face.push_back(std::uniform_real_distribution(1.0, 5.0)(random));
  }
  return weights;
}

// Costs and sources; and paths of that cost.
void expect_as_fresh(const Replanner& planner, const std::vector<Source>& sources,
                     const ReplannerOptions& options = {}) {
  const WeightedField truth =
      weighted_distance(planner.domain(), planner.weights(), sources,
                        {.tolerance = options.tolerance, .towards = options.towards, .lower = false});
  EXPECT_EQ(planner.field().distance, truth.distance);
  EXPECT_EQ(planner.field().source, truth.source);
  EXPECT_EQ(planner.field().side_distance, truth.side_distance);
  const Mesh& mesh = planner.domain().mesh();
  const std::vector<SurfacePoint> ends{vertex_point(mesh, mesh.vertex_count() - 1),
                                       {mesh.face_count() / 2, {0.2, 0.3, 0.5}}};
  WeightedSolver solver(planner.domain(), planner.weights());
  const std::vector<WeightedPath> paths = weighted_paths(planner.field(), ends);
  const std::vector<WeightedPath> others = weighted_paths(
      solver, sources, ends, {.tolerance = options.tolerance, .towards = options.towards, .lower = false});
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (others[i].cost == kInfinity) {
      EXPECT_EQ(paths[i].cost, kInfinity);
    } else {
      EXPECT_NEAR(paths[i].cost, others[i].cost, 1e-9 * others[i].cost);
    }
  }
}

TEST(Replanner, FollowsWeightsThatRiseAndFall) {
  const Mesh mesh = terrain(14, 0.7);
  Weights weights = random_weights(mesh, 1);
  const std::vector<Source> sources = sources_at(mesh, {0, 130});
  Replanner planner(mesh, weights, sources);
  EXPECT_EQ(planner.renewed(), 1);
  expect_as_fresh(planner, sources);
  std::mt19937 random(5);
  for (int step = 0; step < 12; ++step) {
    const Index first = static_cast<Index>(random() % (mesh.face_count() - 10));
    const double factor = step % 3 == 0 ? 3 : step % 3 == 1 ? 0.2 : 1.0 + 0.5 * (step % 2);
    for (Index f = first; f < first + 10; ++f) weights.face[f] *= factor;
    planner.change(weights);
    expect_as_fresh(planner, sources);
    EXPECT_LT(planner.renewed(), 1);
  }
  planner.change(weights);
  EXPECT_EQ(planner.renewed(), 0);
}

TEST(Replanner, FollowsWallsThatComeAndGo) {
  const Index n = 14;
  const Mesh mesh = terrain(n, 0.4);
  Weights weights = random_weights(mesh, 2);
  const std::vector<Source> sources = sources_at(mesh, {0});
  Replanner planner(mesh, weights, sources);
  const std::vector<double> before = planner.field().distance;
  std::vector<double> old;
  for (Index y = 1; y < n; ++y) {  // from the rim on, with a gap at y = 0
    for (Index k = 0; k < 2; ++k) {
      old.push_back(weights.face[2 * (y * n + 6) + k]);
      weights.face[2 * (y * n + 6) + k] = kInfinity;
    }
    if (y % 4 != 1) continue;
    planner.change(weights);
    expect_as_fresh(planner, sources);
    EXPECT_LT(planner.renewed(), 1);
  }
  weights.face[2 * 6] = weights.face[2 * 6 + 1] = kInfinity;  // shut
  planner.change(weights);
  expect_as_fresh(planner, sources);
  EXPECT_GE(planner.field().distance[n], 1e300);
  for (Index y = 1, i = 0; y < n; ++y) {
    for (Index k = 0; k < 2; ++k) weights.face[2 * (y * n + 6) + k] = old[i++];
  }
  planner.change(weights);
  expect_as_fresh(planner, sources);
}

TEST(Replanner, FollowsFencesAndRoads) {
  const Index n = 12;
  const Mesh mesh = terrain(n, 0.4);
  Weights weights = random_weights(mesh, 3);
  const std::vector<Source> sources = sources_at(mesh, {0, 80});
  Replanner planner(mesh, weights, sources);
  const auto edge = [&](Index x, Index y, double along, double crossing) {
    weights.edges.push_back({{y * (n + 1) + x, (y + 1) * (n + 1) + x}, along, crossing});
  };
  for (Index y = 2; y < 9; ++y) edge(5, y, kInfinity, 3);
  planner.change(weights);
  expect_as_fresh(planner, sources);
  EXPECT_LT(planner.renewed(), 1);
  weights.edges[2].crossing = 0.5;  // a gate
  planner.change(weights);
  expect_as_fresh(planner, sources);
  weights.edges[4].crossing = kInfinity;
  planner.change(weights);
  expect_as_fresh(planner, sources);
  for (Index y = 0; y < n; ++y) edge(9, y, 0.3, 0);
  planner.change(weights);
  expect_as_fresh(planner, sources);
  for (EdgeCost& e : weights.edges) e.along = e.along < kInfinity ? 0.8 : kInfinity;
  planner.change(weights);
  expect_as_fresh(planner, sources);
  weights.edges.clear();
  planner.change(weights);
  expect_as_fresh(planner, sources);
}

TEST(Replanner, FollowsSources) {
  const Mesh mesh = terrain(12, 0.6);
  const Weights weights = random_weights(mesh, 4);
  Replanner planner(mesh, weights, sources_at(mesh, {0, 90}));
  std::vector<Source> sources = sources_at(mesh, {0, 91});
  planner.move(sources);
  expect_as_fresh(planner, sources);
  EXPECT_LT(planner.renewed(), 0.9);
  sources.insert(sources.begin(), {{40, {0.2, 0.5, 0.3}}, 0.5});
  planner.move(sources);
  expect_as_fresh(planner, sources);
  EXPECT_LT(planner.renewed(), 0.5);
  sources.pop_back();
  planner.move(sources);
  expect_as_fresh(planner, sources);
  CurveSource curve;
  for (Index y = 0; y < 5; ++y) curve.places.push_back(vertex_point(mesh, 6 + 13 * y));
  sources.push_back(source_along(curve));
  planner.move(sources);
  expect_as_fresh(planner, sources);
}

TEST(Replanner, FollowsWhereSlopesCountAndInWalledDomains) {
  const Mesh mesh = terrain(10, 0.5);
  const Domain domain(mesh, {.edges = {{60, 71}, {71, 82}}});
  Weights weights = random_weights(mesh, 6);
  const std::vector<Source> sources = sources_at(mesh, {5});
  for (const bool slopes : {false, true}) {
    if (slopes) weights.pace = SlopePace::tobler();
    const ReplannerOptions options{.tolerance = 0.02, .towards = slopes};
    Replanner planner(domain, weights, sources, options);
    for (const Index f : {30, 31, 32, 120, 121}) weights.face[f] *= f < 100 ? 4 : 0.3;
    planner.change(weights);
    expect_as_fresh(planner, sources, options);
    EXPECT_LT(planner.renewed(), 1);
    weights.face[77] = kInfinity;
    planner.change(weights);
    expect_as_fresh(planner, sources, options);
    weights.face[77] = 1;
  }
}

TEST(Replanner, WhatIsRefusedLeavesAllAsItWas) {
  const Mesh mesh = terrain(6, 0.3);
  Weights weights = random_weights(mesh, 7);
  const std::vector<Source> sources = sources_at(mesh, {0});
  Replanner planner(mesh, weights, sources);
  const std::vector<double> before = planner.field().distance;
  Weights bad = weights;
  bad.face[3] = -1;
  EXPECT_THROW(planner.change(bad), Error);
  bad.face.assign(mesh.face_count(), 2);
  bad.face[0] = bad.face[1] = kInfinity;  // the source's faces
  EXPECT_THROW(planner.change(bad), Error);
  EXPECT_THROW(planner.move({}), Error);
  EXPECT_EQ(planner.field().distance, before);
  EXPECT_EQ(planner.weights().face, weights.face);
  weights.face[20] = 9;
  planner.change(weights);
  expect_as_fresh(planner, sources);
}

TEST(Replanner, AfterCancellingTheNextCallStartsAnew) {
  const Mesh mesh = terrain(40, 0.3);
  Weights weights = random_weights(mesh, 8);
  const std::vector<Source> sources = sources_at(mesh, {0});
  CancelToken token;
  Replanner planner(mesh, weights, sources, {.cancel = &token});
  token.cancel();
  weights.face[1] = 50;
  EXPECT_THROW(planner.change(weights), Error);
  token.reset();
  weights.face[2] = 50;
  planner.change(weights);
  expect_as_fresh(planner, sources);
  EXPECT_EQ(planner.renewed(), 1);
}

TEST(Replanner, AFieldThatIsKeptKeepsItsPaths) {
  const Mesh mesh = terrain(8, 0.3);
  Weights weights = random_weights(mesh, 9);
  Replanner planner(mesh, weights, sources_at(mesh, {0}));
  const WeightedField kept = planner.field();
  const SurfacePoint end = vertex_point(mesh, 80);
  const double cost = weighted_paths(kept, {&end, 1}).front().cost;
  for (double& w : weights.face) w *= 2;
  planner.change(weights);
  EXPECT_EQ(weighted_paths(kept, {&end, 1}).front().cost, cost);
  EXPECT_NEAR(weighted_paths(planner.field(), {&end, 1}).front().cost, 2 * cost, 1e-9 * cost);
}

}  // namespace
}  // namespace brushfire
