// Costs in what reads a distance field, and curves as sources of costs.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/voronoi.h>
#include <brushfire/queries/weighted_path.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "support/sheets.h"

namespace brushfire {
namespace {

using test::sources_at;

Mesh squares(Index n) {
  return test::squares(n, [](Index, Index) { return 0.0; });
}

Weights by_place(const Mesh& mesh, const std::function<double(Vec3)>& cost) {
  Weights weights;
  for (const Face& f : mesh.faces()) {
    const auto& x = mesh.positions();
    weights.face.push_back(cost((1.0 / 3) * (x[f[0]] + x[f[1]] + x[f[2]])));
  }
  return weights;
}

Weights random_weights(const Mesh& mesh) {
  std::mt19937 random(7);
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f)
    weights.face.push_back(std::uniform_real_distribution(1.0, 10.0)(random));
  return weights;
}

DistanceOptions costs(const Domain& domain, const Weights& weights) {
  DistanceOptions options;
  options.weighting = std::make_shared<const Weighting>(domain, weights);
  return options;
}

TEST(Weighting, AFieldIsThatOfTheWeightedSolver) {
  const Mesh mesh = squares(8);
  const Weights weights = random_weights(mesh);
  const std::vector<Source> sources = sources_at(mesh, {0, 44});
  DistanceOptions options = costs(mesh, weights);
  options.targets = {{7, {0.2, 0.3, 0.5}}};
  const WeightedField truth = weighted_distance(mesh, weights, sources, {.lower = false, .targets = options.targets});
  const DistanceField found = distance(mesh, sources, options);
  EXPECT_EQ(found.target_distance, truth.target_distance);
  options.targets.clear();
  const WeightedField whole = weighted_distance(mesh, weights, sources, {.lower = false});
  EXPECT_EQ(distance(mesh, sources, options).distance, whole.distance);
  EXPECT_EQ(distance(mesh, sources, options).source, whole.source);
  EXPECT_EQ(DistanceSolver(mesh).distance_sparse(sources, options).distance, whole.distance);
  options.bound = Bound::Lower;
  const DistanceField low = distance(mesh, sources, options);
  const WeightedField both = weighted_distance(mesh, weights, sources);
  EXPECT_EQ(low.distance, both.lower);
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(low.error_bound[v], both.distance[v] - both.lower[v]);
}

TEST(Weighting, RowsOfAMatrixAreFieldsForAnyNumberOfThreads) {
  const Mesh mesh = squares(6);
  const Weights weights = random_weights(mesh);
  const std::vector<Place> rows{Index{0}, Index{17}, Index{48}};
  MatrixOptions options;
  options.distance = costs(mesh, weights);
  options.threads = 1;
  const std::vector<double> one = distance_matrix<double>(mesh, Places(rows), std::nullopt, options);
  options.threads = 3;
  EXPECT_EQ(distance_matrix<double>(mesh, Places(rows), std::nullopt, options), one);
  const std::vector<double> last = weighted_distance(mesh, weights, sources_at(mesh, {48}), {.lower = false}).distance;
  EXPECT_TRUE(std::equal(last.begin(), last.end(), one.end() - mesh.vertex_count()));
  MatrixOptions below = options;  // by windows
  below.distance.bound = Bound::Lower;
  const std::vector<double> lower = distance_matrix<double>(mesh, Places(rows), std::nullopt, below);
  below.threads = 1;
  EXPECT_EQ(distance_matrix<double>(mesh, Places(rows), std::nullopt, below), lower);
  EXPECT_TRUE(std::equal(lower.begin(), lower.end(), one.begin(), [](double a, double b) { return a <= b; }));
  const SparseMatrix<double> near = distances_within<double>(mesh, 4.0, Places(rows), options);
  const auto within = std::count_if(one.begin(), one.end(), [](double d) { return d <= 4; });
  EXPECT_EQ(near.value.size(), static_cast<std::size_t>(within));
}

// From (0, y) and (12, y) over ground that costs 1 left of x = 6 and 3 right of it, the border is where both cost
// the same: at x = 6 it costs 6 from the left and 18 from the right, so it lies at 6 + t with 6 + 3 t = 3 (6 - t).
TEST(Weighting, CellsMeetWhereCostsAreEqual) {
  const Mesh mesh = squares(12);
  const Weights weights = by_place(mesh, [](Vec3 p) { return p.x < 6 ? 1.0 : 3.0; });
  CurveSource left, right;
  for (Index y = 0; y <= 12; ++y) {
    left.places.push_back(vertex_point(mesh, y * 13));
    right.places.push_back(vertex_point(mesh, y * 13 + 12));
  }
  const std::vector<Source> sources{source_along(left), source_along(right)};
  const VoronoiDiagram cells = voronoi(mesh, sources, costs(mesh, weights));
  EXPECT_NEAR(cells.area[0], 8 * 12, 1e-6);
  EXPECT_NEAR(cells.area[1], 4 * 12, 1e-6);
  ASSERT_FALSE(cells.borders.empty());
  for (const SurfacePoint& p : cells.borders[0].line.points) EXPECT_NEAR(position(mesh, p).x, 8, 1e-6);
}

TEST(Weighting, FarthestPointsAreFarthestByCost) {
  const Mesh mesh = squares(10);
  const Weights weights = by_place(mesh, [](Vec3 p) { return p.x < 8 ? 1.0 : 9.0; });
  const Samples samples = farthest_points(mesh, 2, std::vector<Index>{0}, costs(mesh, weights));
  const std::vector<double> truth = weighted_distance(mesh, weights, sources_at(mesh, {0}), {.lower = false}).distance;
  EXPECT_EQ(samples.vertices[1], std::max_element(truth.begin(), truth.end()) - truth.begin());
  EXPECT_EQ(samples.separation[1], *std::max_element(truth.begin(), truth.end()));
}

TEST(Weighting, FacesAndCrossingsThatCostInfinityAreWalls) {
  const Mesh mesh = squares(10);
  Weights weights = by_place(mesh, [](Vec3 p) { return p.x > 4 && p.x < 5 && p.y < 9 ? kInfinity : 2.0; });
  weights.edges.push_back({{5 * 11 + 7, 6 * 11 + 7}, kInfinity, kInfinity});
  Barriers walls = walls_of(weights);
  EXPECT_EQ(walls.faces.size(), 18u);
  const Domain domain(mesh, walls);
  const Weighting weighting(mesh, weights);
  EXPECT_EQ(weighting.domain().open().vertex_count(), domain.open().vertex_count());
  EXPECT_EQ(weighting.domain().open().face_count(), domain.open().face_count());
  const std::vector<Source> sources = sources_at(mesh, {0, 120});
  const DistanceOptions options = costs(mesh, weights);
  const VoronoiDiagram by_cost = voronoi(options.weighting->domain(), sources, options);
  const VoronoiDiagram by_length = voronoi(domain, sources, {.method = Method::Exact});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_GE(by_cost.distance[v], 2 * by_length.distance[v] - 1e-9);
    EXPECT_LE(by_cost.distance[v], 2.02 * by_length.distance[v]);
  }
  EXPECT_NEAR(by_cost.area[0] + by_cost.area[1], 100 - 9, 1e-9);
  const DistanceField field = distance(options.weighting->domain(), sources, options);
  EXPECT_EQ(field.side_distance.size(), domain.open().vertex_count());
}

TEST(Weighting, WallsAddToTheWallsOfADomain) {
  const Mesh mesh = squares(6);
  const Domain first(mesh, {.faces = {3}, .edges = {{8, 15}, {15, 22}}});
  const Domain both = with_walls(first, {.faces = {20}, .edges = {{24, 31}}});
  const Domain truth(mesh, {.faces = {3, 20}, .edges = {{8, 15}, {15, 22}, {24, 31}}});
  const std::vector<Source> sources = sources_at(mesh, {0});
  const DistanceOptions exact{.method = Method::Exact};
  EXPECT_EQ(distance(both, sources, exact).distance, distance(truth, sources, exact).distance);
  EXPECT_NE(distance(both, sources, exact).distance, distance(first, sources, exact).distance);
}

TEST(Weighting, WhatReadsWindowsIsRefused) {
  const Mesh mesh = squares(3);
  const Weights weights = random_weights(mesh);
  DistanceOptions options = costs(mesh, weights);
  const std::vector<Source> sources = sources_at(mesh, {0});
  const std::vector<SurfacePoint> targets{vertex_point(mesh, 5)};
  DistanceSolver solver(mesh);
  EXPECT_THROW(paths_to(solver, sources, targets, options), Error);
  options.keep_paths = true;
  EXPECT_THROW(distance(mesh, sources, options), Error);
  options.keep_paths = false;
  EXPECT_THROW(distance(squares(4), sources_at(squares(4), {0}), options), Error);
  EXPECT_THROW(distance(Domain(mesh, {.faces = {2}}), sources, options), Error);
}

// A chain of edges at x = 0: costs are those of straight ways to the right, Snell or not.
TEST(CurvesAsSources, AChainOfEdgesCostsWhatTheStraightWayFromItDoes) {
  const Mesh mesh = squares(10);
  const Weights weights = by_place(mesh, [](Vec3 p) { return p.x < 4 ? 2.0 : 5.0; });
  CurveSource chain;
  for (Index y = 0; y <= 10; ++y) chain.places.push_back(vertex_point(mesh, y * 11));
  const std::vector<Source> sources{source_along(chain, 1)};
  const WeightedField field = weighted_distance(mesh, weights, sources);
  EXPECT_TRUE(field.lower.empty());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double x = mesh.positions()[v].x;
    EXPECT_NEAR(field.distance[v], 1 + 2 * std::min(x, 4.0) + 5 * std::max(x - 4, 0.0), 1e-9) << v;
  }
}

TEST(CurvesAsSources, AcrossFacesCostsAreThoseOfRealPathsAndNear) {
  const Mesh mesh = shapes::icosphere(3).mesh();
  const Weights weights = random_weights(mesh);
  const SurfacePoint from{10, {0.2, 0.3, 0.5}}, to{300, {0.6, 0.2, 0.2}};
  DistanceSolver plain(mesh);
  CurveSource curve;
  curve.places = path_between(plain, from, to).points;
  ASSERT_GT(curve.places.size(), 5u);
  const WeightedField found = weighted_distance(mesh, weights, std::vector{source_along(curve)}, {.tolerance = 0.001});
  // Points all along it, far denser.
  std::vector<Source> points;
  for (std::size_t i = 0; i + 1 < curve.places.size(); ++i) {
    CurveSource piece;
    piece.places = {curve.places[i], curve.places[i + 1]};
    const CurveSegment s = locate(mesh, piece).segments.at(0);
    for (int k = 0; k <= 200; ++k) {
      SurfacePoint p{s.face, {}};
      for (std::size_t c = 0; c < 3; ++c) p.weights[c] = (1 - k / 200.0) * s.from[c] + k / 200.0 * s.to[c];
      points.push_back({p});
    }
  }
  const WeightedField dense = weighted_distance(mesh, weights, points, {.tolerance = 0.001, .lower = false});
  const double edge = mesh.unit();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_GE(found.distance[v], dense.distance[v] * (1 - 0.01) - 1e-4 * edge) << v;
    EXPECT_LE(found.distance[v], dense.distance[v] * (1 + 0.01) + 1e-3 * edge) << v;
  }
}

TEST(CurvesAsSources, PathsBeginOnThem) {
  const Mesh mesh = squares(6);
  const Weights weights = by_place(mesh, [](Vec3 p) { return p.x < 3 ? 1.0 : 2.0; });
  CurveSource chain;
  for (Index y = 0; y <= 6; ++y) chain.places.push_back(vertex_point(mesh, y * 7));
  WeightedSolver solver(mesh, weights);
  const std::vector<Source> sources{source_along(chain)};
  const std::vector<SurfacePoint> targets{vertex_point(mesh, 2 * 7 + 6)};
  const WeightedPath path = weighted_paths(solver, sources, targets).at(0);
  EXPECT_NEAR(path.cost, 3 + 6, 1e-9);
  EXPECT_NEAR(position(mesh, path.points.front()).x, 0, 1e-12);
  EXPECT_EQ(path.source, 0u);
}

}  // namespace
}  // namespace brushfire
