// Surface points: validation, snapping, exact distances to the corners.
#include <brushfire/core/error.h>
#include <brushfire/mesh/surface_point.h>

#include <gtest/gtest.h>

namespace brushfire {
namespace {

Mesh square() {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 3}};
  return Mesh(positions, faces);
}

TEST(SurfacePoint, PointNearAVertexIsTheVertex) {
  const PointLocation at = locate(square(), {0, {1.0, -5.6e-17, 1e-13}});
  EXPECT_EQ(at.on, PointLocation::On::Vertex);
  EXPECT_EQ(at.vertex, 0u);
}

TEST(SurfacePoint, PointNearAnEdgeIsOnTheEdge) {
  const PointLocation at = locate(square(), {0, {0.25, 1e-14, 0.75}});
  EXPECT_EQ(at.on, PointLocation::On::Edge);
  EXPECT_EQ(at.halfedge, 2u);
  EXPECT_NEAR(at.t, 0.25, 1e-13);
}

TEST(SurfacePoint, BadWeightsAndFacesAreErrors) {
  const Mesh mesh = square();
  EXPECT_THROW(locate(mesh, {2, {1, 0, 0}}), Error);
  EXPECT_THROW(locate(mesh, {0, {1.1, -0.1, 0}}), Error);
  EXPECT_THROW(locate(mesh, {0, {0.5, 0.4, 0}}), Error);
}

TEST(SurfacePoint, VertexInNoFaceIsAnError) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}};
  EXPECT_THROW(vertex_point(Mesh(positions, faces), 3), Error);
  EXPECT_THROW(vertex_point(Mesh(positions, faces), 4), Error);
}

TEST(SurfacePoint, CornerDistancesKeepTheirDigitsNextToACorner) {
  const Mesh mesh = square();
  for (const double tiny : {1e-3, 1e-6, 1e-11}) {
    const std::array<double, 3> d = corner_distances(mesh, locate(mesh, {0, {1 - 2 * tiny, tiny, tiny}}));
    EXPECT_NEAR(d[0] * mesh.unit() / tiny, std::sqrt(5.0), 1e-14);
  }
}

}  // namespace
}  // namespace brushfire
