// Regression tests: small meshes on which an earlier state of the engine was wrong or did not end.
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire {
namespace {

std::vector<double> distances(const Mesh& mesh, const SurfacePoint& at) {
  DistanceOptions options;
  options.method = Method::Exact;
  const Source source{at};
  return distance(mesh, {&source, 1}, options).distance;
}

void expect_near(const std::vector<double>& got, const std::vector<double>& wanted) {
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t v = 0; v < got.size(); ++v) EXPECT_NEAR(got[v], wanted[v], 1e-12 * wanted[v]) << v;
}

// Vertex 1 lies in the middle of the edge 0-2 of a face without area; the face beyond that edge has its apex above it.
const std::vector<Vec3> kOnALine{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {2, 3, 0}};
const std::vector<Face> kFlatAndBeyond{{0, 1, 2}, {0, 2, 3}};

TEST(Dirty, TheMiddleVertexOfAFaceWithoutAreaShinesOverTheLongEdge) {
  const Mesh mesh(kOnALine, kFlatAndBeyond);
  expect_near(distances(mesh, {0, {0, 1, 0}}), {2, 0, 2, 3});
}

TEST(Dirty, ASourceInAFaceWithoutAreaShinesOverTheEdgesThatItLiesOn) {
  const Mesh mesh(kOnALine, kFlatAndBeyond);
  // 0.25 * 0 + 0.25 * 2 + 0.5 * 4 = 2.5 along the line.
  expect_near(distances(mesh, {0, {0.25, 0.25, 0.5}}), {2.5, 0.5, 1.5, std::hypot(0.5, 3)});
}

TEST(Dirty, LightThatEntersAFaceWithoutAreaLeavesItUnbent) {
  // From the apex below through the flat face to the apex above.
  const std::vector<Vec3> positions{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {2.5, 3, 0}, {1, -2, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 3}, {1, 0, 4}};
  const Mesh mesh(positions, faces);
  EXPECT_NEAR(distances(mesh, {2, {0, 0, 1}})[3], std::hypot(1.5, 5), 1e-12);
}

TEST(Dirty, FacesWithoutAreaOverTheSameVerticesComeToAnEnd) {
  // Soups in which light used to go round through flat duplicates for ever.
  const std::vector<Vec3> a{{2, 0, 3}, {2, 0, 2}, {2, 3, 3}, {1, 1, 0}, {1, 1, 0}};
  const std::vector<Face> fa{{0, 1, 2}, {3, 4, 2}, {4, 3, 2}, {3, 2, 1}};
  expect_near(distances(Mesh(a, fa), {0, {0, 0.9892578125, 0.0107421875}}),
              {0.98978258770441681, 0.033969779552590012, 3.1283078806157893, 2.4453362899451788, 2.4453362899451788});
  const std::vector<Vec3> b{{0, 0, 0}, {1, 2, 0}, {0, 0, 0}, {2, 2, 0}};
  const std::vector<Face> fb{{0, 1, 2}, {1, 0, 2}, {1, 3, 0}};
  expect_near(distances(Mesh(b, fb), {2, {0.089407191448007781, 0.69290573372206021, 0.21768707482993196}}),
              {2.1504241774812902, 0.6445024623314348, 2.1504241774812902, 0.68186956682860252});
}

TEST(Dirty, LightThatGoesRoundDoesNotImproveByRounding) {
  const std::vector<Vec3> positions{{2, 2, 3}, {1, 0, 2}, {4, 6, 5}};
  const std::vector<Face> faces{{0, 1, 2}, {2, 0, 1}};
  expect_near(distances(Mesh(positions, faces), {0, {0, 0.9853515625, 0.0146484375}}),
              {2.3418461505710267, 0.10764359221215138, 7.2408256361373829});
}

TEST(Dirty, VerticesSeenByNothingYetAreNotReadAfterAnEarlyStop) {
  // A needle whose far end has only a bound by way of a bent path when the target is reached.
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}, {0.5, 40, 0}, {1.5, 0.5, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {2, 1, 4}, {0, 2, 3}, {2, 4, 3}};
  const Mesh mesh(positions, faces);
  DistanceOptions options;
  options.method = Method::Exact;
  options.targets = {{0, {0.3, 0.6, 0.1}}};
  const Source source{{0, {0.4, 0.5, 0.1}}};
  const DistanceField field = distance(mesh, {&source, 1}, options);
  EXPECT_NEAR(field.target_distance[0], 0.1, 1e-12);
  EXPECT_EQ(field.distance[3], kInfinity);
  EXPECT_EQ(field.source[3], kNoIndex);
  EXPECT_EQ(field.reached + field.beyond_radius + field.unreachable, mesh.vertex_count());
}

// Vertex 5 lies on the long edge of a face without area, and the source just above it, on a boundary. Its light over
// that edge is all that goes to vertex 1, and the source's own light reads the same there, to rounding of places on the
// edge.
TEST(Dirty, AVertexOnAnEdgeIsNotBeatenByLightThatPassesItWithATolerance) {
  const std::vector<Vec3> positions{{0, 0, 0}, {4, 4, 0},   {0, 1, 0}, {2, 1, 0},
                                    {0, 1, 0}, {1.5, 1, 0}, {0, 1, 0}, {0, 2, 0}};
  const std::vector<Face> faces{{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}, {4, 5, 7}, {4, 7, 6}};
  const Mesh mesh(positions, faces);
  for (const double share : {2.8743601058448129e-05, 1e-4, 1e-3, 1e-2}) {
    const Source source{{4, {0, 1 - share, share}}};
    // Over the edge 0-3 vertex 1 lies at (5.6, 0.8).
    const double wanted = share * std::hypot(1.5, 1) + std::hypot(4.1, 0.2);
    for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-5, 1e-8}) {
      DistanceOptions options;
      options.method = Method::Windows;
      options.tolerance = tolerance;
      const DistanceField field = distance(mesh, {&source, 1}, options);
      EXPECT_LE(std::abs(field.distance[1] - wanted), field.error_bound[1]) << share << ", " << tolerance;
      EXPECT_LE(field.error_bound[1], tolerance * wanted) << share << ", " << tolerance;
    }
  }
}

}  // namespace
}  // namespace brushfire
