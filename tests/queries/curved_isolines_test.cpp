// Curved isolines: every node on its level, arcs within the chord error, circles on the plane.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/solvers/distance.h>

#include "support/holes.h"
#include "support/path_checker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire {
namespace {

DistanceField exact_field(const Mesh& mesh, std::span<const Source> sources) {
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  return distance(mesh, sources, options);
}

DistanceField exact_field(const Mesh& mesh, const SurfacePoint& source) {
  const Source s{source};
  return exact_field(mesh, std::span(&s, 1));
}

double polygon_area(const Mesh& mesh, const Isoline& line) {
  double twice = 0;
  const std::size_t n = line.line.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a = test::place(mesh, line.line.points[i]), b = test::place(mesh, line.line.points[(i + 1) % n]);
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

TEST(CurvedIsolines, AreCirclesOnThePlaneToTheChordError) {
  const Mesh mesh = shapes::plane(9, 7, 9, 7).mesh();
  for (const SurfacePoint& source : {vertex_point(mesh, 34), SurfacePoint{60, {0.2, 0.5, 0.3}}}) {
    const DistanceField field = exact_field(mesh, source);
    const Vec3 centre = test::place(mesh, source);
    for (const double chord : {1e-2, 1e-4, 1e-6}) {
      const std::vector<double> levels{0.4, 1.3, 2.2};
      const std::vector<Isoline> lines = curved_isolines(*field.windows, levels, chord);
      ASSERT_EQ(lines.size(), 3u);
      for (const Isoline& line : lines) {
        EXPECT_TRUE(line.line.closed);
        for (const SurfacePoint& p : line.line.points) {
          ASSERT_NEAR(norm(test::place(mesh, p) - centre), line.level, 1e-12 * line.level);
        }
        // A chord that stays within e of its arc of radius r is shorter than it by at most a share of 4/3 e/r, and
        // the area between them is at most a share of 4/3 e/r of the disc; dips through an edge cost a little more.
        const double r = line.level, room = 2 * (chord + 1.0 / 512 / r * (chord < 1e-3 ? 1 : 0)) / r;
        EXPECT_NEAR(line.line.length / (2 * kPi * r), 1, room) << "chord error " << chord << ", level " << r;
        EXPECT_NEAR(polygon_area(mesh, line) / (kPi * r * r), 1, 2 * room);
      }
    }
  }
}

TEST(CurvedIsolines, LinesBetweenNodesStayWithinTheChordErrorOfTheLevel) {
  const Mesh mesh = shapes::plane(12, 12, 3, 3).mesh();
  const DistanceField field = exact_field(mesh, vertex_point(mesh, 84));
  const double chord = 1e-5, edge = 0.25 * std::sqrt(2.0);
  const std::vector<double> levels{0.9};
  for (const Isoline& line : curved_isolines(*field.windows, levels, chord)) {
    const std::size_t n = line.line.points.size();
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 m = 0.5 * (test::place(mesh, line.line.points[i]) + test::place(mesh, line.line.points[(i + 1) % n]));
      const double off = std::abs(norm(m - mesh.positions()[84]) - 0.9);
      ASSERT_LE(off, edge * edge / 512 / 0.9);
      beyond += off > 1.01 * chord;
    }
    EXPECT_LE(beyond, n / 10);  // where the arc dips through an edge and back
  }
}

TEST(CurvedIsolines, NodesEvaluateToTheLevelOnCurvedSurfaces) {
  for (const Shape& shape :
       {shapes::torus(16, 8), shapes::saddle(8), shapes::cube(3), shapes::noise_terrain(12, 12, 0.6)}) {
    const Mesh mesh = shape.mesh();
    const std::vector<Source> sources{{vertex_point(mesh, 3)}, {SurfacePoint{40, {0.1, 0.3, 0.6}}, 0.1}};
    const DistanceField field = exact_field(mesh, sources);
    const std::vector<double> levels = levels_between(field.distance, 5);
    const std::vector<Isoline> lines = curved_isolines(*field.windows, levels, 1e-3);
    ASSERT_FALSE(lines.empty());
    for (const Isoline& line : lines) {
      for (const SurfacePoint& p : line.line.points) {
        // Evaluated by another way: as a target of a run of its own would be slow; WindowField::value of the other
        // name of the point, in its neighbour face, must agree too.
        ASSERT_NEAR(field.windows->value(p).distance, line.level, 1e-11 * line.level);
      }
      EXPECT_NEAR(length_of(mesh, line.line.points, line.line.closed), line.line.length, 1e-12);
    }
  }
}

TEST(CurvedIsolines, BendAroundTheCornersOfAHoleAsCirclesAroundThem) {
  // An L: from the far end of one arm, fronts in the other arm are circles around the inner corner.
  const Mesh mesh =
      test::with_faces(shapes::plane(6, 6, 6, 6), [](Vec3 centre) { return centre.x < 3 || centre.y < 3; });
  const DistanceField field = exact_field(mesh, vertex_point(mesh, 6));  // (6, 0)
  const Vec3 corner{3, 3, 0};
  const double to_corner = norm(corner - Vec3{6, 0, 0});
  const std::vector<double> levels{to_corner + 1.5};
  int in_shadow = 0;
  for (const Isoline& line : curved_isolines(*field.windows, levels, 1e-4)) {
    for (const SurfacePoint& p : line.line.points) {
      const Vec3 x = test::place(mesh, p);
      const Vec3 d = x - corner;
      if (!(d.x * 1 + d.y * 1 > 1e-9 && d.x < 0)) continue;  // beyond the line from the source through the corner
      EXPECT_NEAR(norm(d), 1.5, 1e-11);
      ++in_shadow;
    }
  }
  EXPECT_GT(in_shadow, 5);
}

TEST(CurvedIsolines, BadArgumentsAreErrors) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  const DistanceField field = exact_field(mesh, vertex_point(mesh, 4));
  const std::vector<double> levels{0.3}, bad{kInfinity};
  EXPECT_THROW(curved_isolines(*field.windows, levels, 0), Error);
  EXPECT_THROW(curved_isolines(*field.windows, bad, 1e-3), Error);
}

}  // namespace
}  // namespace brushfire
