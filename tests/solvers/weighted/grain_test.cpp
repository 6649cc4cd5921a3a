// Metrics that are not the same in all directions.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/weighted_path.h>
#include <brushfire/solvers/weighted/replanner.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <gtest/gtest.h>

#include <cmath>

#include "support/sheets.h"

namespace brushfire {
namespace {

constexpr double kAcross = 3;

// Grain in one direction of the plane, tilted by nothing.
Weights grained(const Mesh& mesh, double angle, double across = kAcross) {
  Weights weights;
  weights.grain.assign(mesh.face_count(), {{std::cos(angle), std::sin(angle), 0}, across});
  return weights;
}

double cost(Vec3 way, double angle) {
  const double with = way.x * std::cos(angle) + way.y * std::sin(angle);
  const double against = way.y * std::cos(angle) - way.x * std::sin(angle);
  return std::hypot(with, kAcross * against);
}

TEST(Grain, CostsInThePlaneAreEllipses) {
  const Mesh mesh = test::shaken_sheet(4, 4, 5);
  for (const double angle : {0.0, 0.4, 2.0}) {
    for (const SurfacePoint& from : {vertex_point(mesh, 40), SurfacePoint{100, {0.2, 0.3, 0.5}}}) {
      const Vec3 start = position(mesh, from);
      const SurfacePoint target{301, {0.3, 0.3, 0.4}};
      const WeightedField field = weighted_distance(mesh, grained(mesh, angle), std::vector<Source>{{from}},
                                                    {.tolerance = 0.01, .targets = {}});
      EXPECT_TRUE(field.lower.empty());
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const double truth = cost(mesh.positions()[v] - start, angle);
        EXPECT_GE(field.distance[v], truth * (1 - 1e-12));
        EXPECT_LE(field.distance[v], truth * 1.02 + 1e-12);
      }
      WeightedSolver solver(mesh, grained(mesh, angle));
      const WeightedPath path = weighted_path(solver, from, target);
      const double truth = cost(position(mesh, target) - start, angle);
      EXPECT_GE(path.cost, truth * (1 - 1e-12));
      EXPECT_LE(path.cost, truth * 1.02);
      double sum = 0;
      for (const WeightedLeg& leg : path.legs) sum += leg.cost();
      EXPECT_NEAR(sum, path.cost, 1e-9 * path.cost);
    }
  }
}

TEST(Grain, IsWhatStretchingTheMeshIs) {
  // A sheet that is folded along lines of x: x lies in the plane of every face.
  const Mesh folded = test::squares(10, [](Index, Index y) { return y % 2 == 0 ? 0.0 : 1.0; });
  std::vector<Vec3> positions(folded.positions().begin(), folded.positions().end());
  for (Vec3& p : positions) p.x /= kAcross;
  const Mesh narrow(positions, std::vector<Face>(folded.faces().begin(), folded.faces().end()));
  const std::vector<Source> sources{{vertex_point(folded, 0)}};
  const std::vector<double> truth = distance(narrow, sources, {.method = Method::Exact}).distance;
  const std::vector<double> found =
      weighted_distance(folded, grained(folded, 0), sources, {.tolerance = 0.01}).distance;
  for (std::size_t v = 1; v < truth.size(); ++v) {
    EXPECT_GE(found[v], kAcross * truth[v] * (1 - 1e-12));
    EXPECT_LE(found[v], kAcross * truth[v] * 1.02);
  }
}

TEST(Grain, OfOneInAllDirectionsIsNone) {
  const Mesh mesh = test::squares(8, [](Index x, Index y) { return 0.3 * std::sin(double(x + 3 * y)); });
  Weights plain;
  for (Index f = 0; f < mesh.face_count(); ++f) plain.face.push_back(1 + f % 3);
  Weights even = plain, upright = plain;
  even.grain.assign(mesh.face_count(), {{1, 2, 3}, 1});
  upright.grain.assign(mesh.face_count(), {{0, 0, 0}, 7});
  const std::vector<Source> sources{{vertex_point(mesh, 0)}};
  const std::vector<double> truth = weighted_distance(mesh, plain, sources, {.lower = false}).distance;
  for (const Weights& weights : {even, upright}) {
    const std::vector<double> found = weighted_distance(mesh, weights, sources, {.lower = false}).distance;
    for (std::size_t v = 0; v < truth.size(); ++v) EXPECT_NEAR(found[v], truth[v], 1e-12 * truth[v]);
  }
}

TEST(Grain, GoesWithWallsFencesAndChanges) {
  const Mesh mesh = test::squares(10, [](Index, Index) { return 0.0; });
  Weights weights = grained(mesh, 0.3);
  weights.face.assign(mesh.face_count(), 1);
  for (Index y = 1; y < 10; ++y) weights.face[2 * (y * 10 + 5)] = weights.face[2 * (y * 10 + 5) + 1] = kInfinity;
  weights.edges.push_back({{0, 11}, kInfinity, 2});
  const std::vector<Source> sources{{vertex_point(mesh, 60)}};
  Replanner planner(mesh, weights, sources);
  for (Index f = 10; f < 30; ++f) weights.grain[f] = {{1, 1, 0}, 0.5};
  planner.change(weights);
  EXPECT_LT(planner.renewed(), 1);
  EXPECT_EQ(planner.field().distance, weighted_distance(mesh, weights, sources, {.lower = false}).distance);
  weights.grain.clear();
  planner.change(weights);
  EXPECT_EQ(planner.field().distance, weighted_distance(mesh, weights, sources, {.lower = false}).distance);
}

TEST(Grain, DividesCells) {
  const Mesh mesh = test::squares(10, [](Index, Index) { return 0.0; });
  const Domain domain(mesh);
  DistanceOptions options;
  options.weighting = std::make_shared<const Weighting>(domain, grained(mesh, 0));
  EXPECT_DOUBLE_EQ(options.weighting->along(0, 0, 1), 1);
  EXPECT_DOUBLE_EQ(options.weighting->along(0, 1, 2), kAcross);
  options.bound = Bound::Lower;
  EXPECT_THROW(distance(mesh, std::vector<Source>{{vertex_point(mesh, 0)}}, options), Error);
}

TEST(Grain, ThatMeansNothingIsRefused) {
  const Mesh mesh = test::squares(2, [](Index, Index) { return 0.0; });
  const auto refused = [&](Weights weights) { EXPECT_THROW(check(mesh, weights), Error); };
  Weights weights = grained(mesh, 0);
  EXPECT_NO_THROW(check(mesh, weights));
  weights.grain[0].across = 0;
  refused(weights);
  weights = grained(mesh, 0);
  weights.grain.pop_back();
  refused(weights);
  weights = grained(mesh, 0);
  weights.grain[1].direction.x = NAN;
  refused(weights);
  weights = grained(mesh, 0);
  weights.pace = SlopePace::tobler();
  refused(weights);
  EXPECT_THROW(weighted_distance(mesh, grained(mesh, 0), std::vector<Source>{{vertex_point(mesh, 0)}},
                                 {.marching = Method::NovotniKlein}),
               Error);
}

}  // namespace
}  // namespace brushfire
