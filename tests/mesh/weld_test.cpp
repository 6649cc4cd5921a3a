// Vertices that become one, and what the report says of those that could.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/weld.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace brushfire {
namespace {

// Every face with vertices of its own, each moved by at most `shake` along every axis.
Mesh soup_of(const Mesh& mesh, double shake) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> move(-shake, shake);
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (const Face& f : mesh.faces()) {
    const auto n = static_cast<Index>(positions.size());
    for (const Index v : f) positions.push_back(mesh.positions()[v] + Vec3{move(random), move(random), move(random)});
    faces.push_back({n, n + 1, n + 2});
  }
  return Mesh(positions, faces);
}

TEST(Weld, ToleranceZeroJoinsEqualPositionsOnly) {
  const Mesh sphere = shapes::icosphere(3).mesh();
  const Welded welded = weld(soup_of(sphere, 0), 0);
  EXPECT_EQ(welded.mesh.vertex_count(), sphere.vertex_count());
  EXPECT_EQ(welded.mesh.face_count(), sphere.face_count());
  EXPECT_EQ(welded.mesh.report().boundary_edges, 0u);
  EXPECT_EQ(weld(soup_of(sphere, 1e-9), 0).joined, 0u);
}

TEST(Weld, ShakenSoupBecomesTheSurfaceAgainAndTheMapLeadsBack) {
  const Mesh sphere = shapes::icosphere(3).mesh();
  const Mesh soup = soup_of(sphere, 1e-6);
  const double tolerance = 1e-5;
  const Welded welded = weld(soup, tolerance);
  EXPECT_EQ(welded.mesh.vertex_count(), sphere.vertex_count());
  EXPECT_EQ(welded.joined, soup.vertex_count() - sphere.vertex_count());
  EXPECT_EQ(welded.mesh.report().euler_characteristic, 2);
  ASSERT_EQ(welded.vertex_map.size(), soup.vertex_count());
  for (Index v = 0; v < soup.vertex_count(); ++v) {
    EXPECT_LE(norm(soup.positions()[v] - welded.mesh.positions()[welded.vertex_map[v]]), tolerance);
  }
  for (Index f = 0; f < soup.face_count(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(welded.mesh.faces()[f][k], welded.vertex_map[soup.faces()[f][k]]);
    }
  }
}

TEST(Weld, ChainsDoNotRunTogether) {
  std::vector<Vec3> positions;
  for (int k = 0; k < 10; ++k) positions.push_back({0.75 * k, 0, 0});
  const Welded welded = weld(Mesh(positions, {}), 1);
  // 0 takes 1; 2 is kept and takes 3; and so on.
  EXPECT_EQ(welded.vertex_map, (std::vector<Index>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4}));
}

TEST(Weld, FacesKeepTheirNumbersWhereCornersMeet) {
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {1e-6, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                  std::vector<Face>{{0, 1, 2}, {1, 3, 2}});
  const Welded welded = weld(mesh, 1e-5);
  EXPECT_EQ(welded.mesh.face_count(), 2u);
  EXPECT_EQ(welded.mesh.report().repeated_index_faces, 1u);
}

TEST(Weld, AnyScaleAndPlaceGivesTheSameMap) {
  const Mesh soup = soup_of(shapes::icosphere(2).mesh(), 1e-6);
  const std::vector<Index> expected = weld(soup, 1e-5).vertex_map;
  for (const double scale : {0x1p-300, 0x1p-30, 0x1p30, 0x1p300}) {
    std::vector<Vec3> positions;
    for (const Vec3& p : soup.positions()) positions.push_back(scale * p);
    EXPECT_EQ(weld(Mesh(positions, soup.faces()), scale * 1e-5).vertex_map, expected) << scale;
  }
}

TEST(Weld, ATinyToleranceFarFromTheOriginJoinsEqualPositions) {
  const std::vector<Vec3> positions{{1e297, 1, 0}, {1e297, 1, 0}, {1e297, 1 + 1e-9, 0}, {0, 0, 0}, {1e-300, 0, 0}};
  for (const double tolerance : {0.0, 1e-320, 1e-305, 1e-12}) {
    EXPECT_EQ(weld(Mesh(positions, {}), tolerance).vertex_map[1], 0u) << tolerance;
    EXPECT_EQ(weld(Mesh(positions, {}), tolerance).vertex_map[2], 1u) << tolerance;
  }
}

TEST(Weld, WhatIsNoToleranceIsAnError) {
  const Mesh mesh = shapes::plane(1, 1).mesh();
  for (const double tolerance : {-1.0, kInfinity, std::nan("")}) EXPECT_THROW(weld(mesh, tolerance), Error);
  const Mesh intrinsic =
      Mesh::from_lengths(3, std::vector<Face>{{0, 1, 2}}, std::vector<std::array<double, 3>>{{1, 1, 1}});
  EXPECT_THROW(weld(intrinsic, 0), Error);
}

TEST(Report, NearVerticesOfASeamAreCountedWithTheToleranceThatJoinsThem) {
  // Two squares that meet along x = 1 but for 1e-7 and 2e-7.
  const std::vector<Vec3> positions{{0, 0, 0},        {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {1 + 1e-7, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1 + 2e-7, 0}};
  const Mesh mesh(positions, std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
  const MeshReport& report = mesh.report();
  EXPECT_EQ(report.near_positions, 4u);
  EXPECT_NEAR(report.near_tolerance, 2e-7, 1e-15);
  EXPECT_EQ(weld(mesh, report.near_tolerance).mesh.report().components, 1u);
  const std::vector<std::string> remarks = report.remarks();
  const bool names_the_option = std::any_of(remarks.begin(), remarks.end(), [](const std::string& r) {
    return r.find("(--weld 2e-07 joins them)") != std::string::npos;
  });
  EXPECT_TRUE(names_the_option) << remarks.back();
}

TEST(Report, OrdinaryBoundariesAndFineCornersHaveNoNearVertices) {
  EXPECT_EQ(shapes::plane(20, 20).mesh().report().near_positions, 0u);
  // A fine fan in a corner of a coarse triangle: near by the mesh's mean edge, not by its own.
  const std::vector<Vec3> positions{{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {1e-6, 1e-6, 0}, {1000, 0, 0}, {0, 1000, 0}};
  const Mesh mesh(positions, std::vector<Face>{{0, 1, 2}, {1, 3, 2}, {3, 4, 5}});
  EXPECT_EQ(mesh.report().near_positions, 0u);
}

}  // namespace
}  // namespace brushfire
