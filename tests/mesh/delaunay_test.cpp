// The Delaunay generator against its definition, checked in exact arithmetic.
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/report.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire {
namespace {

__extension__ using Wide = __int128;

// Faces whose circle holds the opposite corner of a neighbour, decided exactly: all positions are whole multiples of
// `step`.
Index edges_that_are_not_delaunay(const Mesh& mesh, double step) {
  const auto whole = [&](Index v, Index origin) {
    const Vec3 p = mesh.positions()[v], o = mesh.positions()[origin];
    return std::array<Wide, 2>{static_cast<Wide>((p.x - o.x) / step), static_cast<Wide>((p.y - o.y) / step)};
  };
  Index wrong = 0;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index g = mesh.opposite()[h];
    if (g == h) continue;
    const Index d = mesh.from(Mesh::previous(g));
    const Face& t = mesh.faces()[Mesh::face_of(h)];
    const auto a = whole(t[0], d), b = whole(t[1], d), c = whole(t[2], d);
    const auto lift = [](const std::array<Wide, 2>& p) { return p[0] * p[0] + p[1] * p[1]; };
    const auto turn = [](const std::array<Wide, 2>& p, const std::array<Wide, 2>& q) {
      return p[0] * q[1] - p[1] * q[0];
    };
    wrong += lift(a) * turn(b, c) + lift(b) * turn(c, a) + lift(c) * turn(a, b) > 0;
  }
  return wrong;
}

double area(const Shape& s) { return s.mesh().report().area; }

TEST(Delaunay, RandomPointsGiveAnEmptyCircleForEveryFaceAndFillTheHull) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const Index n = 3 + static_cast<Index>(7 * seed);
    const Mesh mesh = shapes::delaunay_disc(n, seed).mesh();
    const MeshReport& r = mesh.report();
    EXPECT_EQ(r.isolated_vertices, 0u);
    EXPECT_EQ(r.faces, 2 * n - 2 - r.boundary_edges);  // Euler: nothing is missing
    EXPECT_EQ(r.euler_characteristic, 1);
    EXPECT_EQ(r.misoriented_edges + r.zero_area_faces, 0u);
    EXPECT_EQ(edges_that_are_not_delaunay(mesh, 0x1p-28), 0u);
  }
}

TEST(Delaunay, PointsOnOneCircleAndRegularGridsAreTriangulatedWithoutGapOrOverlap) {
  std::vector<Vec2> lattice;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) lattice.push_back({x / 16.0, y / 16.0});
  }
  const Shape grid = delaunay(lattice);
  EXPECT_EQ(grid.faces.size(), 2u * 19 * 19);
  EXPECT_DOUBLE_EQ(area(grid), 19.0 * 19 / 256);
  EXPECT_EQ(edges_that_are_not_delaunay(grid.mesh(), 0x1p-28), 0u);
  // 12 points exactly on one circle (x^2 + y^2 = 25), then 60 that are so to rounding only.
  const std::vector<Vec2> exact{{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
  EXPECT_EQ(delaunay(exact).faces.size(), 10u);
  std::vector<Vec2> round;
  for (int i = 0; i < 60; ++i) round.push_back({std::cos(i * kPi / 30), std::sin(i * kPi / 30)});
  const Shape rounded = delaunay(round);
  EXPECT_EQ(rounded.faces.size(), 58u);
  EXPECT_EQ(edges_that_are_not_delaunay(rounded.mesh(), 0x1p-28), 0u);
}

TEST(Delaunay, PositionsMoveByAtMostOneStepOfTheGrid) {
  const std::vector<Vec2> points{{1000.1, -7.3}, {1002.7, -7.1}, {1001.4, -5.9}, {1001.3, -6.6}};
  const Shape s = delaunay(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(s.positions[i].x, points[i].x, 4 * 0x1p-28);
    EXPECT_NEAR(s.positions[i].y, points[i].y, 4 * 0x1p-28);
  }
  EXPECT_EQ(s.faces.size(), 3u);
}

TEST(Delaunay, RepeatedPointsAndPointsOnALineAreNotInFaces) {
  const std::vector<Vec2> repeated{{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}};
  EXPECT_EQ(delaunay(repeated).faces.size(), 1u);
  const std::vector<Vec2> line{{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  EXPECT_TRUE(delaunay(line).faces.empty());
  EXPECT_TRUE(delaunay({}).faces.empty());
  EXPECT_TRUE(delaunay(std::vector<Vec2>{{3, 4}}).faces.empty());
  EXPECT_THROW(delaunay(std::vector<Vec2>{{0, 0}, {1, std::nan("")}}), Error);
}

TEST(Delaunay, ThePapersSquareHas604VerticesOf80OnTheBoundary) {
  const Mesh mesh = shapes::paper_square().mesh();
  const MeshReport& r = mesh.report();
  EXPECT_EQ(r.vertices, 604u);
  EXPECT_EQ(r.boundary_edges, 80u);
  EXPECT_EQ(r.faces, 2 * 604u - 2 - 80);
  EXPECT_NEAR(r.area, 1, 1e-12);
  EXPECT_EQ(edges_that_are_not_delaunay(mesh, 0x1p-28), 0u);
  EXPECT_GT(r.min_edge_length, 0.1 * r.mean_edge_length);
}

}  // namespace
}  // namespace brushfire
