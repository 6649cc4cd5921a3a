// Certificates: what is planted is found, what is right is left alone, and nothing is called wrong that may be right.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/certify.h>
#include <brushfire/queries/surface_curves.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace brushfire {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Given {
  Mesh mesh;
  std::vector<Source> sources;

  std::vector<double> field(const DistanceOptions& options) const { return distance(mesh, sources, options).distance; }
  std::vector<double> exact(double radius = kInfinity) const {
    DistanceOptions options;
    options.method = Method::Exact;
    options.max_distance = radius;
    return field(options);
  }
  std::vector<double> by(Method method) const {
    DistanceOptions options;
    options.method = method;
    return field(options);
  }
};

Given terrain() {
  const Mesh mesh = shapes::noise_terrain(24, 24, 0.4, 3).mesh();
  return {mesh, {{vertex_point(mesh, 100)}}};
}

// Two spheres and a vertex in no face: half of it cannot be reached.
Given islands() {
  Shape s = shapes::icosphere(2);
  const auto count = static_cast<Index>(s.positions.size());
  const std::size_t faces = s.faces.size();
  for (Index v = 0; v < count; ++v) {
    const Vec3 p = s.positions[v];
    s.positions.push_back(p + Vec3{3, 0, 0});
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const Face t = s.faces[f];
    s.faces.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  s.positions.push_back({9, 9, 9});
  const Mesh mesh = s.mesh();
  return {mesh, {{vertex_point(mesh, 0)}}};
}

// Vertices whose value is `planted` are wrong as `finding` says, all others possible.
void expect_found(const Certificate& c, const std::vector<Index>& planted, Finding finding) {
  for (Index v = 0; v < c.finding.size(); ++v) {
    const bool is_planted = std::find(planted.begin(), planted.end(), v) != planted.end();
    EXPECT_EQ(c.finding[v], is_planted ? finding : Finding::Possible) << "vertex " << v;
    EXPECT_EQ(c.proven_error[v] != 0, is_planted) << "vertex " << v;
  }
  EXPECT_EQ(c.proven_wrong(), planted.size());
}

TEST(Certify, CurvesAreSourcesAsPointsAre) {
  Given given = terrain();
  const CurveSource curve{curve_along(given.mesh, std::vector<Index>{100, 101, 102, 103}).points};
  given.sources.push_back(source_along(curve, 0.01));
  std::vector<double> field = given.exact();
  EXPECT_EQ(certify(given.mesh, field, given.sources).proven_wrong(), 0u);
  EXPECT_GT(certify(given.mesh, field, terrain().sources).proven_wrong(), 0u) << "the point alone is farther away";
  field[300] *= 1.002;
  const Certificate found = certify(given.mesh, field, given.sources);
  EXPECT_EQ(found.too_long, 1u);
  EXPECT_EQ(found.finding[300], Finding::TooLong);
}

TEST(Certify, AnExactFieldIsNotProvenWrongAtAnyTolerance) {
  for (const Given& g : {terrain(), islands()}) {
    for (const double tolerance : {0.0, 1e-5, 1e-3, 1e-2, 0.1}) {
      const Certificate c = certify(g.mesh, g.exact(), g.sources, {.tolerance = tolerance});
      EXPECT_EQ(c.proven_wrong(), 0u) << tolerance;
      EXPECT_EQ(c.possible, g.mesh.vertex_count());
      EXPECT_EQ(c.worst_vertex, kNoIndex);
      EXPECT_EQ(c.least_within, 0);
      EXPECT_LE(c.max_gap, 2 * tolerance + 1e-11);
    }
  }
}

TEST(Certify, TheBoundsHoldTheDistanceAndAreAsTightAsAskedFor) {
  const Given g = terrain();
  const std::vector<double> d = g.exact();
  for (const double tolerance : {1e-2, 1e-3}) {
    const Certificate c = certify(g.mesh, d, g.sources, {.tolerance = tolerance});
    for (Index v = 0; v < d.size(); ++v) {
      EXPECT_LE(c.lower[v], d[v] * (1 + 1e-12)) << v;
      EXPECT_GE(c.upper[v], d[v] * (1 - 1e-12)) << v;
      EXPECT_LE(c.upper[v] - c.lower[v], 2 * tolerance * d[v] + 1e-15) << v;
    }
  }
}

TEST(Certify, OneVertexMovedByTwoPerMilleIsFound) {
  const Given g = terrain();
  for (const Index v : {Index{0}, Index{101}, Index{400}, g.mesh.vertex_count() - 1}) {
    for (const double by : {1.002, 0.998}) {
      std::vector<double> field = g.exact();
      const double right = field[v];
      field[v] *= by;
      const Certificate c = certify(g.mesh, field, g.sources);
      expect_found(c, {v}, by > 1 ? Finding::TooLong : Finding::TooShort);
      EXPECT_NEAR(c.proven_error[v], field[v] - right, 1e-9 * right);
      EXPECT_EQ(c.worst_vertex, v);
      EXPECT_NEAR(c.least_within, 0.002, 1e-5);
    }
  }
}

// With bounds of a tolerance t an error of more than 2 t of the distance cannot hide.
TEST(Certify, WithWideBoundsWhatIsLargerThanTheGapIsFound) {
  const Given g = terrain();
  for (const double tolerance : {1e-3, 1e-2}) {
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> field = g.exact();
      field[300] *= 1 + sign * 2.001 * tolerance;
      expect_found(certify(g.mesh, field, g.sources, {.tolerance = tolerance}), {300},
                   sign > 0 ? Finding::TooLong : Finding::TooShort);
    }
  }
}

TEST(Certify, AStatedAccuracyExcusesWhatIsWithinIt) {
  const Given g = terrain();
  std::vector<double> field = g.exact();
  for (double& d : field) d *= 1.0009;
  EXPECT_EQ(certify(g.mesh, field, g.sources, {.within = 1e-3}).proven_wrong(), 0u);
  EXPECT_EQ(certify(g.mesh, field, g.sources, {.within = 8e-4}).too_long, g.mesh.vertex_count() - 1);
  field[7] *= 0.99;
  expect_found(certify(g.mesh, field, g.sources, {.within = 1e-3}), {7}, Finding::TooShort);
  const double least = certify(g.mesh, field, g.sources).least_within;
  EXPECT_EQ(certify(g.mesh, field, g.sources, {.within = least}).proven_wrong(), 0u);
  EXPECT_EQ(certify(g.mesh, field, g.sources, {.within = least * (1 - 1e-9)}).proven_wrong(), 1u);
}

TEST(Certify, OurOwnFieldsKeepWhatTheyPromise) {
  const Given g = terrain();
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    for (const Bound bound : {Bound::Estimate, Bound::Lower, Bound::Upper}) {
      DistanceOptions options;
      options.tolerance = tolerance;
      options.bound = bound;
      const std::vector<double> field = g.field(options);
      EXPECT_EQ(certify(g.mesh, field, g.sources, {.within = tolerance}).proven_wrong(), 0u) << tolerance;
    }
  }
}

TEST(Certify, DijkstraAndMarchingAreProvenTooLongOrShort) {
  const Given g = terrain();
  const Certificate edges = certify(g.mesh, g.by(Method::Dijkstra), g.sources);
  EXPECT_GT(edges.too_long, g.mesh.vertex_count() / 2);
  EXPECT_EQ(edges.too_short, 0u);
  const Certificate marching = certify(g.mesh, g.by(Method::KimmelSethian), g.sources);
  EXPECT_GT(marching.proven_wrong(), g.mesh.vertex_count() / 2);
}

// gdist and others write 0 where no source leads, some a negative or a huge number.
TEST(Certify, WhatIsNotReachableMustBeInfinite) {
  const Given g = islands();
  const std::vector<double> right = g.exact();
  std::vector<Index> unreachable;
  for (Index v = 0; v < right.size(); ++v) {
    if (right[v] == kInfinity) unreachable.push_back(v);
  }
  ASSERT_GT(unreachable.size(), 100u);
  for (const double wrong : {0.0, -1.0, 1e300, -kInfinity}) {
    std::vector<double> field = right;
    for (const Index v : unreachable) field[v] = wrong;
    const Certificate c = certify(g.mesh, field, g.sources, {.within = 0.5});
    expect_found(c, unreachable, Finding::NotReachable);
    EXPECT_EQ(c.not_reachable, unreachable.size());
    EXPECT_EQ(c.proven_error[unreachable[0]], -kInfinity);
    EXPECT_EQ(c.least_within, kInfinity);
  }
}

TEST(Certify, InfinityNegativeNumbersAndNaNAreWrongWhereASourceLeads) {
  const Given g = islands();
  std::vector<double> field = g.exact();
  field[5] = kInfinity;
  field[6] = -1e-300;
  field[7] = kNaN;
  field[8] = -kInfinity;
  field[0] = 1e-300;  // the source itself
  const Certificate c = certify(g.mesh, field, g.sources);
  EXPECT_EQ(c.finding[5], Finding::NotReached);
  EXPECT_EQ(c.proven_error[5], kInfinity);
  EXPECT_EQ(c.finding[6], Finding::TooShort);
  EXPECT_EQ(c.finding[7], Finding::NotANumber);
  EXPECT_TRUE(std::isnan(c.proven_error[7]));
  EXPECT_EQ(c.finding[8], Finding::TooShort);
  EXPECT_EQ(c.proven_error[8], -kInfinity);
  EXPECT_EQ(c.finding[0], Finding::TooLong);
  EXPECT_EQ(c.proven_wrong(), 5u);
}

TEST(Certify, ARadiusAllowsInfinityBeyondItAndNotWithin) {
  const Given g = terrain();
  const std::vector<double> right = g.exact();
  const std::vector<double> field = g.exact(0.4);
  EXPECT_GT(std::count(field.begin(), field.end(), kInfinity), 100);
  EXPECT_EQ(certify(g.mesh, field, g.sources, {.max_distance = 0.4}).proven_wrong(), 0u);
  EXPECT_GT(certify(g.mesh, field, g.sources, {.max_distance = 0.5}).not_reached, 0u);
  EXPECT_GT(certify(g.mesh, field, g.sources).not_reached, 100u);
}

TEST(Certify, SeveralSourcesWithOffsetsAreJudgedByTheirPaths) {
  const Mesh mesh = shapes::noise_terrain(16, 16, 0.4, 3).mesh();
  const Given g{mesh, {{vertex_point(mesh, 20), -5}, {vertex_point(mesh, 200), -5.2}, {{30, {0.2, 0.5, 0.3}}, -4.9}}};
  std::vector<double> field = g.exact();
  EXPECT_EQ(certify(mesh, field, g.sources).proven_wrong(), 0u);
  EXPECT_EQ(certify(mesh, field, g.sources, {.tolerance = 1e-3}).proven_wrong(), 0u);
  field[130] += 1e-9;  // a part in 1e10 of the value
  expect_found(certify(mesh, field, g.sources), {130}, Finding::TooLong);
  field[130] = -5.3;  // less than any source starts with
  expect_found(certify(mesh, field, g.sources), {130}, Finding::TooShort);
}

// A heat-like field: smoothed, right on average and wrong nearly everywhere.
TEST(Certify, ASmoothedFieldIsFound) {
  const Given g = terrain();
  const std::vector<double> right = g.exact();
  std::vector<double> field = right;
  for (Index v = 0; v < field.size(); ++v) {
    double sum = right[v];
    int count = 1;
    for (const Index h : g.mesh.corners(v)) sum += right[g.mesh.to(h)], ++count;
    field[v] = sum / count;
  }
  const Certificate c = certify(g.mesh, field, g.sources);
  EXPECT_GT(c.too_long, g.mesh.vertex_count() / 10);
  EXPECT_GT(c.too_short, g.mesh.vertex_count() / 10);
  for (Index v = 0; v < field.size(); ++v) {
    if (c.finding[v] != Finding::Possible) {
      EXPECT_NEAR(c.proven_error[v], field[v] - right[v], 1e-10) << v;
    }
  }
}

TEST(Certify, TheSameBitsForAnyNumberOfThreads) {
  const Mesh mesh = shapes::noise_terrain(120, 120, 0.3, 5).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 7)}};
  const std::vector<double> field = distance(mesh, sources).distance;
  const Certificate one = certify(mesh, field, sources, {.tolerance = 1e-3, .threads = 1});
  const Certificate three = certify(mesh, field, sources, {.tolerance = 1e-3, .threads = 3});
  EXPECT_EQ(one.lower, three.lower);
  EXPECT_EQ(one.upper, three.upper);
  EXPECT_EQ(one.finding, three.finding);
}

TEST(Certify, BadArgumentsAreRefused) {
  const Given g = terrain();
  const std::vector<double> field = g.exact();
  EXPECT_THROW(certify(g.mesh, std::span(field).first(5), g.sources), Error);
  EXPECT_THROW(certify(g.mesh, field, {}), Error);
  EXPECT_THROW(certify(g.mesh, field, g.sources, {.tolerance = -1}), Error);
  EXPECT_THROW(certify(g.mesh, field, g.sources, {.tolerance = 0.2}), Error);
  EXPECT_THROW(certify(g.mesh, field, g.sources, {.tolerance = kNaN}), Error);
  EXPECT_THROW(certify(g.mesh, field, g.sources, {.within = -1}), Error);
  EXPECT_THROW(certify(g.mesh, field, g.sources, {.within = kNaN}), Error);
  EXPECT_THROW(certify(g.mesh, field, g.sources, {.max_distance = kNaN}), Error);
}

}  // namespace
}  // namespace brushfire
