// Vectors, values and logarithmic maps carried by heat, beside what is known of the plane, the sphere and the flat
// torus.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/heat/connection.h>
#include <brushfire/solvers/vector_heat.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire {
namespace {

using Complex = std::complex<double>;

class VectorHeat : public testing::Test {
 protected:
  void SetUp() override {
    if (!heat::can_factor()) GTEST_SKIP() << "this build has no Eigen";
  }
};

Vec3 in_space(const VectorHeatSolver::Frames& f, Index v, Complex z) { return z.real() * f.x[v] + z.imag() * f.y[v]; }
Complex in_frame(const VectorHeatSolver::Frames& f, Index v, const Vec3& a) { return {dot(a, f.x[v]), dot(a, f.y[v])}; }

// Along the great circle from the unit vector a to b.
Vec3 carried_on_sphere(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 n = cross(a, b);
  const double s = norm(n), c = dot(a, b);
  if (s == 0) return x;
  const Vec3 axis = (1 / s) * n;
  return c * x + s * cross(axis, x) + (1 - c) * dot(axis, x) * axis;
}

// A grid that closes up in both directions, of lengths alone.
Mesh flat_torus(Index n) {
  std::vector<Face> faces;
  std::vector<std::array<double, 3>> lengths;
  const double root = std::sqrt(2.0);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const auto at = [&](Index i, Index j) { return ((y + j) % n) * n + (x + i) % n; };
      faces.push_back({at(0, 0), at(1, 0), at(1, 1)});
      lengths.push_back({1, 1, root});
      faces.push_back({at(0, 0), at(1, 1), at(0, 1)});
      lengths.push_back({root, 1, 1});
    }
  }
  return Mesh::from_lengths(n * n, faces, lengths);
}

TEST_F(VectorHeat, OnAFlatTorusVectorsAreCarriedExactly) {
  const Index n = 9;
  const Mesh mesh = flat_torus(n);
  heat::VectorSystem system(mesh, true, 1, 0);
  // The directions of "right" at every vertex.
  std::vector<Complex> right(mesh.vertex_count());
  heat::Triangulation t = heat::triangulation_of(mesh, heat::Cover::Single);
  const heat::TangentSpaces spaces = heat::lay_out_tangents(t);
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index a = mesh.from(h), b = mesh.to(h);
    if (b == a / n * n + (a + 1) % n && b % n == (a % n + 1) % n) right[a] = heat::direction(t, spaces, h);
  }
  VectorHeatSolver solver(mesh);
  const Index from = 4 * n + 4;
  const std::vector<Complex> start{2.0 * right[from] * Complex(0, 1)};
  const std::vector<Complex> all = solver.transport({&from, 1}, start);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(std::abs(all[v] / right[v] - Complex(0, 2)), 0, 1e-9) << v;
  }
}

TEST_F(VectorHeat, OnASphereVectorsAreCarriedAlongGreatCircles) {
  const Mesh mesh = shapes::icosphere(4).mesh();
  for (const bool delaunay : {true, false}) {
    VectorHeatSolver solver(mesh, {.delaunay = delaunay});
    const VectorHeatSolver::Frames frames = solver.tangent_frames();
    const Index from = 12;
    const Complex z(3, 4);
    const std::vector<Complex> all = solver.transport({&from, 1}, {&z, 1});
    const Vec3 start = in_space(frames, from, z);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_NEAR(std::abs(all[v]), 5, 1e-9);
      const Vec3 a = mesh.positions()[from], b = mesh.positions()[v];
      if (dot(a, b) < -0.5) continue;  // near the cut locus it blends
      EXPECT_NEAR(norm(in_space(frames, v, all[v]) - carried_on_sphere(a, b, start)), 0, 0.25) << v;
    }
  }
}

TEST_F(VectorHeat, FramesAreRightHandedAndUnitVectors) {
  for (const Mesh& mesh : {shapes::icosphere(2).mesh(), shapes::saddle(6).mesh()}) {
    const VectorHeatSolver::Frames f = VectorHeatSolver(mesh).tangent_frames();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_NEAR(norm(f.x[v]), 1, 1e-12);
      EXPECT_NEAR(norm(f.normal[v]), 1, 1e-12);
      EXPECT_NEAR(norm(cross(f.x[v], f.y[v]) - f.normal[v]), 0, 1e-12);
    }
  }
}

TEST_F(VectorHeat, ValuesAreThoseOfTheNearestVertex) {
  Shape shape = shapes::plane(20, 10, 20, 10);
  const Index n = static_cast<Index>(shape.positions.size());
  for (const Vec3 p : {Vec3{90, 0, 0}, Vec3{91, 0, 0}, Vec3{90, 1, 0}}) shape.positions.push_back(p);
  shape.faces.push_back({n, n + 1, n + 2});
  const Mesh mesh = shape.mesh();
  VectorHeatSolver solver(mesh);
  const std::vector<Index> vertices{5 * 21, 5 * 21 + 20};
  const std::vector<double> values{-7, 30};
  const std::vector<double> all = solver.extend(vertices, values);
  for (Index v = 0; v < n; ++v) {
    const double x = mesh.positions()[v].x;
    EXPECT_GE(all[v], -7);
    EXPECT_LE(all[v], 30);
    if (x > 6 && x < 14) continue;
    EXPECT_NEAR(all[v], x < 10 ? -7 : 30, 0.1);
  }
  EXPECT_TRUE(std::isnan(all[n]));
}

TEST_F(VectorHeat, LogarithmicMapsOfTheSphereAreGreatCircles) {
  const Mesh mesh = shapes::icosphere(4).mesh();
  VectorHeatSolver solver(mesh);
  const VectorHeatSolver::Frames frames = solver.tangent_frames();
  const Index from = 30;
  const Vec3 a = mesh.positions()[from];
  for (const auto& [strategy, most] :
       {std::pair{LogMapStrategy::AffineAdaptive, 0.06}, std::pair{LogMapStrategy::AffineLocal, 0.12},
        std::pair{LogMapStrategy::VectorHeat, 0.12}}) {
    const std::vector<Complex> log = solver.log_map(from, strategy);
    EXPECT_EQ(log[from], Complex());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 b = mesh.positions()[v];
      const double distance = std::atan2(norm(cross(a, b)), dot(a, b));
      if (v == from || distance > 1.5) continue;
      const Vec3 away = b - dot(a, b) * a;
      const Complex expected = in_frame(frames, from, (distance / norm(away)) * away);
      EXPECT_NEAR(std::abs(log[v] - expected), 0, most) << v << " " << static_cast<int>(strategy);
    }
  }
}

// A flat strip 2000 edges long: heat at its far end is e^-2000.
TEST_F(VectorHeat, WhatIsCarriedGoesFartherThanNumbersReach) {
  const Index length = 2000, row = length + 1, from = row + 3;
  const Mesh mesh = shapes::plane(length, 2, length, 2).mesh();
  VectorHeatSolver solver(mesh);
  const VectorHeatSolver::Frames frames = solver.tangent_frames();
  const std::vector<Index> ends{from, 2 * row - 4};
  const std::vector<double> all = solver.extend(ends, std::vector<double>{-7, 30});
  const Vec3 up{0, 3, 0}, down{0, -5, 0};
  const std::vector<Complex> both{in_frame(frames, ends[0], up), in_frame(frames, ends[1], down)};
  const std::vector<Complex> vectors = solver.transport(ends, both);
  std::vector<std::vector<Complex>> logs;
  for (const LogMapStrategy strategy :
       {LogMapStrategy::VectorHeat, LogMapStrategy::AffineLocal, LogMapStrategy::AffineAdaptive}) {
    logs.push_back(solver.log_map(from, strategy));
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.positions()[v], away = p - mesh.positions()[from];
    const bool is_near_end = p.x < 4 || p.x > length - 4;  // where angles are stretched
    ASSERT_TRUE(std::isfinite(all[v]) && std::isfinite(std::abs(vectors[v]))) << p.x;
    if (std::abs(p.x - 1000) > 20) {
      EXPECT_NEAR(all[v], p.x < 1000 ? -7 : 30, 1e-6) << p.x;
      const double off = norm(in_space(frames, v, vectors[v]) - (p.x < 1000 ? up : down));
      EXPECT_LT(off, is_near_end ? 10 : 0.01) << p.x;
    }
    for (std::size_t k = 0; k < logs.size(); ++k) {
      const Vec3 is = in_space(frames, from, logs[k][v]);
      ASSERT_LT(norm(is - away), 1.5 + (is_near_end ? 1 : 0.03) * std::abs(away.x)) << p.x << " " << k;
    }
  }
}

// Border edges opposite of obtuse angles have negative weights, which flips cannot mend: heat would be negative, and
// the equation of vectors indefinite.
TEST_F(VectorHeat, BordersOfObtuseTrianglesAreLikeOthers) {
  Shape shape = shapes::noise_terrain(10, 10, 2);
  for (Vec3& p : shape.positions) p = {p.x + 6 * p.y, p.y, p.z};
  const Mesh mesh = shape.mesh();
  VectorHeatSolver solver(mesh);
  const Index from = 60;
  const Complex z(3, 4);
  for (const double value : solver.extend({&from, 1}, std::vector<double>{7})) EXPECT_EQ(value, 7);
  for (const Complex& all : solver.transport({&from, 1}, {&z, 1})) EXPECT_NEAR(std::abs(all), 5, 1e-9);
  for (const LogMapStrategy strategy :
       {LogMapStrategy::VectorHeat, LogMapStrategy::AffineLocal, LogMapStrategy::AffineAdaptive}) {
    for (const Complex& at : solver.log_map(from, strategy)) EXPECT_LT(std::abs(at), 200);
  }
}

TEST_F(VectorHeat, VectorsThatCancelLeaveNone) {
  const Mesh mesh = flat_torus(8);
  VectorHeatSolver solver(mesh);
  const Index from = 3;
  const std::vector<Complex> all =
      solver.transport(std::vector<Index>{from, from}, std::vector<Complex>{{0, 2}, {0, -2}});
  for (const Complex z : all) EXPECT_EQ(z, Complex());
}

TEST_F(VectorHeat, ValuesOfAnySizeAreExtended) {
  const Mesh mesh = shapes::icosphere(2).mesh();
  VectorHeatSolver solver(mesh);
  const std::vector<Index> vertices{3, 30};
  for (const auto& [low, high] : {std::pair{-1.7e308, 1.7e308}, std::pair{0.0, 5e-324}, std::pair{3.0, 3.0}}) {
    const std::vector<double> all = solver.extend(vertices, std::vector<double>{low, high});
    for (const double value : all) EXPECT_TRUE(value >= low && value <= high) << value;
  }
}

TEST_F(VectorHeat, TheConnectionLaplacianIsHermitianAndPositive) {
  const Mesh mesh = shapes::torus(20, 9).mesh();
  const VectorHeatSolver::SparseComplex l = VectorHeatSolver(mesh).connection_laplacian();
  std::mt19937 random(1);
  std::normal_distribution<double> number;
  for (int run = 0; run < 20; ++run) {
    std::vector<Complex> x(mesh.vertex_count()), y(mesh.vertex_count());
    for (Complex& z : x) z = {number(random), number(random)};
    for (std::size_t e = 0; e < l.value.size(); ++e) y[l.row[e]] += l.value[e] * x[l.column[e]];
    Complex energy;
    for (std::size_t v = 0; v < x.size(); ++v) energy += std::conj(x[v]) * y[v];
    EXPECT_NEAR(energy.imag(), 0, 1e-9);
    EXPECT_GT(energy.real(), 0);
  }
}

TEST_F(VectorHeat, OtherSurfacesAndBadArgumentsAreErrors) {
  EXPECT_THROW(VectorHeatSolver(shapes::book(3, 2, 2).mesh()), Error);
  const Mesh mesh = shapes::icosphere(1).mesh();
  VectorHeatSolver solver(mesh);
  const Index vertex = 3, none = 99;
  const double value = 1, bad = std::nan("");
  EXPECT_THROW(solver.extend({&vertex, 1}, {}), Error);
  EXPECT_THROW(solver.extend({}, {}), Error);
  EXPECT_THROW(solver.extend({&none, 1}, {&value, 1}), Error);
  EXPECT_THROW(solver.extend({&vertex, 1}, {&bad, 1}), Error);
  EXPECT_THROW(solver.log_map(none), Error);
  EXPECT_THROW(VectorHeatSolver(mesh, {.time_factor = -1}), Error);
}

}  // namespace
}  // namespace brushfire
