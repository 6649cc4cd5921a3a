// Second derivatives of paths' lengths: against central differences, laws, and where there are none.
#include <brushfire/queries/path_length.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/distance_gradient.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "moved_meshes.h"

namespace brushfire {
namespace {

using test::traced, test::jittered;

std::vector<Vec3> random_moves(std::size_t count, unsigned seed) {
  std::mt19937 dice(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vec3> moves(count);
  for (Vec3& m : moves) m = {any(dice), any(dice), any(dice)};
  return moves;
}

// The gradient of the whole field by all vertices, with those of `length` moved.
std::vector<Vec3> gradient_after(const Mesh& mesh, const PathLength& length, std::span<const Vec3> moves, double step,
                                 std::span<const Source> sources, Index target) {
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    positions[length.vertices()[i]] = positions[length.vertices()[i]] + step * moves[i];
  }
  const Mesh there(positions, mesh.faces());
  std::vector<double> weights(mesh.vertex_count(), 0);
  weights[target] = 1;
  return distance_gradient_wrt_vertices(there, sources, traced(there, sources), weights).vertices;
}

void expect_like_central_difference(const Mesh& mesh, std::span<const Source> sources, Index target, unsigned seed) {
  const DistanceField field = traced(mesh, sources);
  const PathLength length = path_length(mesh, field, target);
  if (length.vertices().empty()) return;
  EXPECT_FALSE(length.is_one_sided());
  EXPECT_NEAR(length.length() + sources[field.source[target]].offset, field.distance[target],
              1e-12 * field.distance[target]);
  const std::vector<Vec3> moves = random_moves(length.vertices().size(), seed);
  constexpr double kStep = 1e-6;
  const std::vector<Vec3> ahead = gradient_after(mesh, length, moves, kStep, sources, target);
  const std::vector<Vec3> behind = gradient_after(mesh, length, moves, -kStep, sources, target);
  const std::vector<Vec3> here = gradient_after(mesh, length, moves, 0, sources, target);
  const std::vector<Vec3> change = length.hessian_times(moves);
  double size = 0;
  for (const Vec3& c : change) size = std::max(size, norm(c));
  double elsewhere = 0;
  for (const Vec3& g : here) elsewhere += norm(g);
  for (std::size_t i = 0; i < change.size(); ++i) {
    const Index v = length.vertices()[i];
    EXPECT_LT(norm(length.gradient()[i] - here[v]), 1e-11) << "seed " << seed << ", vertex " << v;
    elsewhere -= norm(here[v]);
    const Vec3 measured = (1 / (2 * kStep)) * (ahead[v] - behind[v]);
    EXPECT_LT(norm(change[i] - measured), 1e-6 * size) << "seed " << seed << ", vertex " << v;
  }
  EXPECT_NEAR(elsewhere, 0, 1e-9);
}

TEST(PathLength, ChangesItsGradientAsCentralDifferencesDoOnTwentyMeshes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::array<Mesh, 5> smooth{shapes::icosphere(3).mesh(), shapes::torus(24, 12).mesh(),
                                     shapes::plane(9, 8).mesh(), shapes::cylinder(5, 17, 1, 2).mesh(),
                                     shapes::saddle(6).mesh()};
    const Mesh mesh = jittered(smooth[seed % 5], 0.02, seed);
    const std::vector<Source> sources{{vertex_point(mesh, seed % mesh.vertex_count())},
                                      {SurfacePoint{7 * seed % mesh.face_count(), {0.2, 0.5, 0.3}}, 0.1}};
    for (const unsigned share : {3u, 5u, 7u}) {
      const Index target = mesh.vertex_count() * share / 8;
      expect_like_central_difference(mesh, std::span(sources).first(seed % 2 + 1), target, seed);
    }
  }
}

TEST(PathLength, OfTwoFacesIsThatOfTheUnfoldedOnes) {
  // A hinge along y: the far vertices at distances 3 and 4 from it, 7 apart along it when laid flat at any fold.
  const double fold = 0.8;
  const std::vector<Vec3> x{{0, -20, 0}, {0, 20, 0}, {-3, -3, 0}, {4 * std::cos(fold), 4, 4 * std::sin(fold)}};
  const std::vector<Face> faces{{0, 1, 2}, {1, 0, 3}};
  const Mesh mesh(x, faces);
  const std::vector<Source> sources{{vertex_point(mesh, 2)}};
  const PathLength length = path_length(mesh, traced(mesh, sources), 3);
  EXPECT_NEAR(length.length(), std::sqrt(98.0), 1e-13);
  // Moved along y, a vertex goes as in the plane: 1/L - dy^2/L^3.
  std::vector<Vec3> moves(4);
  moves[3] = {0, 1, 0};
  EXPECT_NEAR(length.hessian_times(moves)[3].y, 1 / std::sqrt(98.0) - 49 / std::pow(98.0, 1.5), 1e-14);
  // Moved along the circle around the hinge it stays as far: the second derivative is 4 times the pull inwards.
  moves[3] = {-std::sin(fold), 0, std::cos(fold)};
  const Vec3 inward{-std::cos(fold), 0, -std::sin(fold)};
  EXPECT_NEAR(dot(length.hessian_times(moves)[3], moves[3]), -dot(length.gradient()[3], inward) / 4, 1e-14);
}

TEST(PathLength, HasASymmetricHessianThatMovesOfTheWholeMeshDoNotFeel) {
  const Mesh mesh = jittered(shapes::torus(20, 12).mesh(), 0.02, 4);
  const std::vector<Source> sources{{vertex_point(mesh, 3)}};
  const PathLength length = path_length(mesh, traced(mesh, sources), 130);
  const std::vector<double> h = length.hessian();
  const std::size_t size = 3 * length.vertices().size();
  ASSERT_EQ(h.size(), size * size);
  ASSERT_GT(size, 30u);
  double largest = 0;
  for (const double value : h) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(h[i * size + j], h[j * size + i], 1e-12 * largest);
  }
  // Turned, the gradient turns along; scaled, it stays.
  const Vec3 axis{0.3, -0.5, 0.8};
  std::vector<Vec3> shift(size / 3, axis), scale(size / 3), turn(size / 3);
  for (std::size_t i = 0; i < size / 3; ++i) {
    scale[i] = mesh.positions()[length.vertices()[i]];
    turn[i] = cross(axis, scale[i]);
  }
  for (const Vec3& c : length.hessian_times(shift)) EXPECT_LT(norm(c), 1e-12 * largest);
  for (const Vec3& c : length.hessian_times(scale)) EXPECT_LT(norm(c), 1e-11 * largest);
  const std::vector<Vec3> turned = length.hessian_times(turn);
  for (std::size_t i = 0; i < size / 3; ++i) {
    EXPECT_LT(norm(turned[i] - cross(axis, length.gradient()[i])), 1e-11 * largest);
  }
}

TEST(PathLength, TellsWhereThePathGoesStraightOnThroughAVertex) {
  const Mesh flat = shapes::plane(4, 4).mesh();
  const std::vector<Source> corner{{vertex_point(flat, 0)}};
  const DistanceField field = traced(flat, corner);
  EXPECT_TRUE(path_length(flat, field, 2).is_one_sided());   // along two edges
  EXPECT_FALSE(path_length(flat, field, 1).is_one_sided());  // along one
  EXPECT_FALSE(path_length(flat, field, 8).is_one_sided());  // over edges only
}

TEST(PathLength, BendsAroundWallsInTheNumbersOfTheWholeMesh) {
  const Mesh mesh = jittered(shapes::plane(6, 6, 6, 6).mesh(), 0.05, 5);
  Barriers barriers;
  for (Index v = 3; v < 31; v += 7) barriers.edges.push_back({v, v + 7});
  const Domain domain(mesh, barriers);
  const std::vector<Source> sources{{vertex_point(mesh, 8)}};
  const DistanceField field = traced(domain, sources);
  const PathLength length = path_length(domain, field, 12);
  EXPECT_NEAR(length.length(), field.distance[12], 1e-12);
  EXPECT_FALSE(length.is_one_sided());
  EXPECT_TRUE(std::binary_search(length.vertices().begin(), length.vertices().end(), 31u));  // the wall's end
  EXPECT_LT(length.vertices().back(), mesh.vertex_count());
  std::vector<double> weights(mesh.vertex_count(), 0);
  weights[12] = 1;
  const DistanceGradient all = distance_gradient_wrt_vertices(domain, sources, field, weights);
  for (std::size_t i = 0; i < length.vertices().size(); ++i) {
    EXPECT_LT(norm(length.gradient()[i] - all.vertices[length.vertices()[i]]), 1e-12);
  }
}

TEST(PathLength, OfASourceItselfIsNothing) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 4)}};
  const PathLength length = path_length(mesh, traced(mesh, sources), 4);
  EXPECT_EQ(length.length(), 0);
  EXPECT_TRUE(length.vertices().empty() && length.hessian().empty());
}

TEST(PathLength, RefusesWhatIsNoPath) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 0)}};
  EXPECT_THROW(path_length(mesh, distance(mesh, sources), 1), Error);
  EXPECT_THROW(path_length(mesh, traced(mesh, sources), 9), Error);
  const std::vector<SurfacePoint> apart{vertex_point(mesh, 0), vertex_point(mesh, 8)};
  EXPECT_THROW(PathLength(mesh, apart), Error);
  const std::vector<SurfacePoint> still{vertex_point(mesh, 0), vertex_point(mesh, 0)};
  EXPECT_THROW(PathLength(mesh, still), Error);
  const std::vector<SurfacePoint> inside{
      vertex_point(mesh, 0), {0, {0.4, 0.3, 0.3}}, vertex_point(mesh, mesh.faces()[0][1])};
  EXPECT_THROW(PathLength(mesh, inside), Error);
  EXPECT_THROW(path_length(mesh, traced(mesh, sources), 1).hessian_times({}), Error);
}

}  // namespace
}  // namespace brushfire
