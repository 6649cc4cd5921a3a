// Comparison of fields: which vertices count, and what the measures are.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/compare.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace brushfire {
namespace {

TEST(Compare, MeasuresAreThoseOfTheDefinition) {
  const std::vector<double> reference{1, 2, 4}, field{1.1, 1.8, 4};
  const FieldComparison c = compare_fields(field, reference);
  EXPECT_EQ(c.compared, 3u);
  EXPECT_NEAR(c.absolute.mean, 0.1, 1e-15);
  EXPECT_NEAR(c.absolute.max, 0.2, 1e-15);
  EXPECT_EQ(c.absolute.max_vertex, 1u);
  EXPECT_NEAR(c.absolute.root_mean_square, std::sqrt(0.05 / 3), 1e-15);
  EXPECT_NEAR(c.relative.mean, 0.2 / 3, 1e-15);
  EXPECT_NEAR(c.relative.max, 0.1, 1e-15);
  EXPECT_NEAR(c.mean_signed_relative, 0, 1e-15);
  EXPECT_FALSE(c.has_weights);
}

TEST(Compare, EveryVertexIsCountedOnceAndTheRightWay) {
  const std::vector<double> reference{0, 1, 2, kInfinity, kInfinity}, field{0.25, 1, kInfinity, 3, kInfinity};
  const FieldComparison c = compare_fields(field, reference);
  EXPECT_EQ(c.zero_reference, 1u);
  EXPECT_EQ(c.max_at_zero_reference, 0.25);
  EXPECT_EQ(c.compared, 1u);
  EXPECT_EQ(c.missing, 1u);
  EXPECT_EQ(c.surplus, 1u);
  EXPECT_EQ(c.unreached_in_both, 1u);
  EXPECT_EQ(c.relative.max, 0);
  EXPECT_EQ(c.relative.max_vertex, 1u);
}

TEST(Compare, WeightsCountByAreaAndNotByVertices) {
  const std::vector<double> reference{1, 1, 1}, field{1, 2, 1}, weights{1, 2, 5};
  const FieldComparison c = compare_fields(field, reference, weights);
  EXPECT_TRUE(c.has_weights);
  EXPECT_NEAR(c.relative.mean, 1.0 / 3, 1e-15);
  EXPECT_DOUBLE_EQ(c.weighted_relative.mean, 0.25);
  EXPECT_DOUBLE_EQ(c.weighted_absolute.root_mean_square, 0.5);
}

TEST(Compare, FieldsThatAreTooShortHaveANegativeSignedError) {
  const std::vector<double> reference{1, 2, 4}, field{0.9, 1.8, 3.6};
  EXPECT_NEAR(compare_fields(field, reference).mean_signed_relative, -0.1, 1e-15);
}

TEST(Compare, ScaleDoesNotChangeRelativeErrors) {
  for (const double scale : {1e-200, 1e200}) {
    const std::vector<double> reference{scale, 2 * scale, 4 * scale}, field{1.5 * scale, 2 * scale, 4 * scale};
    const FieldComparison c = compare_fields(field, reference);
    EXPECT_DOUBLE_EQ(c.relative.mean, 0.5 / 3);
    EXPECT_NEAR(c.absolute.root_mean_square, scale * 0.5 / std::sqrt(3.0), 1e-15 * scale);
  }
}

TEST(Compare, FieldsThatAreNoFieldsAreErrors) {
  const std::vector<double> three{1, 2, 3}, two{1, 2}, nan{1, std::nan(""), 3}, low{1, 2, -kInfinity};
  EXPECT_THROW(compare_fields(three, two), Error);
  EXPECT_THROW(compare_fields(nan, three), Error);
  EXPECT_THROW(compare_fields(three, low), Error);
  EXPECT_THROW(compare_fields(three, three, two), Error);
  EXPECT_THROW(compare_fields(three, three, nan), Error);
  EXPECT_EQ(compare_fields({}, {}).compared, 0u);
}

TEST(Compare, VertexAreasSumToTheAreaOfTheMesh) {
  Shape s = shapes::plane(4, 3, 2e3, 5e3);
  s.faces.push_back({0, 0, 1});
  s.positions.push_back({7, 7, 7});
  const Mesh mesh = s.mesh();
  const std::vector<double> areas = vertex_areas(mesh);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 1e7, 1e-5);
  EXPECT_EQ(areas.back(), 0);
  EXPECT_NEAR(mesh.report().area, 1e7, 1e-5);
}

}  // namespace
}  // namespace brushfire
