// Nearest surface points against exhaustive search and against the optimality conditions of the definition.
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

// The distance of p from a face by brute force: a fine barycentric grid, refined around its best point.
double sampled_distance(const Mesh& mesh, Index f, Vec3 p) {
  const Face& t = mesh.faces()[f];
  const Vec3 a = mesh.positions()[t[0]], b = mesh.positions()[t[1]], c = mesh.positions()[t[2]];
  double best = kInfinity, u0 = 0.5, v0 = 0.5, reach = 0.5;
  for (int round = 0; round < 40; ++round, reach *= 0.6) {
    double bu = u0, bv = v0;
    for (int i = -4; i <= 4; ++i) {
      for (int j = -4; j <= 4; ++j) {
        const double u = std::min(1.0, std::max(0.0, u0 + reach * i / 4));
        const double v = std::min(1 - u, std::max(0.0, v0 + reach * j / 4));
        const double d = norm(p - (a + u * (b - a) + v * (c - a)));
        if (d < best) {
          best = d;
          bu = u;
          bv = v;
        }
      }
    }
    u0 = bu;
    v0 = bv;
  }
  return best;
}

TEST(NearestPoint, AgreesWithExhaustiveSearchOverAllFaces) {
  Shape s = shapes::folded_sphere(1);
  s.faces.push_back({0, 1, 1});  // an edge only
  s.positions.insert(s.positions.end(), {{2, 0, 0}, {3, 0, 0}, {2.5, 0, 0}});
  const Index n = static_cast<Index>(s.positions.size());
  s.faces.push_back({n - 3, n - 2, n - 1});  // no area
  const Mesh mesh = s.mesh();
  const NearestPointFinder find(mesh);
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const double x = random.uniform(-3, 3), y = random.uniform(-1.5, 1.5);
    const Vec3 p{x, y, random.uniform(-1.5, 1.5)};
    const NearestPoint q = find(p);
    double expected = kInfinity;
    for (Index f = 0; f < mesh.face_count(); ++f) expected = std::min(expected, sampled_distance(mesh, f, p));
    EXPECT_NEAR(q.distance, expected, 1e-7);
    EXPECT_LE(q.distance, expected * (1 + 1e-14)) << "no sample may be nearer";
    EXPECT_NEAR(norm(position(mesh, q.point) - p), q.distance, 1e-14);
  }
}

TEST(NearestPoint, PositionOfAVertexIsTheVertexAndOfAnEdgeTheEdge) {
  for (const double far : {0.0, 1e6}) {
    Shape s = shapes::folded_sphere(2);
    for (Vec3& p : s.positions) p = p + far * Vec3{1, 0.3, -0.7};
    const Mesh mesh = s.mesh();
    const NearestPointFinder find(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const NearestPoint q = find(mesh.positions()[v]);
      const PointLocation at = locate(mesh, q.point);
      EXPECT_EQ(at.on, PointLocation::On::Vertex);
      EXPECT_EQ(at.vertex, v);
      EXPECT_EQ(q.distance, 0);
    }
    for (Index h = 0; h < mesh.halfedge_count(); h += 7) {
      const Vec3 p = 0.7 * mesh.positions()[mesh.from(h)] + 0.3 * mesh.positions()[mesh.to(h)];
      const PointLocation at = locate(mesh, find(p).point);
      ASSERT_EQ(at.on, PointLocation::On::Edge);
      EXPECT_TRUE(at.halfedge == h || at.halfedge == mesh.opposite()[h]);
    }
  }
}

TEST(NearestPoint, PositionInsideAFaceGivesTheFaceAndItsWeights) {
  const Mesh mesh = shapes::torus(12, 9).mesh();
  const NearestPointFinder find(mesh);
  Random random(5);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double a = random.uniform(0.1, 0.4), b = random.uniform(0.1, 0.4);
    const SurfacePoint expected{f, {a, b, 1 - a - b}};
    const NearestPoint q = find(position(mesh, expected));
    EXPECT_EQ(q.point.face, f);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(q.point.weights[k], expected.weights[k], 1e-13);
    EXPECT_LT(q.distance, 1e-15);
  }
}

TEST(NearestPoint, ScalingByPowersOfTwoChangesNothing) {
  const Shape s = shapes::folded_sphere(2);
  const NearestPointFinder find(s.mesh());
  Random random(9);
  for (const double scale : {0x1p-900, 0x1p-100, 0x1p900}) {
    Shape scaled = s;
    for (Vec3& p : scaled.positions) p = scale * p;
    const NearestPointFinder find_scaled(scaled.mesh());
    for (int i = 0; i < 20; ++i) {
      const double x = random.uniform(-2, 2), y = random.uniform(-2, 2);
      const Vec3 p{x, y, random.uniform(-2, 2)};
      const NearestPoint a = find(p), b = find_scaled(scale * p);
      EXPECT_EQ(a.point.face, b.point.face);
      EXPECT_EQ(a.point.weights, b.point.weights);
      EXPECT_EQ(a.distance * scale, b.distance);
    }
  }
}

TEST(NearestPoint, SliverGivesItsNearestPointToRounding) {
  // Altitude 1e-9: the inside is known badly, the distance must not be.
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0.3, 1e-9, 0}};
  const std::vector<Face> faces{{0, 1, 2}};
  const NearestPointFinder find{Mesh(p, faces)};
  EXPECT_NEAR(find({0.5, 0.25, 0.3}).distance, std::hypot(0.25, 0.3), 1e-9);
  EXPECT_NEAR(find({0.5, -0.25, 0.3}).distance, std::hypot(0.25, 0.3), 1e-15);
  EXPECT_NEAR(find({-3, 4, 0}).distance, 5, 1e-15);
}

TEST(NearestPoint, FarPositionsAreFoundAndAbsurdOnesAreErrors) {
  const NearestPointFinder find(shapes::cube(2).mesh());
  EXPECT_DOUBLE_EQ(find({1e50, 0.5, 0.5}).distance, 1e50);
  EXPECT_THROW(find({1e100, 0, 0}), Error);
  EXPECT_THROW(find({std::nan(""), 0, 0}), Error);
  EXPECT_THROW(NearestPointFinder{Mesh()}, Error);
  const std::vector<Face> face{{0, 1, 2}};
  const std::vector<std::array<double, 3>> lengths{{3, 4, 5}};
  EXPECT_THROW(NearestPointFinder{Mesh::from_lengths(3, face, lengths)}, Error);
}

TEST(NearestPoint, AFaceAtTheEndOfTheWorldDoesNotBlurTheOthers) {
  Shape s = shapes::cube(2);
  const Index n = static_cast<Index>(s.positions.size());
  s.positions.insert(s.positions.end(), {{1e100, 0, 0}, {0, 1e100, 0}, {0, 0, 1e100}});
  s.faces.push_back({n, n + 1, n + 2});
  const NearestPointFinder find(s.mesh());
  EXPECT_DOUBLE_EQ(find({0.5, 0.4, 1.75}).distance, 0.75);
}

TEST(NearestPoint, BatchEqualsSingleQueries) {
  const NearestPointFinder find(shapes::icosphere(3).mesh());
  const std::vector<Vec3> positions{{1, 2, 3}, {0, 0, 0.1}, {-1, 0.2, 0.5}};
  const std::vector<NearestPoint> all = find(positions);
  ASSERT_EQ(all.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(all[i].distance, find(positions[i]).distance);
    EXPECT_EQ(all[i].point.face, find(positions[i]).point.face);
  }
}

}  // namespace
}  // namespace brushfire
