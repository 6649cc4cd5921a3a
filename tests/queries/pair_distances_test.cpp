// Distances of pairs are entries of the matrix.
#include <brushfire/queries/pair_distances.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/distance_matrix.h>

#include <gtest/gtest.h>

#include <random>

namespace brushfire {
namespace {

std::vector<std::array<Index, 2>> random_pairs(Index vertex_count, std::size_t count, Index sources) {
  std::mt19937 dice(7);
  std::uniform_int_distribution<Index> any(0, vertex_count - 1), few(0, sources - 1);
  std::vector<std::array<Index, 2>> pairs(count);
  for (auto& pair : pairs) pair = {any(dice), few(dice)};
  return pairs;
}

MatrixOptions exactly(unsigned threads = 1) {
  MatrixOptions options;
  options.distance.method = Method::Exact;
  options.threads = threads;
  return options;
}

TEST(PairDistances, AreEntriesOfTheMatrixOnAnyNumberOfThreads) {
  const Mesh mesh = shapes::folded_sphere(2).mesh();
  const std::vector<double> matrix = distance_matrix<double>(mesh, std::nullopt, std::nullopt, exactly());
  const auto pairs = random_pairs(mesh.vertex_count(), 300, 20);  // whose second vertices are few: they are the sources
  const std::vector<double> one = pair_distances(mesh, pairs, exactly(1)),
                            three = pair_distances(mesh, pairs, exactly(3));
  EXPECT_EQ(one, three);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double expected = matrix[std::size_t{pairs[i][1]} * mesh.vertex_count() + pairs[i][0]];
    EXPECT_NEAR(one[i], expected, 1e-13 * expected) << i;
  }
}

TEST(PairDistances, AreInfiniteWhereNothingLeads) {
  Shape two = shapes::plane(1, 1);
  const auto n = static_cast<Index>(two.positions.size());
  for (Index v = 0; v < n; ++v) two.positions.push_back(two.positions[v] + Vec3{9, 0, 0});
  two.positions.push_back({20, 20, 0});  // in no face
  for (Index f = 0; f < 2; ++f) two.faces.push_back({two.faces[f][0] + n, two.faces[f][1] + n, two.faces[f][2] + n});
  const std::vector<std::array<Index, 2>> pairs{{0, n}, {2 * n, 0}, {0, 2 * n}, {n, n}, {0, 1}};
  EXPECT_EQ(pair_distances(two.mesh(), pairs, exactly()),
            (std::vector<double>{kInfinity, kInfinity, kInfinity, 0, norm(two.positions[1] - two.positions[0])}));
  EXPECT_TRUE(pair_distances(two.mesh(), {}).empty());
}

TEST(PairDistances, RefuseVerticesThatThereAreNot) {
  const std::vector<std::array<Index, 2>> pairs{{0, 4}};
  EXPECT_THROW(pair_distances(shapes::plane(1, 1).mesh(), pairs), Error);
}

TEST(PairDistances, AreDividedByTheRootOfTheArea) {
  EXPECT_NEAR(root_of_area(shapes::plane(2, 3, 4, 9).mesh()), 6, 1e-14);
}

}  // namespace
}  // namespace brushfire
