// How level sets run does not depend on how finely the surface is cut into faces, nor on where its vertices lie.
#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/subdivide.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace brushfire {
namespace {

struct Level {
  std::size_t lines = 0;
  double length = 0;
  double off = 0;  // the farthest that a node's value is from the level
};

Level level_set(const Mesh& mesh, const Source& source, double level, double chord_error,
                DistanceOptions options = {.method = Method::Exact}) {
  options.keep_windows = true;
  const DistanceField field = distance(mesh, std::span(&source, 1), options);
  Level sum;
  for (const Isoline& line : curved_isolines(*field.windows, std::vector<double>{level}, chord_error)) {
    ++sum.lines;
    sum.length += line.line.length;
    for (const SurfacePoint& p : line.line.points) {
      sum.off = std::max(sum.off, std::abs(field.windows->value(p).distance - level));
    }
  }
  return sum;
}

Mesh in_four(const Mesh& mesh) { return subdivided(mesh, {.rule = SubdivisionRule::Midpoint}).mesh(); }

double largest(const Mesh& mesh, const Source& source) {
  const DistanceField field = distance(mesh, std::span(&source, 1), {.method = Method::Exact});
  return *std::max_element(field.distance.begin(), field.distance.end());
}

// Twelve large faces, and thousands of small ones: around the farthest points, where fronts meet, curves are small.
TEST(LevelMesh, OfACubeHasTheSameCurvesHoweverManyFacesItHas) {
  const Mesh coarse = shapes::cube(1).mesh(), fine = shapes::cube(16).mesh();
  const NearestPointFinder on_coarse(coarse), on_fine(fine);
  constexpr double kChord = 1e-5;
  Random random(7);
  for (int i = 0; i < 6; ++i) {
    const Vec3 at{random.uniform(0, 1), random.uniform(0, 1), 0};
    const Source a{on_coarse(at).point}, b{on_fine(at).point};
    const double most = largest(fine, b);
    for (const double share : {0.999, 0.99, 0.97, 0.9, 0.6}) {
      const Level few = level_set(coarse, a, share * most, kChord), many = level_set(fine, b, share * most, kChord);
      EXPECT_EQ(few.lines, many.lines) << "source " << i << ", level " << share;
      EXPECT_NEAR(few.length, many.length, 1e-4 * (1 + many.length)) << "source " << i << ", level " << share;
      EXPECT_LE(std::max(few.off, many.off), 1e-13);
    }
  }
}

// Saddles, whose shadows begin at vertices; rough ground, on which many small curves lie.
TEST(LevelMesh, OfACurvedSurfaceHasTheSameCurvesWhenItsFacesAreCut) {
  for (const Shape& shape : {shapes::torus(14, 7), shapes::saddle(6), shapes::noise_terrain(9, 9, 0.8, 3)}) {
    const Mesh coarse = shape.mesh(), fine = in_four(in_four(coarse));
    const Source source{vertex_point(coarse, 5)}, same{vertex_point(fine, 5)};
    const double most = largest(fine, same);
    for (int i = 1; i < 16; ++i) {
      const double level = most * i / 16;
      const Level few = level_set(coarse, source, level, 1e-5), many = level_set(fine, same, level, 1e-5);
      EXPECT_EQ(few.lines, many.lines) << level;
      EXPECT_NEAR(few.length, many.length, 2e-4 * (1 + many.length)) << level;
    }
  }
}

TEST(LevelMesh, HasCurvesInFacesWhoseCornersLieBeyondTheRadius) {
  const Mesh mesh = shapes::plane(1, 1, 8, 8).mesh();
  const NearestPointFinder finder(mesh);
  const Source source{finder(Vec3{3, 2, 0}).point};
  DistanceOptions options{.method = Method::Exact};
  options.max_distance = 1.5;
  const Level r = level_set(mesh, source, 1.25, 1e-6, options);
  EXPECT_EQ(r.lines, 1u);
  EXPECT_NEAR(r.length, 2 * kPi * 1.25, 1e-4);
}

TEST(LevelMesh, AroundASegmentIsTwoSidesAndTwoHalfCircles) {
  const Mesh mesh = shapes::plane(1, 1, 8, 8).mesh();
  const NearestPointFinder finder(mesh);
  // Away from the diagonal, and over it.
  for (const auto& [from, to] :
       {std::pair{Vec3{4, 1.5, 0}, Vec3{6, 2, 0}}, std::pair{Vec3{3, 4.5, 0}, Vec3{5, 4, 0}}}) {
    CurveSource curve{{finder(from).point, finder(0.5 * (from + to)).point, finder(to).point}};
    if (from.x < from.y) curve.places[1] = finder(from + (1.5 / 2.5) * (to - from)).point;  // on the diagonal
    for (const double level : {1e-3, 0.1, 1.0}) {
      const Level r = level_set(mesh, source_along(curve), level, 1e-5);
      EXPECT_EQ(r.lines, 1u);
      EXPECT_NEAR(r.length, 2 * norm(to - from) + 2 * kPi * level, 1e-3) << level;
    }
  }
}

TEST(LevelMesh, OfTwoSheetsOverTheSameVerticesIsThatOfOne) {
  const Shape one = shapes::noise_terrain(6, 6, 0.5, 2);
  Shape two = one;
  for (const Face& f : one.faces) two.faces.push_back({f[1], f[0], f[2]});  // turned round
  const Source source{vertex_point(one.mesh(), 10)};
  const double level = 0.55 * largest(one.mesh(), source);
  const Level single = level_set(one.mesh(), source, level, 1e-5), doubled = level_set(two.mesh(), source, level, 1e-5);
  EXPECT_NEAR(doubled.length, 2 * single.length, 1e-9);
}

TEST(LevelMesh, OfMergedWindowsEndsAndHasItsNodesOnTheLevel) {
  const Mesh mesh = shapes::noise_terrain(20, 20, 0.8, 5).mesh();
  DistanceOptions options;
  options.method = Method::Windows;
  options.tolerance = 0.05;
  const Source source{vertex_point(mesh, 200)};
  for (const double share : {0.2, 0.5, 0.8, 0.95}) {
    const Level merged = level_set(mesh, source, share * largest(mesh, source), 1e-6, options);
    EXPECT_GT(merged.lines, 0u);
    EXPECT_LE(merged.off, 1e-12);
  }
}

}  // namespace
}  // namespace brushfire
