// Curves from chains of vertices and from space.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/surface_curves.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire {
namespace {

TEST(SurfaceCurves, ChainsOfVerticesRunAlongEdges) {
  const Mesh mesh = shapes::plane(4, 4, 4, 4).mesh();
  const SurfacePath path = curve_along(mesh, std::vector<Index>{0, 1, 2, 7, 12});
  EXPECT_EQ(path.length, 4);
  EXPECT_EQ(path.points.size(), 5u);
  const SurfacePath loop = curve_along(mesh, std::vector<Index>{0, 1, 6}, true);
  EXPECT_NEAR(loop.length, 2 + std::sqrt(2.0), 1e-12);
  EXPECT_THROW(curve_along(mesh, std::vector<Index>{0, 2}), Error);
  EXPECT_THROW(curve_along(mesh, std::vector<Index>{0, 1, 2}, true), Error);
  EXPECT_THROW(curve_along(mesh, std::vector<Index>{}), Error);
  EXPECT_THROW(curve_along(mesh, std::vector<Index>{99}), Error);
}

TEST(SurfaceCurves, APolylineOverAPlaneIsItsShadow) {
  const Mesh mesh = shapes::plane(30, 30).mesh();
  const std::vector<Vec3> star{{0.1, 0.1, 0.2}, {0.9, 0.2, 0.1}, {0.3, 0.8, -0.3}};
  const ProjectedCurve curve = project_curve(mesh, star, true);
  double perimeter = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = star[(i + 1) % 3] - star[i];
    perimeter += std::hypot(d.x, d.y);
  }
  EXPECT_NEAR(curve.path.length, perimeter, 1e-9);
  EXPECT_TRUE(curve.path.closed);
  EXPECT_NEAR(curve.largest_gap, 0.3, 1e-12);
  EXPECT_NEAR(curve.gap_position.z, -0.3, 1e-12);
  EXPECT_NEAR(length_of(mesh, curve.path.points, true), curve.path.length, 1e-9);
}

TEST(SurfaceCurves, AChordThroughASphereBecomesAnArc) {
  const Mesh mesh = shapes::icosphere(4).mesh();
  const std::vector<Vec3> chord{{1, 0, 0}, {0, 1, 0}};
  const ProjectedCurve curve = project_curve(mesh, chord);
  EXPECT_NEAR(curve.path.length, kPi / 2, 0.01);
  EXPECT_NEAR(curve.largest_gap, 1 - std::sqrt(0.5), 0.01);
  EXPECT_THROW(project_curve(mesh, {}), Error);
}

TEST(SurfaceCurves, NoWayIsAnError) {
  Shape s = shapes::plane(2, 2);
  const std::vector<Vec3> once = s.positions;
  for (const Vec3& p : once) s.positions.push_back(p + Vec3{3, 0, 0});
  const std::vector<Face> faces = s.faces;
  for (const Face& t : faces) s.faces.push_back({t[0] + 9, t[1] + 9, t[2] + 9});
  EXPECT_THROW(project_curve(s.mesh(), std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}}), Error);
}

}  // namespace
}  // namespace brushfire
