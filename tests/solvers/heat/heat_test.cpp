// Method "heat": what holds of it whatever the mesh, and how near it comes to what it approximates.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/heat/cholesky.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire {
namespace {

DistanceField heat_from(const Mesh& mesh, const std::vector<Source>& sources, const HeatOptions& heat = {}) {
  DistanceOptions options;
  options.method = Method::Heat;
  options.heat = heat;
  return distance(mesh, sources, options);
}

Source at_vertex(const Mesh& mesh, Index v, double offset = 0) { return {vertex_point(mesh, v), offset}; }

class Heat : public testing::Test {
 protected:
  void SetUp() override {
    if (!heat::can_factor()) GTEST_SKIP() << "this build has no Eigen";
  }
};

// The mean of |value - truth| / truth.
double mean_error(const std::vector<double>& values, const std::vector<double>& truth) {
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (!(truth[v] > 0 && truth[v] < kInfinity)) continue;
    sum += std::abs(values[v] - truth[v]) / truth[v];
    ++count;
  }
  return sum / count;
}

std::vector<double> great_circles(const Mesh& sphere, Index from) {
  std::vector<double> d;
  for (const Vec3& p : sphere.positions()) {
    d.push_back(std::atan2(norm(cross(p, sphere.positions()[from])), dot(p, sphere.positions()[from])));
  }
  return d;
}

TEST_F(Heat, OnASphereItTendsToTheGreatCircles) {
  double last = 1;
  for (const Index levels : {2u, 3u, 4u}) {
    const Mesh mesh = shapes::icosphere(levels).mesh();
    const double error = mean_error(heat_from(mesh, {at_vertex(mesh, 7)}).distance, great_circles(mesh, 7));
    EXPECT_LT(error, 0.6 * last);  // of first order in the edge length
    last = error;
  }
  EXPECT_LT(last, 0.015);
}

TEST_F(Heat, EverySourceReadsItsOwnValueInTenCasesOfSeveral) {
  const Mesh bumps = shapes::noise_terrain(25, 25, 0.4).mesh();
  const Mesh torus = shapes::torus(40, 20).mesh();
  std::mt19937 random(11);
  for (int run = 0; run < 10; ++run) {
    const Mesh& mesh = run % 2 == 0 ? bumps : torus;
    std::vector<Source> sources;
    const auto below = [&](Index count) { return std::uniform_int_distribution<Index>(0, count - 1)(random); };
    for (int k = 0; k < 2 + 3 * run; ++k) {
      sources.push_back(at_vertex(mesh, below(mesh.vertex_count())));
      if (k % 3 == 2) sources.back().point = {below(mesh.face_count()), {0.2, 0.3, 0.5}};
    }
    DistanceOptions options;
    options.method = Method::Heat;
    for (const Source& s : sources) options.targets.push_back(s.point);
    const DistanceField field = distance(mesh, sources, options);
    for (const double d : field.target_distance) EXPECT_EQ(d, 0);
    for (const double d : field.distance) EXPECT_TRUE(d >= 0 && d < kInfinity);
    options.method = Method::Exact;
    options.targets.clear();
    EXPECT_LT(mean_error(field.distance, distance(mesh, sources, options).distance),
              0.15);  // relative, where most are a few edges away
  }
}

TEST_F(Heat, EachComponentHasItsOwnZeroAndOthersAreInfinitelyFar) {
  Shape shape = shapes::icosphere(2);
  const Index n = static_cast<Index>(shape.positions.size());
  for (const double move : {5.0, 10.0}) {
    const Index first = static_cast<Index>(shape.positions.size());
    for (Index v = 0; v < n; ++v) shape.positions.push_back(shape.positions[v] + Vec3{move, 0, 0});
    for (std::size_t f = 0; f < std::size_t{20} * 16; ++f) {
      const Face t = shape.faces[f];
      shape.faces.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  shape.positions.push_back({0, 0, 99});  // in no face
  const Mesh mesh = shape.mesh();
  const DistanceField field = heat_from(mesh, {at_vertex(mesh, 3), at_vertex(mesh, 2 * n + 3, 4)});
  for (Index v = 0; v < n; ++v) {
    EXPECT_LT(field.distance[v], 3.5);
    EXPECT_EQ(field.distance[n + v], kInfinity);
    EXPECT_NEAR(field.distance[2 * n + v], 4 + field.distance[v], 1e-9);
    EXPECT_EQ(field.source[2 * n + v], 1u);
  }
  EXPECT_EQ(field.distance[3], 0);
  EXPECT_EQ(field.distance[2 * n + 3], 4);
  EXPECT_EQ(field.distance.back(), kInfinity);
}

TEST_F(Heat, ItGoesFartherThanNumbersReach) {
  // 3000 edges long: heat at the far end is e^-3000.
  const Mesh mesh = shapes::plane(3000, 2, 3000, 2).mesh();
  const DistanceField field = heat_from(mesh, {at_vertex(mesh, 3001)});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double x = mesh.positions()[v].x;
    EXPECT_NEAR(field.distance[v], x, 1 + 0.01 * x);
  }
  // And from both ends, one of which begins so late that numbers would not show it.
  const DistanceField both = heat_from(mesh, {at_vertex(mesh, 3001), at_vertex(mesh, 6001, 1000)});
  EXPECT_NEAR(both.distance[3001 + 2500], 1500, 20);
  EXPECT_EQ(both.distance[6001], 1000);
  EXPECT_EQ(both.source[3001 + 2500], 1u);
  EXPECT_EQ(both.source[3001 + 1500], 0u);
}

TEST_F(Heat, TheFieldScalesWithTheMeshToTheBit) {
  const Shape shape = shapes::torus(30, 15);
  const Mesh mesh = shape.mesh();
  const DistanceField field = heat_from(mesh, {at_vertex(mesh, 1)}, {.time = 0.1});
  for (const double scale : {0x1p-900, 0x1p-20, 0x1p7, 0x1p300}) {
    std::vector<Vec3> p = shape.positions;
    for (Vec3& x : p) x = scale * x;
    const Mesh scaled(p, shape.faces);
    const DistanceField other = heat_from(scaled, {at_vertex(scaled, 1)});
    const DistanceField same = heat_from(mesh, {at_vertex(mesh, 1)});
    for (Index v = 0; v < mesh.vertex_count(); ++v) ASSERT_EQ(other.distance[v], scale * same.distance[v]);
  }
  EXPECT_NE(field.distance, heat_from(mesh, {at_vertex(mesh, 1)}).distance);
}

// Pieces of very different size: the field of each is that of the piece alone.
TEST_F(Heat, APieceIsRightHoweverSmallItIsBesideOthers) {
  const Shape alone = shapes::torus(20, 10);
  const Mesh one = alone.mesh();
  const std::vector<double> expected = heat_from(one, {at_vertex(one, 1)}).distance;
  const double longest = *std::max_element(expected.begin(), expected.end());
  for (const double size : {1e-3, 1e-6, 1e-15, 1e-40, 1e3, 1e15}) {
    Shape shape = shapes::icosphere(2);
    const Index first = static_cast<Index>(shape.positions.size());
    for (const Vec3& p : alone.positions) shape.positions.push_back(size * p);
    shape.positions.push_back(size * alone.positions[0]);  // a face without area in it, which all are mollified for
    for (const Face& f : alone.faces) shape.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
    shape.faces.push_back({first, first + 1, static_cast<Index>(shape.positions.size()) - 1});
    const Mesh mesh = shape.mesh();
    const DistanceField field = heat_from(mesh, {at_vertex(mesh, first + 1)});
    for (Index v = 0; v < one.vertex_count(); ++v) {
      EXPECT_NEAR(field.distance[first + v] / size, expected[v], 0.15 * longest) << size;
    }
  }
}

TEST_F(Heat, APieceWithoutSizeReadsItsLeastOffset) {
  Shape shape = shapes::icosphere(2);
  const Index first = static_cast<Index>(shape.positions.size());
  for (const Face& f : shapes::plane(2, 2).faces) shape.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  for (int i = 0; i < 9; ++i) shape.positions.push_back({5, 5, 5});
  const Mesh mesh = shape.mesh();
  const DistanceField field =
      heat_from(mesh, {at_vertex(mesh, first + 3, 7), at_vertex(mesh, first + 1, -2), at_vertex(mesh, 0, 1)});
  for (Index v = first; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(field.distance[v], -2);
    EXPECT_EQ(field.source[v], 1u);
  }
  EXPECT_GT(field.distance[20], 1);
}

TEST_F(Heat, AFactorIsItsMultipleOfTheSquaredMeanEdge) {
  const Mesh mesh = shapes::torus(30, 15).mesh();
  const double mean = mesh.report().mean_edge_length;
  const DistanceField by_factor = heat_from(mesh, {at_vertex(mesh, 1)}, {.time_factor = 3, .delaunay = false});
  const DistanceField by_value = heat_from(mesh, {at_vertex(mesh, 1)}, {.time = 3 * mean * mean, .delaunay = false});
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(by_factor.distance[v], by_value.distance[v], 1e-9);
}

TEST_F(Heat, FinsNeedlesDuplicatesAndRepeatedVerticesGiveFiniteFields) {
  Shape fin = shapes::plane(6, 6, 6, 6);
  const Index tip = static_cast<Index>(fin.positions.size());
  fin.positions.push_back({3, 3, 2});
  fin.faces.push_back({24, 25, tip});      // a third face on an inner edge
  fin.faces.push_back({24, 25, tip});      // twice
  fin.faces.push_back({tip, tip, 24});     // conducts
  fin.positions.push_back({0, 0, 1e-13});  // a needle at a corner
  fin.faces.push_back({0, 1, tip + 1});
  fin.positions.push_back({1e5, 0, 0});
  fin.faces.push_back({0, tip + 2, 1});
  for (const Shape& shape : {fin, shapes::book(4, 5, 5), shapes::bow_tie(3, 8), shapes::noise_terrain(9, 9, 100)}) {
    const Mesh mesh = shape.mesh();
    for (const Index from : {0u, 24u}) {
      const DistanceField field = heat_from(mesh, {at_vertex(mesh, from)});
      EXPECT_EQ(field.reached, mesh.vertex_count());
      for (const double d : field.distance) EXPECT_TRUE(std::isfinite(d));
    }
  }
}

TEST_F(Heat, PagesOfABookAreAllReachedAlike) {
  const Mesh mesh = shapes::book(3, 12, 12).mesh();
  const DistanceField field = heat_from(mesh, {at_vertex(mesh, 6)});  // the middle of the spine
  DistanceOptions options;
  options.method = Method::Exact;
  const std::vector<Source> sources{at_vertex(mesh, 6)};
  EXPECT_LT(mean_error(field.distance, distance(mesh, sources, options).distance), 0.05);
}

TEST_F(Heat, TheBorderIsFreeColdOrBoth) {
  const Mesh mesh = shapes::plane(30, 30).mesh();
  const std::vector<Source> middle{at_vertex(mesh, 15 * 31 + 15)};
  std::vector<double> truth;
  for (const Vec3& p : mesh.positions()) truth.push_back(norm(p - mesh.positions()[15 * 31 + 15]));
  const auto error = [&](HeatBoundary b) {
    return mean_error(heat_from(mesh, middle, {.boundary = b}).distance, truth);
  };
  EXPECT_LT(error(HeatBoundary::Neumann), 0.03);
  EXPECT_LT(error(HeatBoundary::Dirichlet), 0.03);
  EXPECT_LT(error(HeatBoundary::Averaged), 0.03);
  const std::vector<Source> corner{at_vertex(mesh, 0)};
  EXPECT_EQ(heat_from(mesh, corner, {.boundary = HeatBoundary::Averaged}).distance[0], 0);
  EXPECT_THROW(heat_from(mesh, corner, {.boundary = HeatBoundary::Dirichlet}), Error);
}

TEST_F(Heat, APoissonShiftFlattensFarValues) {
  const Mesh mesh = shapes::icosphere(5).mesh();
  const std::vector<double> held = heat_from(mesh, {at_vertex(mesh, 0)}).distance;
  const std::vector<double> shifted = heat_from(mesh, {at_vertex(mesh, 0)}, {.poisson_shift = 1e-6}).distance;
  EXPECT_GT(held[3], 0);
  const double most = *std::max_element(held.begin(), held.end());
  EXPECT_LT(*std::max_element(shifted.begin(), shifted.end()), most * (1 - 1e-5));
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(shifted[v], held[v], 0.01 * most);
}

TEST_F(Heat, OptionsOutOfRangeAreErrors) {
  const Mesh mesh = shapes::icosphere(1).mesh();
  for (const HeatOptions& bad :
       {HeatOptions{.time_factor = 0}, HeatOptions{.time_factor = 1e-300}, HeatOptions{.time = 1e-20},
        HeatOptions{.time = 1e20}, HeatOptions{.time_factor = -1}, HeatOptions{.time_factor = std::nan("")},
        HeatOptions{.time = -1}, HeatOptions{.time = kInfinity}, HeatOptions{.poisson_shift = 2}}) {
    EXPECT_THROW(heat_from(mesh, {at_vertex(mesh, 0)}, bad), Error);
  }
}

TEST(HeatWithoutEigen, IsNotAmongTheMethodsAndSaysWhatIsMissing) {
  if (heat::can_factor()) GTEST_SKIP() << "this build has Eigen";
  for (const Method m : all_methods()) EXPECT_NE(m, Method::Heat);
  EXPECT_THROW(method_named("heat"), Error);
}

}  // namespace
}  // namespace brushfire
