// Farthest-point sampling against its definition.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace brushfire {
namespace {

DistanceOptions with(Method method) {
  DistanceOptions options;
  options.method = method;
  return options;
}

TEST(Sampling, EverySampleIsTheFarthestVertexFromThoseBefore) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  for (const Method method : {Method::Dijkstra, Method::NovotniKlein}) {
    const DistanceOptions options = with(method);
    const Samples samples = farthest_points(mesh, 12, {}, options);
    ASSERT_EQ(samples.vertices.size(), 12u);
    std::vector<double> nearest(mesh.vertex_count(), kInfinity);
    for (std::size_t i = 0; i < samples.vertices.size(); ++i) {
      const double farthest = *std::max_element(nearest.begin(), nearest.end());
      EXPECT_EQ(samples.separation[i], farthest);
      EXPECT_EQ(nearest[samples.vertices[i]], farthest);
      const Source source{vertex_point(mesh, samples.vertices[i]), 0};
      const DistanceField field = distance(mesh, std::span(&source, 1), options);
      for (Index v = 0; v < mesh.vertex_count(); ++v) nearest[v] = std::min(nearest[v], field.distance[v]);
    }
    EXPECT_EQ(samples.distance, nearest);
    EXPECT_EQ(samples.covering_radius, *std::max_element(nearest.begin(), nearest.end()));
  }
}

TEST(Sampling, ShorterRunsAreBeginningsOfLongerOnes) {
  const Mesh mesh = shapes::torus(24, 12).mesh();
  const Samples few = farthest_points(mesh, 5), many = farthest_points(mesh, 20);
  EXPECT_TRUE(std::equal(few.vertices.begin(), few.vertices.end(), many.vertices.begin()));
  EXPECT_LT(many.covering_radius, few.covering_radius);
}

TEST(Sampling, NearestNamesTheSampleOfTheDistance) {
  const Mesh mesh = shapes::icosphere(3).mesh();
  const std::vector<Index> first{17, 99};
  const Samples samples = farthest_points(mesh, 6, first, with(Method::Dijkstra));
  EXPECT_EQ(samples.vertices[0], 17u);
  EXPECT_EQ(samples.vertices[1], 99u);
  for (Index s = 0; s < 6; ++s) {
    EXPECT_EQ(samples.nearest[samples.vertices[s]], s);
    EXPECT_EQ(samples.distance[samples.vertices[s]], 0);
  }
}

TEST(Sampling, EveryComponentGetsASampleAndIsolatedVerticesNone) {
  Shape s = shapes::plane(3, 3);
  const Index n = static_cast<Index>(s.positions.size());
  const std::vector<Vec3> once = s.positions;
  const std::vector<Face> faces = s.faces;
  for (const Vec3& p : once) s.positions.push_back(p + Vec3{5, 0, 0});
  for (const Face& t : faces) s.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  s.positions.push_back({99, 99, 99});
  const Samples two = farthest_points(s.mesh(), 2);
  EXPECT_EQ(two.vertices, (std::vector<Index>{0, n}));
  EXPECT_EQ(two.separation[1], kInfinity);
  EXPECT_EQ(two.nearest.back(), kNoIndex);
  EXPECT_LT(two.covering_radius, 2);
  const Samples all = farthest_points(s.mesh(), 1000);
  EXPECT_EQ(all.vertices.size(), 2 * n);
  EXPECT_EQ(all.covering_radius, 0);
}

TEST(Sampling, BadRequestsAreErrorsAndEmptyMeshesGiveNothing) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  EXPECT_THROW(farthest_points(mesh, 3, std::vector<Index>{99}), Error);
  EXPECT_THROW(farthest_points(mesh, 3, std::vector<Index>{1, 1}), Error);
  EXPECT_THROW(farthest_points(mesh, 1, std::vector<Index>{1, 2}), Error);
  EXPECT_TRUE(farthest_points(mesh, 0).vertices.empty());
  EXPECT_TRUE(farthest_points(Mesh(), 3).vertices.empty());
}

}  // namespace
}  // namespace brushfire
