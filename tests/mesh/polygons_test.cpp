// Ear clipping: area kept, orientation kept, no overlap, and an end on any input.
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/polygons.h>
#include <brushfire/mesh/report.h>

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numeric>

namespace brushfire {
namespace {

Triangulation triangulate(std::span<const Vec3> outline) {
  std::vector<Index> corners(outline.size());
  std::iota(corners.begin(), corners.end(), Index{0});
  const std::vector<Index> offset{0, static_cast<Index>(outline.size())};
  return triangulate_polygons(outline, offset, corners);
}

double outline_area(std::span<const Vec3> outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) twice += cross(outline[i], outline[(i + 1) % outline.size()]).z;
  return 0.5 * twice;
}

// n - 2 faces, all of positive area, together that of the outline: nothing overlaps, nothing is missing.
void expect_exact_cover(std::span<const Vec3> outline, double smallest = 0) {
  const Triangulation t = triangulate(outline);
  ASSERT_EQ(t.faces.size(), outline.size() - 2);
  double sum = 0;
  for (const Face& f : t.faces) {
    const double area = 0.5 * cross(outline[f[1]] - outline[f[0]], outline[f[2]] - outline[f[0]]).z;
    EXPECT_GT(area, smallest);
    sum += area;
  }
  EXPECT_NEAR(sum, outline_area(outline), 1e-12 * sum);
}

// A star-shaped outline with n random radii.
std::vector<Vec3> star(Index n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> outline;
  for (Index i = 0; i < n; ++i) {
    const double r = random.uniform(0.2, 1), angle = 2 * kPi * i / n;
    outline.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  return outline;
}

// A comb of thin teeth: half of the corners turn right.
std::vector<Vec3> comb(Index teeth) {
  std::vector<Vec3> outline{{static_cast<double>(teeth), -1, 0}};
  for (Index i = teeth; i > 0; --i) {
    outline.push_back({i - 0.0, 0, 0});
    outline.push_back({i - 0.5, 10, 0});
  }
  outline.push_back({0, 0, 0});
  outline.push_back({0, -1, 0});
  return outline;
}

TEST(Polygons, TrianglesPassUnchangedAndSmallerPolygonsGiveNothing) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Index> offset{0, 3, 5, 8, 8}, corners{2, 0, 1, 0, 1, 1, 1, 0};
  const Triangulation t = triangulate_polygons(p, offset, corners);
  EXPECT_EQ(t.faces, (std::vector<Face>{{2, 0, 1}, {1, 1, 0}}));
  EXPECT_EQ(t.origin, (std::vector<Index>{0, 2}));
}

TEST(Polygons, QuadrilateralIsCutAlongItsShorterValidDiagonal) {
  const std::vector<Vec3> kite{{0, 0, 0}, {1, -0.2, 0}, {2, 0, 0}, {1, 0.2, 0}};
  EXPECT_EQ(triangulate(kite).faces, (std::vector<Face>{{1, 2, 3}, {1, 3, 0}}));
  const std::vector<Vec3> arrow{{0, 0, 0}, {2, 1, 0}, {0.5, 0, 0}, {2, -1, 0}};  // reflex at corner 2, clockwise
  EXPECT_EQ(triangulate(arrow).faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
  // In space: bent along the longer diagonal, still the shorter one.
  const std::vector<Vec3> bent{{0, 0, 1}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}};
  EXPECT_EQ(triangulate(bent).faces.size(), 2u);
}

TEST(Polygons, ConcaveOutlinesAreCoveredExactly) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    expect_exact_cover(star(5 + static_cast<Index>(seed % 60), seed));
  }
  expect_exact_cover(comb(50));
}

TEST(Polygons, CornersOnALineGiveNoFlatFaceWhereItCanBeAvoided) {
  std::vector<Vec3> square;
  for (int i = 0; i < 4; ++i) square.push_back({i / 4.0, 0, 0});
  for (int i = 0; i < 4; ++i) square.push_back({1, i / 4.0, 0});
  for (int i = 0; i < 4; ++i) square.push_back({1 - i / 4.0, 1, 0});
  for (int i = 0; i < 4; ++i) square.push_back({0, 1 - i / 4.0, 0});
  expect_exact_cover(square);
}

TEST(Polygons, OrientationAndAreaAreKeptInEveryPlane) {
  const std::vector<Vec3> flat = star(23, 5);
  const double area = outline_area(flat);
  for (const int axis : {0, 1, 2}) {
    for (const double sign : {1.0, -1.0}) {
      std::vector<Vec3> turned;
      for (const Vec3& p : flat) {
        const Vec3 q{p.x, sign * p.y, 0.25 * p.x};
        turned.push_back(axis == 0 ? Vec3{q.x, q.y, q.z} : axis == 1 ? Vec3{q.z, q.x, q.y} : Vec3{q.y, q.z, q.x});
      }
      Vec3 expected, sum;
      for (std::size_t i = 0; i < turned.size(); ++i) {
        expected = expected + 0.5 * cross(turned[i], turned[(i + 1) % turned.size()]);
      }
      for (const Face& f : triangulate(turned).faces) {
        const Vec3 n = 0.5 * cross(turned[f[1]] - turned[f[0]], turned[f[2]] - turned[f[0]]);
        EXPECT_GT(dot(n, expected), 0);
        sum = sum + n;
      }
      EXPECT_NEAR(norm(sum - expected), 0, 1e-12 * area);
    }
  }
}

TEST(Polygons, AHoleJoinedByABridgeIsCut) {
  // A square with a square hole, as one outline that walks the bridge twice.
  const std::vector<Vec3> p{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
  const std::vector<Index> corners{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}, offset{0, 10};
  const Triangulation t = triangulate_polygons(p, offset, corners);
  ASSERT_EQ(t.faces.size(), 8u);
  double sum = 0;
  for (const Face& f : t.faces) {
    const double area = 0.5 * cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]).z;
    EXPECT_GE(area, 0);
    sum += area;
  }
  EXPECT_DOUBLE_EQ(sum, 8);
}

TEST(Polygons, OutlinesThatCrossThemselvesOrHaveNoAreaStillEnd) {
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    const Index n = 4 + static_cast<Index>(random.below(40));
    std::vector<Vec3> outline;
    for (Index i = 0; i < n; ++i) {
      // Few distinct coordinates: repeated, collinear and crossing corners in one.
      const auto coordinate = [&] { return static_cast<double>(random.below(round % 3 == 0 ? 2 : 4)); };
      const double x = coordinate(), y = coordinate();
      outline.push_back({x, y, round % 2 == 0 ? 0 : coordinate()});
    }
    EXPECT_EQ(triangulate(outline).faces.size(), n - 2);
  }
  const std::vector<Vec3> point(9, Vec3{1, 2, 3});
  EXPECT_EQ(triangulate(point).faces.size(), 7u);
}

TEST(Polygons, ExtremeScalesAreCutAsOrdinaryOnes) {
  const std::vector<Vec3> ordinary = star(17, 3);
  const std::vector<Face> expected = triangulate(ordinary).faces;
  for (const double scale : {0x1p-1000, 0x1p-300, 0x1p300, 0x1p1023}) {
    std::vector<Vec3> scaled = ordinary;
    for (Vec3& p : scaled) p = scale * p;
    EXPECT_EQ(triangulate(scaled).faces, expected);
  }
}

TEST(Polygons, LargeOutlinesTakeNoQuadraticTime) {
  const auto seconds_for = [](std::span<const Vec3> outline) {
    const std::clock_t started = std::clock();
    EXPECT_EQ(triangulate(outline).faces.size(), outline.size() - 2);
    return static_cast<double>(std::clock() - started) / CLOCKS_PER_SEC;
  };
  // Four times the corners: four times the work, or sixteen times where it is quadratic.
  EXPECT_LT(seconds_for(comb(40000)), 10 * seconds_for(comb(10000)));
  EXPECT_LT(seconds_for(std::vector<Vec3>(40000, Vec3{1, 1, 1})), 2);
}

TEST(Polygons, BadOffsetsAndCornersAreErrorsThatNameThePolygon) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Index> corners{0, 1, 2, 0, 1, 3};
  try {
    triangulate_polygons(p, std::vector<Index>{0, 3, 6}, corners);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidMesh);
    EXPECT_STREQ(e.what(), "polygon 1 names vertex 3, but there are 3 vertices");
  }
  EXPECT_THROW(triangulate_polygons(p, std::vector<Index>{0, 3}, corners), Error);
  EXPECT_THROW(triangulate_polygons(p, std::vector<Index>{0, 5, 3, 6}, corners), Error);
  EXPECT_THROW(triangulate_polygons(p, {}, {}), Error);
}

}  // namespace
}  // namespace brushfire
