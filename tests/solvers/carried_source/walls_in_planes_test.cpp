// Fronts of several sources, and shadows of walls, on planes: where one source a vertex has to be enough.
#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire {
namespace {

std::vector<double> distances(DistanceSolver& solver, std::span<const Source> sources, Method method) {
  DistanceOptions options;
  options.method = method;
  return solver.distance(sources, options).distance;
}

std::vector<double> from_vertex(const Domain& domain, Index source, Method method = Method::CarriedSource) {
  DistanceSolver solver(domain);
  const Source from{vertex_point(domain.mesh(), source)};
  return distances(solver, {&from, 1}, method);
}

struct Errors {
  double sum = 0, largest = 0;
  std::size_t count = 0, over_5_percent = 0;

  void add(double value, double truth) {
    if (!(truth > 0) || !std::isfinite(truth)) return;
    const double error = std::abs(value / truth - 1);
    sum += error, largest = std::max(largest, error), ++count;
    over_5_percent += error > 0.05 ? 1 : 0;
  }
  double mean() const { return sum / static_cast<double>(count); }
};

// Fronts of different sources meet over edges: what lies beyond is reached through the edge all the same.
TEST(CarriedSource, SeveralSourcesOnPlanesAreTheNearestOfThem) {
  Errors errors;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec2> points;
    for (int i = 0; i < 200; ++i) points.push_back({unit(random), unit(random)});
    const Mesh mesh = delaunay(points).mesh();
    std::vector<Source> sources;
    for (int i = 0; i < 4; ++i) sources.push_back({vertex_point(mesh, static_cast<Index>(random() % 200))});
    DistanceSolver solver(mesh);
    const std::vector<double> d = distances(solver, sources, Method::CarriedSource);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      double truth = kInfinity;
      for (const Source& s : sources) truth = std::min(truth, norm(mesh.positions()[v] - position(mesh, s.point)));
      errors.add(d[v], truth);
    }
  }
  EXPECT_GT(errors.count, 11'000u);
  EXPECT_LT(errors.mean(), 1e-5);
  EXPECT_LT(errors.largest, 0.01);
}

// The source is a bend of two walls, and a source on each side of them: on both of them at once.
TEST(CarriedSource, ASourceOnAWallLightsItsCornersStraight) {
  const Mesh mesh = shapes::plane(9, 12).mesh();
  const Barriers walls{.edges = {{84, 74}, {74, 73}}};
  const std::vector<double> d = from_vertex({mesh, walls}, 74);
  EXPECT_NEAR(d[83], norm(mesh.positions()[83] - mesh.positions()[74]), 1e-6);
}

// From 37 along a closed face to its corner 36, and around that to 45: the vertex behind the corner is lit by the
// source on one side, by the corner on the other.
TEST(CarriedSource, LightThatPassesACornerBendsAroundIt) {
  const Mesh mesh = shapes::plane(9, 12).mesh();
  const Barriers walls{.faces = {67}};
  const auto at = [&](Index v) { return mesh.positions()[v]; };
  const std::vector<double> d = from_vertex({mesh, walls}, 37);
  EXPECT_NEAR(d[35], norm(at(35) - at(37)), 1e-6);
  EXPECT_NEAR(d[45], norm(at(36) - at(37)) + norm(at(45) - at(36)), 1e-6);
}

// Jittered grids with faces taken out, or chains of edges blocked, from every vertex.
TEST(CarriedSource, RandomWallsInPlanesLeaveFewVerticesWrong) {
  Errors errors;
  for (unsigned seed = 0; seed < 16; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> jitter(-0.02, 0.02);
    Shape shape = shapes::plane(9, 12);
    for (Vec3& p : shape.positions) {
      if (seed % 2 == 0) p = p + Vec3{jitter(random), jitter(random), 0};
    }
    const Mesh mesh = shape.mesh();
    Barriers walls;
    Index h = static_cast<Index>(random() % mesh.halfedge_count());
    for (int i = 0; i < 12; ++i) {
      if (seed % 4 < 2) {
        walls.faces.push_back(static_cast<Index>(random() % mesh.face_count()));
      } else {
        walls.edges.push_back({mesh.from(h), mesh.to(h)});
        const auto around = mesh.corners(mesh.to(h));
        h = around[random() % around.size()];
      }
    }
    const Domain domain(mesh, walls);
    DistanceSolver solver(domain);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (!domain.is_open(v)) continue;
      const Source from{vertex_point(mesh, v)};
      const std::vector<double> truth = distances(solver, {&from, 1}, Method::Exact);
      const std::vector<double> own = distances(solver, {&from, 1}, Method::CarriedSource);
      for (Index u = 0; u < mesh.vertex_count(); ++u) {
        ASSERT_EQ(std::isfinite(own[u]), std::isfinite(truth[u])) << seed << ": " << v << " to " << u;
        errors.add(own[u], truth[u]);
      }
    }
  }
  EXPECT_LT(errors.mean(), 5e-4);
  EXPECT_LT(errors.over_5_percent, errors.count / 2500);
  EXPECT_LT(errors.largest, 0.25);
}

}  // namespace
}  // namespace brushfire
