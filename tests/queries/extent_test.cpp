// Diameter, radius, eccentricities, averages and discs against full matrices and closed forms.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/extent.h>
#include <brushfire/queries/nearest_sources.h>
#include <brushfire/queries/vertex_measures.h>

#include "../support/random_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace brushfire {
namespace {

MatrixOptions exactly() {
  MatrixOptions options;
  options.distance.method = Method::Exact;
  return options;
}

std::vector<Mesh> small_meshes() {
  Shape two = shapes::plane(5, 4, 2, 1);
  const Shape other = shapes::icosphere(1, 0.3);
  const Index n = static_cast<Index>(two.positions.size());
  for (const Vec3& p : other.positions) two.positions.push_back(p + Vec3{9, 0, 0});
  for (const Face& t : other.faces) two.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  two.positions.push_back({5, 5, 5});
  return {shapes::noise_terrain(9, 14, 0.4, 3).mesh(), shapes::folded_sphere(2, 4, 0.2, 5).mesh(),
          shapes::torus(14, 7).mesh(), shapes::icosphere(2).mesh(), two.mesh()};
}

TEST(Extent, CertificatesHoldAgainstTheFullMatrix) {
  for (const Mesh& mesh : small_meshes()) {
    const Index n = mesh.vertex_count();
    const std::vector<double> all = distance_matrix<double>(mesh, std::nullopt, std::nullopt, exactly());
    std::vector<double> eccentricity(n, 0);
    double diameter = 0;
    for (Index v = 0; v < n; ++v) {
      for (Index w = 0; w < n; ++w) {
        if (all[v * n + w] < kInfinity) eccentricity[v] = std::max(eccentricity[v], all[v * n + w]);
      }
      diameter = std::max(diameter, eccentricity[v]);
    }
    constexpr double kRounding = 1e-11;
    for (const Index most : {1u, 3u, 10u, 0u}) {
      ExtentOptions options;
      options.max_runs = most;
      const Extent e = extent(mesh, options);
      EXPECT_LE(e.diameter_lower, diameter + kRounding);
      EXPECT_GE(e.diameter_upper, diameter - kRounding);
      EXPECT_NEAR(all[e.pair[0] * n + e.pair[1]], e.diameter_lower, kRounding);
      EXPECT_NEAR(eccentricity[e.centre], e.radius_upper, kRounding);
      double radius = kInfinity;  // of the component of the pair
      for (Index v = 0; v < n; ++v) {
        if (all[v * n + e.centre] < kInfinity) radius = std::min(radius, eccentricity[v]);
      }
      EXPECT_LE(e.radius_lower, radius + kRounding);
      EXPECT_GE(e.radius_upper, radius - kRounding);
      if (most == 0) {
        EXPECT_NEAR(e.diameter_upper, diameter, 1e-8);
        EXPECT_NEAR(e.radius_lower, radius, 1e-8);
      }
    }
    const std::vector<double> read = eccentricities(mesh, std::nullopt, exactly());
    for (Index v = 0; v < n; ++v) {
      if (mesh.corners(v).empty()) {
        EXPECT_EQ(read[v], kInfinity);
      } else {
        EXPECT_NEAR(read[v], eccentricity[v], kRounding);
      }
    }
  }
}

TEST(Extent, ALongStripIsCertifiedByFewFields) {
  const Mesh mesh = shapes::plane(200, 6, 20, 1).mesh();
  const Extent e = extent(mesh, {.tolerance = 1e-3});
  EXPECT_NEAR(e.diameter_lower, std::hypot(20, 1), 1e-9);
  EXPECT_LE(e.diameter_upper, e.diameter_lower * 1.001);
  EXPECT_LT(e.runs, 100u);
  EXPECT_LT(std::abs(position(mesh, vertex_point(mesh, e.centre)).x - 10), 0.2);
  EXPECT_THROW(extent(mesh, {.tolerance = -1}), Error);
  EXPECT_EQ(extent(Mesh()).centre, kNoIndex);
}

TEST(VertexMeasures, AverageDistanceOfAStripsEndIsHalfItsLength) {
  const Mesh mesh = shapes::plane(100, 1, 100, 1e-3).mesh();
  const std::vector<Place> end{Index{0}, Index{50}};
  const std::vector<double> mean = average_distances(mesh, std::span<const Place>(end), exactly());
  EXPECT_NEAR(mean[0], 50, 1e-3);
  EXPECT_NEAR(mean[1], 25, 1e-3);
}

TEST(VertexMeasures, DiscsOnAPlaneAndASphereHaveTheClosedForms) {
  const Mesh plane = shapes::plane(80, 80, 2, 2).mesh();
  const std::vector<Place> middle{Index{40 * 81 + 40}};
  for (const double share : {0.01, 0.1, 0.5}) {
    const Discs d = discs_of_share(plane, share, std::span<const Place>(middle), exactly());
    const double r = std::sqrt(share * 4 / kPi);
    EXPECT_NEAR(d.radius[0], r, 2e-3) << share;
    EXPECT_NEAR(d.perimeter[0], 2 * kPi * r, 2e-2) << share;
    EXPECT_NEAR(d.area[0], share * 4, 1e-9);
  }
  const Mesh sphere = shapes::icosphere(4).mesh();
  const std::vector<Place> pole{Index{0}};
  for (const double share : {0.05, 0.5, 1.0}) {
    const Discs d = discs_of_share(sphere, share, std::span<const Place>(pole), exactly());
    const double angle = std::acos(1 - 2 * share);
    EXPECT_NEAR(d.radius[0], angle, 1e-2) << share;
    EXPECT_NEAR(d.perimeter[0], 2 * kPi * std::sin(angle), 3e-2) << share;
  }
  EXPECT_THROW(discs_of_share(plane, 0), Error);
  EXPECT_THROW(discs_of_share(plane, 1.5), Error);
}

// [-1, 1]^2 in 80 x 80 squares, vertex (i, j) at ((i - 40) / 40, (j - 40) / 40).
struct WalledSquare {
  Mesh mesh = shapes::plane(80, 80, 2, 2).mesh();
  static Index vertex(Index i, Index j) { return j * 81 + i; }
  // Along y = 0, from the left border to column `end`.
  Barriers wall_to(Index end) const {
    Barriers walls;
    for (Index i = 0; i < end; ++i) walls.edges.push_back({vertex(i, 40), vertex(i + 1, 40)});
    return walls;
  }
  // Radius, perimeter, area.
  std::array<double, 3> disc(const Barriers& walls, Index place, double share) const {
    const std::vector<Place> places{place};
    const Discs d = discs_of_share(Domain(mesh, walls), share, std::span<const Place>(places), exactly());
    return {d.radius[0], d.perimeter[0], d.area[0]};
  }
};

TEST(VertexMeasures, DiscsAtWallsHaveTheClosedForms) {
  const WalledSquare square;
  for (const double share : {0.02, 0.1}) {
    // Half a disc above a wall that parts the square; the place is one row above it, all but on it.
    Barriers below = square.wall_to(80);
    const double half = 2 * share;  // of the upper half's area, 2
    const auto [r, rim, area] = square.disc(below, square.vertex(40, 41), share);
    EXPECT_NEAR(area, half, 1e-9);
    const double h = 1.0 / 40;
    const auto area_above = [&](double x) { return x * x * (kPi - std::acos(h / x)) + h * std::sqrt(x * x - h * h); };
    EXPECT_NEAR(area_above(r), half, 2e-2 * half) << share;
    EXPECT_NEAR(rim, 2 * r * (kPi - std::acos(h / r)), 2e-2) << share;
    // A place on the wall is on both sides: a whole disc, of the whole square.
    const auto [on_r, on_rim, on_area] = square.disc(below, square.vertex(40, 40), share);
    EXPECT_NEAR(on_area, 4 * share, 1e-9);
    EXPECT_NEAR(on_r, std::sqrt(4 * share / kPi), 3e-3) << share;
    EXPECT_NEAR(on_rim, 2 * kPi * on_r, 3e-2) << share;
    // A quarter, in a corner that faces leave: three quadrants are blocked.
    Barriers quadrants;
    for (Index f = 0; f < square.mesh.face_count(); ++f) {
      const Index cell = f / 2;
      if (cell % 80 < 40 || cell / 80 < 40) quadrants.faces.push_back(f);
    }
    const auto [q, q_rim, q_area] = square.disc(quadrants, square.vertex(40, 40), share);
    EXPECT_NEAR(q_area, share, 1e-9);
    EXPECT_NEAR(q, std::sqrt(4 * share / kPi), 3e-3) << share;
    EXPECT_NEAR(q_rim, 0.5 * kPi * q, 1e-2) << share;
  }
}

// From (0, 1/4), above the end of a wall along y = 0, x < 0: light falls past the end, and bends around it by a quarter
// of a turn.
TEST(VertexMeasures, DiscsThatReachAroundAWallsEndHaveTheClosedForm) {
  const WalledSquare square;
  const double h = 0.25;
  for (const double share : {0.1, 0.25}) {
    const auto [r, rim, area] = square.disc(square.wall_to(40), square.vertex(40, 50), share);
    const double below = r * r * std::acos(h / r) - h * std::sqrt(r * r - h * h);  // of the whole disc, under the wall
    const double expected = kPi * r * r - 0.5 * below + 0.25 * kPi * (r - h) * (r - h);
    EXPECT_NEAR(area, 4 * share, 1e-9);
    EXPECT_NEAR(area, expected, 1e-2 * expected) << share;
    EXPECT_NEAR(rim, 2 * kPi * r - r * std::acos(h / r) + 0.5 * kPi * (r - h), 3e-2) << share;
  }
}

TEST(VertexMeasures, DiscsDoNotDependOnThreadsNorOnHowFarTheRunWent) {
  const Mesh mesh = shapes::noise_terrain(30, 30, 0.3, 2).mesh();
  MatrixOptions one = exactly(), two = exactly();
  one.threads = 1;
  two.threads = 2;
  const Discs a = discs_of_share(mesh, 0.03, std::nullopt, one), b = discs_of_share(mesh, 0.03, std::nullopt, two);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.perimeter, b.perimeter);
  // By definition: the area nearer than the radius, from a whole field, counted finely.
  for (const Index v : {0u, 480u, 960u}) {
    const Source source{vertex_point(mesh, v)};
    DistanceOptions options;
    options.method = Method::Exact;
    const DistanceField field = distance(mesh, std::span(&source, 1), options);
    double inside = 0, whole = 0;
    constexpr int kParts = 40;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto [x, y, z] = mesh.faces()[f];
      const double area = mesh.double_areas()[f];
      whole += area;
      int count = 0, all = 0;
      for (int i = 0; i < kParts; ++i) {
        for (int j = 0; i + j < kParts; ++j) {
          const double s = (i + 1.0 / 3) / kParts, t = (j + 1.0 / 3) / kParts;
          count += (1 - s - t) * field.distance[x] + s * field.distance[y] + t * field.distance[z] < a.radius[v];
          ++all;
        }
      }
      inside += area * count / all;
    }
    EXPECT_NEAR(inside / whole, 0.03, 3e-4) << v;
  }
}

TEST(NearestSources, AreTheFirstOfTheSortedColumnsOfTheMatrix) {
  const Mesh mesh = shapes::folded_sphere(3, 5, 0.2, 7).mesh();
  std::mt19937 random(5);
  std::vector<Source> sources;
  for (int i = 0; i < 40; ++i) sources.push_back({test::any_point(mesh, random), 0.05 * (i % 4)});
  sources.push_back(sources[7]);  // the same place and offset again: the lower number first
  DistanceOptions options;
  options.method = Method::Exact;
  const NearestSources near = nearest_sources(mesh, sources, 5, options);
  std::vector<std::vector<double>> column;
  for (const Source& s : sources) column.push_back(distance(mesh, std::span(&s, 1), options).distance);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::vector<double> sorted;
    for (const auto& c : column) sorted.push_back(c[v]);
    std::sort(sorted.begin(), sorted.end());
    for (Index k = 0; k < 5; ++k) {
      EXPECT_NEAR(near.distance[v * 5 + k], sorted[k], 1e-12);
      EXPECT_NEAR(column[near.source[v * 5 + k]][v], sorted[k], 1e-12);
      if (k > 0) {
        EXPECT_NE(near.source[v * 5 + k], near.source[v * 5 + k - 1]);
      }
    }
  }
  EXPECT_EQ(nearest_sources(mesh, sources, 99, options).count, 41u);
  EXPECT_THROW(nearest_sources(mesh, sources, 0), Error);
}

}  // namespace
}  // namespace brushfire
