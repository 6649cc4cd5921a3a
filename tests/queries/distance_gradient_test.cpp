// Derivatives of distances: against central differences, laws, and the cut locus.
#include <brushfire/queries/distance_gradient.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace brushfire {
namespace {

DistanceField traced(const Domain& domain, std::span<const Source> sources) {
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  return distance(domain, sources, options);
}

double weighted_sum(const Mesh& mesh, std::span<const Vec3> positions, std::span<const Source> sources,
                    std::span<const double> weights) {
  const DistanceField field = traced(Mesh(positions, mesh.faces()), sources);
  double sum = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (field.distance[v] < kInfinity) sum += weights[v] * field.distance[v];
  }
  return sum;
}

// Positions moved at random, so that no two paths are equally long by symmetry.
Mesh jittered(const Mesh& mesh, double by, unsigned seed) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> any(-by, by);
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  for (Vec3& p : positions) p = p + Vec3{any(dice), any(dice), any(dice)};
  return Mesh(positions, mesh.faces());
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

}  // namespace
}  // namespace brushfire
