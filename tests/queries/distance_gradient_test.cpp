// Derivatives of distances: against central differences, laws, and the cut locus.
#include <brushfire/queries/distance_gradient.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "moved_meshes.h"

namespace brushfire {
namespace {

using test::traced, test::jittered;

double weighted_sum(const Mesh& mesh, std::span<const Vec3> positions, std::span<const Source> sources,
                    std::span<const double> weights) {
  const DistanceField field = traced(Mesh(positions, mesh.faces()), sources);
  double sum = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (field.distance[v] < kInfinity) sum += weights[v] * field.distance[v];
  }
  return sum;
}

std::vector<double> random_weights(Index count, unsigned seed) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> weights(count);
  for (double& w : weights) w = any(dice);
  return weights;
}

// The rate along a random direction of all vertices at once.
void expect_like_central_difference(const Mesh& mesh, std::span<const Source> sources, unsigned seed) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> weights = random_weights(mesh.vertex_count(), seed);
  const DistanceField field = traced(mesh, sources);
  const std::vector<std::uint8_t> tied = one_sided_vertices(mesh, field, 1e-5);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (tied[v] != 0) weights[v] = 0;
  }
  const DistanceGradient gradient = distance_gradient_wrt_vertices(mesh, sources, field, weights);
  constexpr double kStep = 1e-6;
  std::vector<Vec3> ahead(mesh.positions().begin(), mesh.positions().end()), behind = ahead;
  double rate = 0, size = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 d{any(dice), any(dice), any(dice)};
    ahead[v] = ahead[v] + kStep * d;
    behind[v] = behind[v] - kStep * d;
    rate += dot(gradient.vertices[v], d);
    size += std::abs(dot(gradient.vertices[v], d));
  }
  const double measured =
      (weighted_sum(mesh, ahead, sources, weights) - weighted_sum(mesh, behind, sources, weights)) / (2 * kStep);
  EXPECT_NEAR(rate, measured, 1e-6 * size) << "seed " << seed;
}

TEST(DistanceGradient, IsTheCentralDifferenceOnTwentyMeshes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::array<Mesh, 4> smooth{shapes::icosphere(3).mesh(), shapes::torus(24, 12).mesh(),
                                     shapes::plane(9, 8).mesh(), shapes::cylinder(5, 17, 1, 2).mesh()};
    const Mesh mesh = jittered(smooth[seed % 4], seed < 12 ? 0.02 : 0.06, seed);
    const std::vector<Source> sources{{vertex_point(mesh, seed % mesh.vertex_count())},
                                      {SurfacePoint{7 * seed % mesh.face_count(), {0.2, 0.5, 0.3}}, 0.1}};
    expect_like_central_difference(mesh, std::span(sources).first(seed % 2 + 1), seed);
  }
}

TEST(DistanceGradient, OfAPlaneIsTheDirectionOfTheStraightLine) {
  const Mesh mesh = shapes::plane(6, 5, 6, 5).mesh();
  const Index from = 8, to = 33;
  const std::vector<Source> sources{{vertex_point(mesh, from)}};
  std::vector<double> weights(mesh.vertex_count(), 0);
  weights[to] = 2;
  const DistanceGradient g = distance_gradient_wrt_vertices(mesh, sources, traced(mesh, sources), weights);
  const Vec3 line = mesh.positions()[to] - mesh.positions()[from];
  const Vec3 force = (2 / norm(line)) * line;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 expected = v == to ? force : v == from ? -1 * force : Vec3{};
    EXPECT_LT(norm(g.vertices[v] - expected), 1e-12) << v;
  }
  EXPECT_EQ(g.offsets, std::vector<double>{2});
}

TEST(DistanceGradient, LosesNothingWhenTheWholeMeshMovesOrTurns) {
  const Mesh mesh = jittered(shapes::folded_sphere(4).mesh(), 0.005, 1);
  const std::vector<Source> sources{{vertex_point(mesh, 5)}, {SurfacePoint{100, {0.5, 0.25, 0.25}}}};
  const std::vector<double> weights = random_weights(mesh.vertex_count(), 1);
  const DistanceGradient g = distance_gradient_wrt_vertices(mesh, sources, traced(mesh, sources), weights);
  Vec3 force, torque;
  double growth = 0, sum = 0;
  const DistanceField field = traced(mesh, sources);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    force = force + g.vertices[v];
    torque = torque + cross(mesh.positions()[v], g.vertices[v]);
    growth += dot(mesh.positions()[v], g.vertices[v]);  // all twice as large: all distances, too
    sum += weights[v] * field.distance[v];
  }
  EXPECT_LT(norm(force), 1e-9);
  EXPECT_LT(norm(torque), 1e-9);
  EXPECT_NEAR(growth, sum, 1e-9);
}

// Through vertices of a cube's grid go many paths, whose legs end there and not where the run says.
TEST(DistanceGradient, IsThatOfSinglePathsWhereLegsPassThroughVertices) {
  const Mesh mesh = shapes::cube(4).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 1)}};
  const DistanceField field = traced(mesh, sources);
  const std::vector<double> weights = random_weights(mesh.vertex_count(), 2);
  const DistanceGradient all = distance_gradient_wrt_vertices(mesh, sources, field, weights);
  std::vector<Vec3> sum(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::vector<double> one(mesh.vertex_count(), 0);
    one[v] = weights[v];
    const DistanceGradient g = distance_gradient_wrt_vertices(mesh, sources, field, one);
    double growth = 0;
    for (Index w = 0; w < mesh.vertex_count(); ++w) {
      growth += dot(mesh.positions()[w], g.vertices[w]);
      sum[w] = sum[w] + g.vertices[w];
    }
    EXPECT_NEAR(growth, weights[v] * field.distance[v], 1e-12) << v;
  }
  for (Index w = 0; w < mesh.vertex_count(); ++w) EXPECT_LT(norm(sum[w] - all.vertices[w]), 1e-12) << w;
}

// Rays are followed fast over faces that are oriented alike, point by point over others.
TEST(DistanceGradient, DoesNotDependOnHowFacesAreOriented) {
  const Mesh mesh = jittered(shapes::icosphere(3).mesh(), 0.02, 4);
  std::vector<Face> turned(mesh.faces().begin(), mesh.faces().end());
  std::mt19937 dice(4);
  for (Face& f : turned) {
    if (dice() % 8 == 0) std::swap(f[1], f[2]);
  }
  const Mesh other(mesh.positions(), turned);
  const Face corner = turned[30];
  const std::vector<double> weights = random_weights(mesh.vertex_count(), 4);
  std::array<DistanceGradient, 2> found;
  for (const Mesh* m : {&mesh, &other}) {
    SurfacePoint inside{30, {}};
    const std::array<double, 3> share{0.2, 0.5, 0.3};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (m->faces()[30][k] == corner[i]) inside.weights[k] = share[i];
      }
    }
    const std::vector<Source> sources{{inside}, {vertex_point(*m, 9), 0.1}};
    found[m == &mesh ? 0 : 1] = distance_gradient_wrt_vertices(*m, sources, traced(*m, sources), weights);
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_LT(norm(found[0].vertices[v] - found[1].vertices[v]), 1e-9) << v;
  }
  EXPECT_LT(norm(found[0].places[0] - found[1].places[0]), 1e-9);
  EXPECT_NEAR(found[0].offsets[1], found[1].offsets[1], 1e-9);
}

TEST(OneSidedVertices, AreOppositeOfTheSource) {
  // Around a cone's base: straight over the apex's both sides.
  const Mesh cone = shapes::cone(3, 12, 1, 2).mesh();
  const std::vector<Source> source{{vertex_point(cone, 25)}};
  std::vector<Index> tied;
  const std::vector<std::uint8_t> flags = one_sided_vertices(cone, traced(cone, source));
  for (Index v = 0; v < cone.vertex_count(); ++v) {
    if (flags[v] != 0) tied.push_back(v);
  }
  EXPECT_EQ(tied, (std::vector<Index>{7, 19, 31}));

  const Mesh sphere = jittered(shapes::icosphere(3).mesh(), 0.03, 3);
  const std::vector<Source> any{{vertex_point(sphere, 0)}};
  Index count = 0;
  for (const std::uint8_t flag : one_sided_vertices(sphere, traced(sphere, any))) count += flag;
  EXPECT_EQ(count, 0u);
}

TEST(OneSidedVertices, AreNoneOnAPlaneWherePathsRunAlongTheBorder) {
  const Mesh mesh = shapes::plane(4, 3).mesh();
  for (const Index from : {0u, 2u, 7u}) {
    const std::vector<Source> source{{vertex_point(mesh, from)}};
    const std::vector<std::uint8_t> flags = one_sided_vertices(mesh, traced(mesh, source));
    EXPECT_EQ(flags, std::vector<std::uint8_t>(mesh.vertex_count(), 0)) << "from " << from;
  }
}

TEST(OneSidedVertices, AreBetweenTwoSources) {
  const Mesh mesh = shapes::plane(4, 2).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 5)}, {vertex_point(mesh, 9)}};
  const std::vector<std::uint8_t> flags = one_sided_vertices(mesh, traced(mesh, sources));
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(flags[v], v % 5 == 2 ? 1 : 0) << v;
}

TEST(DistanceGradient, RefusesFieldsWithoutPathsAndMeshesWithoutPositions) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 0)}};
  const std::vector<double> weights(mesh.vertex_count(), 1);
  EXPECT_THROW(distance_gradient_wrt_vertices(mesh, sources, distance(mesh, sources), weights), Error);
  const DistanceField field = traced(mesh, sources);
  EXPECT_THROW(distance_gradient_wrt_vertices(mesh, sources, field, std::span(weights).first(3)), Error);
  CurveSource curve;
  curve.places = {vertex_point(mesh, 0), vertex_point(mesh, 1)};
  const std::vector<Source> curves{source_along(curve)};
  EXPECT_THROW(distance_gradient_wrt_vertices(mesh, curves, traced(mesh, curves), weights), Error);
  EXPECT_THROW(distance_gradient_wrt_vertices(shapes::plane(3, 3).mesh(), sources, field, weights), Error);
}

}  // namespace
}  // namespace brushfire
