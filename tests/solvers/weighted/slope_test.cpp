// Costs that depend on the slope, and terrain.
#include <brushfire/core/error.h>
#include <brushfire/mesh/terrain.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace brushfire {
namespace {

// n x n heights over steps of 10, from (0, 0) to the right and down.
Terrain terrain_of(Index n, const std::function<double(double, double)>& height) {
  std::vector<double> heights;
  for (Index r = 0; r < n; ++r) {
    for (Index c = 0; c < n; ++c) heights.push_back(height(10.0 * c, -10.0 * r));
  }
  return {heights, n, n, {{0, 0}, {10, 0}, {0, -10}}};
}

std::vector<double> seconds(const Terrain& terrain, const Weights& weights, Index source, bool towards = false,
                            double tolerance = 0.01) {
  const std::vector<Source> sources{{vertex_point(terrain.mesh(), source)}};
  return weighted_distance(terrain.mesh(), weights, sources, {.tolerance = tolerance, .towards = towards}).distance;
}

TEST(Terrain, NumbersVerticesRowByRowAndCutsHolesWhereNoHeightIs) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Terrain terrain(std::vector<double>{0, 1, 2, 3, 4, 5, 6, -9999, none}, 3, 3, {}, -9999);
  EXPECT_EQ(terrain.mesh().vertex_count(), 9);
  // Two whole cells, one that lacks a corner, one that lacks two.
  EXPECT_EQ(terrain.mesh().face_count(), 2 + 2 + 1);
  const Vec3 p = terrain.mesh().positions()[5];
  EXPECT_EQ(p.x, 2);
  EXPECT_EQ(p.y, -1);
  EXPECT_EQ(p.z, 5);
  for (const Face& f : terrain.mesh().faces()) {
    const auto& x = terrain.mesh().positions();
    EXPECT_GT(cross(x[f[1]] - x[f[0]], x[f[2]] - x[f[0]]).z, 0);  // seen from above
  }
}

TEST(Terrain, DropsPointsVertically) {
  const auto height = [](double x, double y) { return 3 * x - 2 * y + 1; };
  const Terrain terrain = terrain_of(9, height);
  for (double x = 0; x <= 80; x += 7.3) {
    for (double y = 0; y >= -80; y -= 6.7) {
      const Vec3 p = position(terrain.mesh(), terrain.below(x, y));
      EXPECT_NEAR(p.x, x, 1e-9);
      EXPECT_NEAR(p.y, y, 1e-9);
      EXPECT_NEAR(p.z, height(x, y), 1e-9);
    }
  }
  EXPECT_TRUE(terrain.below(81, -5).is_nowhere());
  EXPECT_TRUE(terrain.below(5, 0.1).is_nowhere());
}

TEST(Terrain, TakesTheDiagonalOverWhichHeightsDifferLess) {
  const Terrain ridge(std::vector<double>{5, 0, 1, 5}, 2, 2);  // along 0 - 3
  const Terrain other(std::vector<double>{0, 5, 5, 1}, 2, 2);  // along 1 - 2
  EXPECT_NEAR(position(ridge.mesh(), ridge.below(0.5, -0.5)).z, 5, 1e-12);
  EXPECT_NEAR(position(other.mesh(), other.below(0.5, -0.5)).z, 5, 1e-12);
}

TEST(Slope, OnFlatGroundIsochronesAreCirclesWithinTheTolerance) {
  const Terrain flat = terrain_of(41, [](double, double) { return 7.0; });
  const Index middle = 20 * 41 + 20;
  const std::vector<double> d = seconds(flat, {.pace = SlopePace::tobler()}, middle);
  const double pace = SlopePace::tobler()(0);
  EXPECT_NEAR(1 / pace * 3.6, 6 * std::exp(-3.5 * 0.05), 1e-6);  // km/h
  double worst = 0;
  for (Index v = 0; v < d.size(); ++v) {
    if (v == middle) continue;
    const double truth = pace * norm(flat.mesh().positions()[v] - flat.mesh().positions()[middle]);
    EXPECT_GE(d[v], truth * (1 - 1e-9));
    worst = std::max(worst, d[v] / truth - 1);
  }
  EXPECT_LT(worst, 0.01);  // eight neighbours are 8 % off
}

TEST(Slope, UpAndDownAPlaneTakeWhatTheFunctionSays) {
  const double slope = 0.2;
  const Terrain ramp = terrain_of(21, [&](double x, double) { return slope * x; });
  const Index low = 10 * 21, high = low + 20;
  for (const SlopePace& pace : {SlopePace::tobler(), SlopePace::naismith(), SlopePace::energy()}) {
    const std::vector<double> up = seconds(ramp, {.pace = pace}, low), down = seconds(ramp, {.pace = pace}, high);
    // Straight up is the cheapest of what does not tack; a path that tacks at edges may be cheaper still.
    EXPECT_LE(up[high], 200 * pace(slope) * (1 + 1e-9));
    EXPECT_GE(up[high], 200 * pace(slope) * 0.95);
    EXPECT_LE(down[low], 200 * pace(-slope) * (1 + 1e-9));
    EXPECT_GT(up[high], 1.1 * down[low]);
    // From high to low, as seen from low.
    EXPECT_NEAR(seconds(ramp, {.pace = pace}, low, true)[high], down[low], 0.01 * down[low]);
    // Level, across the slope.
    EXPECT_NEAR(up[0], 100 * pace(0), 0.01 * up[0]);
  }
}

TEST(Slope, TwoPointsOfOneHeightOnARidgeCostTheSameBothWays) {
  const Terrain hill = terrain_of(21, [](double x, double) { return 30 * std::exp(-std::pow((x - 100) / 40, 2)); });
  const Index left = 10 * 21, right = left + 20;
  const Weights weights{.pace = SlopePace::tobler()};
  EXPECT_NEAR(seconds(hill, weights, left)[right], seconds(hill, weights, right)[left],
              0.01 * seconds(hill, weights, left)[right]);
  EXPECT_GT(seconds(hill, weights, left)[right], 200 * SlopePace::tobler()(0));
}

TEST(Slope, WhatIsTooSteepToGoStraightUpIsTraversed) {
  // A step 10 high over one cell: straight up at slope 1, or along it at 0.3.
  const Terrain step = terrain_of(21, [](double x, double) { return x > 100 ? 10.0 : 0.0; });
  const Index left = 10 * 21, right = left + 20;
  const Weights free{.pace = SlopePace::naismith()}, careful{.pace = SlopePace::naismith().up_to(0.3)};
  const double straight = seconds(step, free, left)[right], along = seconds(step, careful, left)[right];
  EXPECT_LE(straight, 0.72 * 200 + 60 + 1e-9);
  // At least 10 / 0.3 on the map while climbing, 10 of them ahead.
  EXPECT_GE(along, 0.72 * (190 + 10 / 0.3) + 60 - 0.72 * 30);
  EXPECT_GT(along, 1.05 * straight);
  EXPECT_LT(along, 1.5 * straight);
}

// Tobler's function is cheapest to climb at 2 / 7, where its pace is the tangent through level ground of no cost.
TEST(Slope, SteepStepsInTacksCostWhatAZigzagDoes) {
  const SlopePace plain = SlopePace::tobler(), tacks = plain.tacking();
  const double gentle = 2.0 / 7;
  for (const double s : {-0.28, -0.05, 0.0, 0.1, 0.28}) EXPECT_NEAR(tacks(s), plain(s), 1e-12 * plain(s)) << s;
  for (const double s : {0.3, 0.6, 1.9, 2.5, 40.0}) {
    // A map unit at slope s: s / gentle of way at the gentler slope, left and right in turns.
    EXPECT_NEAR(tacks(s), s / gentle * plain(gentle), 1e-6 * tacks(s)) << s;
    EXPECT_NEAR(tacks(-s), s / gentle * plain(-gentle), 1e-6 * tacks(s)) << s;
  }
  EXPECT_EQ(plain(2.5), kInfinity);
  const SlopePace careful = plain.up_to(0.2).tacking();
  EXPECT_NEAR(careful(0.8), 4 * plain(0.2), 1e-9);
  // On a ramp of 0.6, straight up: 200 on the map, 120 high.
  const Terrain ramp = terrain_of(21, [](double x, double) { return 0.6 * x; });
  const Index low = 10 * 21, high = low + 20;
  const double up = seconds(ramp, {.pace = tacks}, low)[high];
  EXPECT_NEAR(up, 120 / gentle * plain(gentle), 1e-6 * up);
  EXPECT_LT(up, 0.8 * 200 * plain(0.6));
  EXPECT_NEAR(seconds(ramp, {.pace = careful}, low)[high], 200 * 3 * plain(0.2), 1e-6);
}

TEST(Slope, InTacksNoTwoDirectionsOfAPlaneAreCheaperThanTheStraightOne) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  const SlopePace plain = SlopePace::tobler(), tacks = plain.tacking();
  int cheaper = 0;
  for (int i = 0; i < 20000; ++i) {
    const double gradient = std::exp(2 * part(random)) / 2;
    const Vec2 a{part(random), part(random)}, b{part(random), part(random)};
    const auto cost = [&](const SlopePace& pace, Vec2 d) { return norm(d) * pace(gradient * d.x / norm(d)); };
    const double both = cost(tacks, a) + cost(tacks, b);
    EXPECT_LE(cost(tacks, a + b), both * (1 + 1e-6));
    cheaper += cost(plain, a) + cost(plain, b) < 0.99 * cost(plain, a + b);
  }
  EXPECT_GT(cheaper, 100);
}

TEST(Slope, AnyFunctionIsAPace) {
  const SlopePace pace = SlopePace::function(-1, 0.5, [](double s) { return 1 + s * s; });
  for (const double s : {-1.0, -0.3, 0.0, 0.123, 0.5}) EXPECT_NEAR(pace(s), 1 + s * s, 1e-7);
  EXPECT_EQ(pace(0.6), kInfinity);
  EXPECT_THROW(SlopePace::function(-1, 1, [](double s) { return s; }), Error);
  EXPECT_THROW(SlopePace::function(1, 1, [](double) { return 1.0; }), Error);
}

TEST(Slope, TablesAreLinearBetweenTheirSlopes) {
  const std::vector<double> slopes{-1, 0, 0.5}, paces{2, 1, 4};
  const SlopePace pace = SlopePace::table(slopes, paces);
  EXPECT_NEAR(pace(-0.5), 1.5, 1e-9);
  EXPECT_NEAR(pace(0.25), 2.5, 1e-9);
  EXPECT_NEAR(pace(0.5), 4, 1e-9);
  EXPECT_EQ(pace(0.51), kInfinity);
  EXPECT_EQ(pace(-1.01), kInfinity);
  EXPECT_THROW(SlopePace::table(std::vector<double>{0, 0}, std::vector<double>{1, 1}), Error);
  EXPECT_THROW(SlopePace::table(slopes, std::vector<double>{1, 0, 1}), Error);
  EXPECT_THROW(static_cast<void>(pace.up_to(0)), Error);
}

TEST(Slope, WeightsAreFactorsAndWallsStayWalls) {
  const Terrain flat = terrain_of(11, [](double, double) { return 0.0; });
  Weights weights{.face = std::vector<double>(flat.mesh().face_count(), 2), .pace = SlopePace::tobler()};
  const std::vector<double> d = seconds(flat, weights, 0);
  EXPECT_NEAR(d[10], 2 * 100 * SlopePace::tobler()(0), 1e-6 * d[10]);
  for (Index f = 100; f < 120; ++f) weights.face[f] = kInfinity;  // a whole row of cells
  EXPECT_EQ(seconds(flat, weights, 0)[120], kInfinity);
}

}  // namespace
}  // namespace brushfire
