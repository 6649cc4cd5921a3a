// Paths over weighted surfaces: closed forms, and costs that are those of the points that are returned.
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/weighted_path.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/sheets.h"

namespace brushfire {
namespace {

using test::shaken_sheet;

std::vector<double> weights_by_place(const Mesh& mesh, const std::function<double(Vec3)>& weight) {
  std::vector<double> weights;
  for (const Face& t : mesh.faces()) {
    const Vec3 sum = mesh.positions()[t[0]] + mesh.positions()[t[1]] + mesh.positions()[t[2]];
    weights.push_back(weight((1.0 / 3) * sum));
  }
  return weights;
}

Index vertex_near(const Mesh& mesh, double x, double y) {
  Index best = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto off = [&](Index u) { return norm(mesh.positions()[u] - Vec3{x, y, 0}); };
    if (off(v) < off(best)) best = v;
  }
  return best;
}

// The edges on the line where `on` holds of both ends.
std::vector<EdgeCost> edges_where(const Mesh& mesh, const std::function<bool(Vec3)>& on, double along,
                                  double crossing) {
  std::vector<EdgeCost> edges;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index a = mesh.from(h), b = mesh.to(h);
    if (a < b && on(mesh.positions()[a]) && on(mesh.positions()[b])) edges.push_back({{a, b}, along, crossing});
  }
  return edges;
}

// What the points and weights of a path say it costs, each leg in the cheapest of the faces that hold it.
double cost_of_points(const Mesh& mesh, const Weights& weights, const WeightedPath& path) {
  double cost = 0;
  for (std::size_t k = 0; k < path.legs.size(); ++k) {
    const WeightedLeg& leg = path.legs[k];
    const PointLocation a = locate(mesh, path.points[k], 0), b = locate(mesh, path.points[k + 1], 0);
    EXPECT_TRUE(weights_in(mesh, a, leg.face).has_value());
    EXPECT_TRUE(weights_in(mesh, b, leg.face).has_value());
    double weight = weights.face.empty() ? 1 : weights.face[leg.face];
    for (const EdgeCost& e : weights.edges) {
      if (std::minmax(e.vertices[0], e.vertices[1]) != std::minmax(leg.along[0], leg.along[1])) continue;
      weight = std::min(weight, e.along);
    }
    if (leg.along[0] != kNoIndex) {
      for (const Index h : halfedges_between(mesh, leg.along[0], leg.along[1])) {
        if (!weights.face.empty()) weight = std::min(weight, weights.face[Mesh::face_of(h)]);
      }
    }
    EXPECT_EQ(weight, leg.weight);
    cost += weight * distance_within(mesh, leg.face, a, b) * mesh.unit();
  }
  return cost;
}

void expect_cost(const Mesh& mesh, const Weights& weights, Index from, Index to, double truth, double relative,
                 const std::string& what) {
  SCOPED_TRACE(what);
  WeightedSolver solver(mesh, weights);
  const WeightedPath path = weighted_path(solver, vertex_point(mesh, from), vertex_point(mesh, to));
  EXPECT_NEAR(path.cost, truth, relative * truth);
  EXPECT_LE(path.lower, truth * (1 + 1e-12));
  EXPECT_GT(path.lower, 0.9 * truth);
  double tolls = 0;
  for (const WeightedLeg& leg : path.legs) tolls += leg.toll;
  EXPECT_NEAR(cost_of_points(mesh, weights, path) + tolls, path.cost, 1e-12 * path.cost);
}

// The least of a convex function.
double least(const std::function<double(double)>& f, double low, double high) {
  for (int i = 0; i < 300; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return f(low);
}

constexpr double kClosedForm = 1e-9;

TEST(WeightedPath, RefractsAtTheBorderOfTwoHalfPlanesAsSnellSays) {
  for (const double ratio : {2.0, 0.5, 10.0, 1e9}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Mesh mesh = shaken_sheet(2, 3, seed);
      const Weights weights{.face = weights_by_place(mesh, [&](Vec3 p) { return p.x < 1 ? 1 : ratio; })};
      const Index a = vertex_near(mesh, 0, 0.5), b = vertex_near(mesh, 2, 2.5);
      const Vec3 p = mesh.positions()[a], q = mesh.positions()[b];
      const double truth =
          least([&](double y) { return std::hypot(1, y - p.y) + ratio * std::hypot(1, q.y - y); }, 0, 3);
      expect_cost(mesh, weights, a, b, truth, kClosedForm, "ratio " + std::to_string(ratio));
    }
  }
}

TEST(WeightedPath, RefractsAtEveryOneOfFourLayers) {
  const std::vector<double> layers{1, 3, 2, 5};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = shaken_sheet(4, 3, seed);
    const Weights weights{.face =
                              weights_by_place(mesh, [&](Vec3 p) { return layers[static_cast<std::size_t>(p.x)]; })};
    const Index a = vertex_near(mesh, 0, 0.25), b = vertex_near(mesh, 4, 2.75);
    // The slowness along the layers is the same in all of them: sum of its offsets, sought by bisection.
    const double height = mesh.positions()[b].y - mesh.positions()[a].y;
    double low = 0, high = 1;
    for (int i = 0; i < 200; ++i) {
      const double s = 0.5 * (low + high);
      double climbed = 0;
      for (const double w : layers) climbed += s / std::sqrt(w * w - s * s);
      (climbed < height ? low : high) = s;
    }
    double truth = 0;
    for (const double w : layers) truth += w * w / std::sqrt(w * w - low * low);
    expect_cost(mesh, weights, a, b, truth, kClosedForm, "seed " + std::to_string(seed));
  }
}

TEST(WeightedPath, EntersAndLeavesAFasterHalfPlaneAtTheCriticalAngle) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = shaken_sheet(5, 2, seed);
    const Weights weights{.face = weights_by_place(mesh, [&](Vec3 p) { return p.y > 1 ? 3 : 1; })};
    const Index a = vertex_near(mesh, 0, 1.5), b = vertex_near(mesh, 5, 1.5);
    const double ha = mesh.positions()[a].y - 1, hb = mesh.positions()[b].y - 1;
    expect_cost(mesh, weights, a, b, 5 + (ha + hb) * std::sqrt(9.0 - 1), kClosedForm, "seed " + std::to_string(seed));
  }
}

TEST(WeightedPath, TakesACheapRoadAtTheCriticalAngle) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = shaken_sheet(5, 2, seed);
    const Weights weights{.edges = edges_where(mesh, [](Vec3 p) { return p.y == 1; }, 0.25, 0)};
    const Index a = vertex_near(mesh, 0, 1.5), b = vertex_near(mesh, 5, 0.5);
    const double ha = mesh.positions()[a].y - 1, hb = 1 - mesh.positions()[b].y;
    const double truth = 0.25 * 5 + (ha + hb) * std::sqrt(1 - 0.0625);
    expect_cost(mesh, weights, a, b, truth, kClosedForm, "seed " + std::to_string(seed));
  }
}

TEST(WeightedPath, PaysForTheFenceOrGoesRoundIt) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = shaken_sheet(2, 3, seed);
    const Index a = vertex_near(mesh, 0, 2), b = vertex_near(mesh, 2, 2);
    const auto whole = [](Vec3 p) { return p.x == 1; };
    const auto half = [](Vec3 p) { return p.x == 1 && p.y >= 1; };
    expect_cost(mesh, {.edges = edges_where(mesh, whole, kInfinity, 0.5)}, a, b, 2.5, kClosedForm, "whole");
    expect_cost(mesh, {.edges = edges_where(mesh, half, kInfinity, 0.5)}, a, b, 2.5, kClosedForm, "half, cheap");
    // The fence ends at (1, 1).
    expect_cost(mesh, {.edges = edges_where(mesh, half, kInfinity, 2)}, a, b, 2 * std::sqrt(2.0), kClosedForm,
                "half, dear");
    expect_cost(mesh, {.edges = edges_where(mesh, half, kInfinity, kInfinity)}, a, b, 2 * std::sqrt(2.0), kClosedForm,
                "half, a wall");
  }
}

TEST(WeightedPath, GoesThroughAWallOnARoad) {
  const Mesh mesh = shaken_sheet(3, 2, 1);
  const auto is_wall = [](Vec3 p) { return p.x > 1 && p.x < 2; };
  Weights weights{.face = weights_by_place(mesh, [&](Vec3 p) { return is_wall(p) ? kInfinity : 1; })};
  const Index a = vertex_near(mesh, 0, 1), b = vertex_near(mesh, 3, 1);
  WeightedSolver closed(mesh, weights);
  EXPECT_EQ(weighted_path(closed, vertex_point(mesh, a), vertex_point(mesh, b)).cost, kInfinity);
  weights.edges = edges_where(mesh, [](Vec3 p) { return p.y == 1 && p.x >= 1 && p.x <= 2; }, 4, 0);
  EXPECT_THROW(WeightedSolver(mesh, weights), Error);
  weights.face = weights_by_place(mesh, [&](Vec3 p) { return is_wall(p) ? 1e9 : 1; });
  expect_cost(mesh, weights, a, b, 2 + 4, kClosedForm, "road");
}

TEST(WeightedPath, IsStraightWhereWeightsAreOneAndNoVertexIsInItsWay) {
  // Searched, and not left to windows: a road as dear as its faces. Shortest paths on convex surfaces pass no vertex.
  for (const Mesh& mesh : {shapes::icosphere(2).mesh(), shapes::noise_terrain(12, 12, 0.3, 4).mesh()}) {
    const Weights weights{.edges = {{{mesh.from(0), mesh.to(0)}, 1, 0}}};
    WeightedSolver solver(mesh, weights);
    const std::vector<Source> sources{{vertex_point(mesh, 0)}};
    std::vector<SurfacePoint> targets;
    for (Index v = 1; v < mesh.vertex_count(); v += 7) targets.push_back(vertex_point(mesh, v));
    const DistanceField exact = distance(mesh, sources, {.method = Method::Exact, .targets = targets});
    const std::vector<WeightedPath> paths = weighted_paths(solver, sources, targets, {.tolerance = 0.02});
    std::size_t as_short = 0;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      EXPECT_GE(paths[t].cost, exact.target_distance[t] * (1 - 1e-12)) << t;
      EXPECT_LE(paths[t].cost, exact.target_distance[t] * 1.01) << t;
      as_short += paths[t].cost <= exact.target_distance[t] * (1 + kClosedForm);
    }
    // Where two paths of nearly the same length lead there, the run may have taken the other one.
    EXPECT_GE(as_short, targets.size() * 9 / 10) << targets.size();
  }
}

TEST(WeightedPath, WithOneWeightEverywhereIsTheShortestPath) {
  const Mesh mesh = shapes::icosphere(2).mesh();
  WeightedSolver solver(mesh, {.face = std::vector<double>(mesh.face_count(), 2.5)});
  const WeightedPath path = weighted_path(solver, vertex_point(mesh, 0), vertex_point(mesh, 99));
  const std::vector<Source> sources{{vertex_point(mesh, 0)}};
  EXPECT_NEAR(path.cost, 2.5 * distance(mesh, sources, {.method = Method::Exact}).distance[99], 1e-12);
  double sum = 0;
  for (const WeightedLeg& leg : path.legs) sum += leg.cost();
  EXPECT_NEAR(sum, path.cost, 1e-12);
}

TEST(WeightedPath, CostsNoMoreThanTheFieldAndNoLessThanItsBound) {
  const Mesh mesh = shapes::noise_terrain(15, 15, 0.3, 4).mesh();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    Weights weights;
    for (Index f = 0; f < mesh.face_count(); ++f)
      weights.face.push_back(seed % 2 == 0 ? random.uniform(1, 10) : 1 + 3 * (random.below(10) == 0));
    for (int i = 0; i < 30; ++i) {
      const auto h = static_cast<Index>(random.below(mesh.halfedge_count()));
      const double along = random.uniform(0.2, 1), crossing = i % 3 == 0 ? random.uniform(0, 0.05) : 0;
      weights.edges.push_back({{mesh.from(h), mesh.to(h)}, along, crossing});
    }
    WeightedSolver solver(mesh, weights);
    const std::vector<Source> sources{{{5, {0.2, 0.3, 0.5}}}};
    std::vector<SurfacePoint> targets{{5, {0.6, 0.3, 0.1}}, {400, {0.5, 0.5, 0}}, {401, {0.1, 0.3, 0.6}}};
    for (Index v = 0; v < mesh.vertex_count(); v += 11) targets.push_back(vertex_point(mesh, v));
    const WeightedField field = solver.distance(sources, {.targets = targets});
    const std::vector<WeightedPath> paths = weighted_paths(solver, sources, targets);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      ASSERT_LE(paths[t].cost, field.target_distance[t] * (1 + 1e-12)) << t;
      ASSERT_GE(paths[t].cost, field.target_lower[t] * (1 - 1e-12)) << t;
      double sum = 0, tolls = 0;
      for (const WeightedLeg& leg : paths[t].legs) {
        sum += leg.cost();
        tolls += leg.toll;
      }
      ASSERT_NEAR(sum, paths[t].cost, 1e-12 * paths[t].cost);
      ASSERT_NEAR(cost_of_points(mesh, weights, paths[t]) + tolls, paths[t].cost, 1e-11 * paths[t].cost);
    }
  }
}

}  // namespace
}  // namespace brushfire
