// Gradients: exact for linear fields; steepest descent against a search over all directions.
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/gradient.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

TEST(Gradient, OfALinearFieldIsExactInEveryFace) {
  for (const double scale : {1.0, 0x1p-300, 0x1p300}) {
    Shape s = shapes::saddle(5, 0.4);
    for (Vec3& p : s.positions) p = scale * p;
    const Mesh mesh = s.mesh();
    const Vec3 slope{0.3, -2, 0.7};
    std::vector<double> values;
    for (const Vec3& p : mesh.positions()) values.push_back(dot(slope, p));
    const std::vector<Vec3> gradients = face_gradients(mesh, values);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto [a, b, c] = s.faces[f];
      Vec3 n = cross((1 / scale) * (s.positions[b] - s.positions[a]), (1 / scale) * (s.positions[c] - s.positions[a]));
      n = (1 / norm(n)) * n;
      EXPECT_LT(norm(gradients[f] - (slope - dot(slope, n) * n)), 1e-13);
    }
  }
}

TEST(Gradient, AtVerticesIsTheMeanOfTheFacesAroundByTheirArea) {
  const std::vector<Vec3> p{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 3}, {0, 4, 1}};
  const std::vector<double> values{0, 2, 0, 3, kInfinity};
  const std::vector<Vec3> g = vertex_gradients(Mesh(p, faces), values);
  EXPECT_NEAR(norm(g[1] - Vec3{1, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(norm(g[3] - Vec3{-3, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(norm(g[0] - Vec3{(2 * 1.0 - 3) / 3, 0, 0}), 0, 1e-15);  // areas 1 and 0.5
  EXPECT_EQ(g[4], Vec3{});
}

TEST(Gradient, FacesWithoutAreaOrWithUnreachedVerticesHaveNone) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 0, 1}, {0, 1, 3}, {1, 4, 3}};
  const std::vector<double> values{0, 1, 2, 1, kInfinity};
  const Mesh mesh(p, faces);
  const std::vector<Vec3> g = face_gradients(mesh, values);
  EXPECT_EQ(g[0], Vec3{});
  EXPECT_EQ(g[1], Vec3{});
  EXPECT_EQ(g[3], Vec3{});
  EXPECT_EQ(g[2], (Vec3{1, 1, 0}));
  EXPECT_EQ(steepest_descent(mesh, values, {3, {0.2, 0.5, 0.3}}).face, kNoIndex);
}

// The lowest slope over many directions in all faces around the point.
double searched_slope(const Mesh& mesh, std::span<const double> values, const PointLocation& at) {
  double lowest = 0;
  for (const Index f : faces_at(mesh, at)) {
    const std::array<double, 3> w = *weights_in(mesh, at, f);
    const std::array<Vec2, 3> c = flat_corners(mesh, f);
    const Vec2 e1 = c[1] - c[0], e2 = c[2] - c[0];
    for (int i = 0; i < 3600; ++i) {
      const Vec2 u{std::cos(2 * kPi * i / 3600), std::sin(2 * kPi * i / 3600)};
      const double r1 = cross(u, e2) / cross(e1, e2), r2 = cross(e1, u) / cross(e1, e2);
      const std::array<double, 3> r{-r1 - r2, r1, r2};
      bool inside = true;
      double slope = 0;
      for (int k = 0; k < 3; ++k) {
        inside = inside && (w[k] > 0 || r[k] >= 0);
        slope += r[k] * values[mesh.faces()[f][k]];
      }
      if (inside) lowest = std::min(lowest, slope / mesh.unit());
    }
  }
  return lowest;
}

TEST(Gradient, SteepestDescentBeatsEveryDirectionAroundThePoint) {
  Shape s = shapes::folded_sphere(2);
  s.faces.push_back({0, 1, 2});  // and a face across, for edges of three faces
  const Mesh mesh = s.mesh();
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<double> values;
    for (Index v = 0; v < mesh.vertex_count(); ++v) values.push_back(random.uniform());
    SurfacePoint p{static_cast<Index>(random.below(mesh.face_count())), {1, 0, 0}};
    if (seed % 3 == 1) p.weights = {0.25, 0, 0.75};
    if (seed % 3 == 2) p.weights = {0.25, 0.5, 0.25};
    const SurfaceDirection d = steepest_descent(mesh, values, p);
    const double searched = searched_slope(mesh, values, locate(mesh, p));
    EXPECT_LE(d.slope, searched * (1 - 1e-12));
    EXPECT_GE(d.slope, searched - 1e-3 * std::abs(searched) - (d.face == kNoIndex ? 0 : 30 * kPi / 3600));
    if (d.face == kNoIndex) continue;
    EXPECT_NEAR(norm(in_space(mesh, d)), 1, 1e-12);
    double slope = 0;
    for (int k = 0; k < 3; ++k) slope += d.weight_rates[k] * values[mesh.faces()[d.face][k]];
    EXPECT_NEAR(slope, d.slope, 1e-10 * std::abs(slope));
  }
}

TEST(Gradient, PointsToTheSourceOnAPlaneAndNowhereAtIt) {
  const Mesh mesh = shapes::plane(20, 20).mesh();
  std::vector<double> values;
  for (const Vec3& p : mesh.positions()) values.push_back(norm(p));
  const SurfacePoint point{500, {0.3, 0.3, 0.4}};
  const Vec3 direction = in_space(mesh, steepest_descent(mesh, values, point));
  const Vec3 p = position(mesh, point);
  EXPECT_NEAR(dot(direction, (-1 / norm(p)) * p), 1, 1e-3);
  EXPECT_EQ(steepest_descent(mesh, values, vertex_point(mesh, 0)).face, kNoIndex);
  EXPECT_THROW(in_space(mesh, {}), Error);
  EXPECT_THROW(face_gradients(mesh, std::vector<double>{1, 2}), Error);
}

}  // namespace
}  // namespace brushfire
