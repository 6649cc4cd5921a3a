// Sides of curves that run back the way that they came: spikes, keyholes, polygons whose sides share their first edges.
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/curve_sides.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/surface_curves.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "curves/random_curves.h"
#include "curves/random_polygons.h"

namespace brushfire {
namespace {

// Whether the straight way from a to b, but for where it begins, comes over one of the polygon's sides.
bool crosses(const test::SimplePolygon& polygon, const Vec3& a, const Vec3& b) {
  const auto cross = [](const Vec3& u, const Vec3& v) { return u.x * v.y - u.y * v.x; };
  for (std::size_t i = 0, j = polygon.corners.size() - 1; i < polygon.corners.size(); j = i++) {
    const Vec3 &p = polygon.corners[j], &q = polygon.corners[i];
    const double turn = cross(b - a, q - p);
    const double along = cross(p - a, q - p) / turn, of_side = cross(p - a, b - a) / turn;
    if (along > 1e-9 && along < 1 + 1e-9 && of_side > -1e-9 && of_side < 1 + 1e-9) return true;
  }
  return false;
}

// From a place of the polygon to a point and, traced anew, back again; nothing where it would cross the polygon.
std::vector<SurfacePoint> spike(const Mesh& mesh, const test::SimplePolygon& polygon, const SurfacePoint& from,
                                std::mt19937& random) {
  PathFinder paths(mesh);
  const SurfacePoint tip = test::any_point(mesh, random);
  std::vector<SurfacePoint> whole = paths.between(from, tip).points;
  for (std::size_t i = 1; i < whole.size(); ++i) {
    if (crosses(polygon, position(mesh, whole[i - 1]), position(mesh, whole[i]))) return {};
  }
  const std::vector<SurfacePoint> back = paths.between(tip, from).points;
  whole.insert(whole.end(), back.begin() + 1, back.end());
  return {whole.begin() + 1, whole.end()};
}

TEST(SidesBesideWhatIsRetraced, AreThoseOfThePolygonThatHasSpikes) {
  int spikes = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = test::random_triangulation(random);
    const bool turned = seed % 2 == 1;
    test::SimplePolygon polygon(mesh, random, turned);
    for (int i = 0; i < 2; ++i) {
      const std::size_t at = random() % polygon.curve.places.size();
      const std::vector<SurfacePoint> added = spike(mesh, polygon, polygon.curve.places[at], random);
      spikes += !added.empty();
      polygon.curve.places.insert(polygon.curve.places.begin() + static_cast<std::ptrdiff_t>(at) + 1, added.begin(),
                                  added.end());
    }
    const std::vector<double> d = signed_distance(mesh, std::vector{source_along(polygon.curve)});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (!(std::abs(d[v]) > 1e-9) || d[v] == kInfinity) continue;
      ASSERT_EQ(d[v] < 0, polygon.holds(mesh.positions()[v]) != turned) << "seed " << seed << ", vertex " << v;
    }
  }
  EXPECT_GT(spikes, 100);
}

// A ring as one polygon: around the outer square, in by a bridge, around the inner one the other way, and out again.
TEST(SidesBesideWhatIsRetraced, OfAKeyholePolygonAreInsideBetweenItsTwoLoops) {
  const Mesh mesh = shapes::plane(20, 20, 10, 10).mesh();
  const std::vector<Vec3> corners{{1.1, 1.2, 0}, {9.1, 1.3, 0}, {8.7, 9.2, 0}, {1.3, 8.9, 0}, {1.1, 1.2, 0},
                                  {4.1, 4.2, 0}, {4.3, 6.1, 0}, {6.2, 6.3, 0}, {6.1, 4.3, 0}, {4.1, 4.2, 0}};
  const std::vector<Vec3> outer(corners.begin(), corners.begin() + 4), inner(corners.begin() + 5, corners.end() - 1);
  const CurveSource keyhole{project_curve(mesh, corners, true).path.points, true};
  const std::vector<double> d = signed_distance(mesh, std::vector{source_along(keyhole)});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!(std::abs(d[v]) > 1e-9)) continue;
    const Vec3 p = mesh.positions()[v];
    EXPECT_EQ(d[v] < 0, test::is_inside(outer, p) && !test::is_inside(inner, p)) << p.x << ", " << p.y;
  }
}

TEST(SidesBesideWhatIsRetraced, OfACurveThereAndBackAreNone) {
  const Mesh mesh = shapes::plane(9, 9, 9, 9).mesh();
  const std::vector<Vec3> line{{2.3, 2.1, 0}, {5.5, 3.4, 0}, {6.5, 7.4, 0}, {5.5, 3.4, 0}};
  const CurveSource curve{project_curve(mesh, line, true).path.points, true};
  for (const double d : signed_distance(mesh, std::vector{source_along(curve)})) EXPECT_GT(d, 0);
}

// Two sides of a triangle leave a corner behind a saddle vertex together, and from the two ends they are traced
// differently.
TEST(SidesBesideWhatIsRetraced, OfGeodesicTrianglesTurnWithTheMesh) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  const double c = std::cos(1.0), s = std::sin(1.0);
  std::vector<Vec3> turned;
  for (const Vec3& p : mesh.positions()) turned.push_back({c * p.x - s * p.y, c * p.y + s * p.x, p.z});
  const Mesh other(turned, mesh.faces());
  const auto signs = [](const Mesh& m, const std::vector<SurfacePoint>& corners) {
    return signed_distance(m, std::vector{source_along({PathFinder(m).through(corners, true).points, true})});
  };
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    std::vector<SurfacePoint> corners;
    for (int i = 0; i < 3; ++i)
      corners.push_back(vertex_point(mesh, static_cast<Index>(random() % mesh.vertex_count())));
    const std::vector<double> a = signs(mesh, corners), b = signs(other, corners);
    for (Index v = 0; v < mesh.vertex_count(); ++v) ASSERT_NEAR(a[v], b[v], 1e-9) << "seed " << seed << ", " << v;
  }
}

}  // namespace
}  // namespace brushfire
