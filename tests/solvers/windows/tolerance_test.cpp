// The tolerance is kept at every vertex, by bounds that are proven by the windows themselves.
#include "support/shared_meshes.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <random>

namespace brushfire {
namespace {

// Room for the rounding of the exact run that stands in for truth.
constexpr double kTruth = 1e-12;

std::vector<std::pair<std::string, Mesh>> meshes() {
  std::vector<std::pair<std::string, Mesh>> all{{"saddle", shapes::saddle(20, 1.5).mesh()},
                                                {"cube", shapes::cube(8).mesh()},
                                                {"torus", shapes::torus(40, 20).mesh()},
                                                {"icosphere", shapes::icosphere(3).mesh()},
                                                {"cone", shapes::cone(12, 25).mesh()},
                                                {"folded", shapes::folded_sphere(3).mesh()},
                                                {"book", shapes::book(5, 6, 8).mesh()},
                                                {"bow tie", shapes::bow_tie(3, 9).mesh()},
                                                {"terrain", shapes::noise_terrain(40, 40, 0.5).mesh()}};
  if (test::has_shared_data()) {
    for (const char* name :
         {"cow", "teapot", "nm-fin", "nm-bowtie", "beetle", "degen-sliver", "two-comp", "rocker-arm-x10"}) {
      all.emplace_back(name, test::shared_mesh(name));
    }
  }
  return all;
}

DistanceOptions windows(double tolerance, Bound bound = Bound::Estimate) {
  DistanceOptions options;
  options.method = Method::Windows;
  options.tolerance = tolerance;
  options.bound = bound;
  return options;
}

TEST(Tolerance, IsKeptAtEveryVertexByTheBoundThatIsReported) {
  std::mt19937 random(3);
  for (const auto& [name, mesh] : meshes()) {
    DistanceSolver solver(mesh);
    for (int run = 0; run < (mesh.vertex_count() < 4000 ? 2 : 1); ++run) {
      const Source source{{static_cast<Index>(random() % mesh.face_count()), {0.2, 0.7, 0.1}}};
      DistanceOptions exact;
      exact.method = Method::Exact;
      const std::vector<double> truth = solver.distance({&source, 1}, exact).distance;
      for (const double t : {1e-1, 1e-2, 1e-3, 1e-5}) {
        const DistanceField field = solver.distance({&source, 1}, windows(t));
        const DistanceField upper = solver.distance({&source, 1}, windows(t, Bound::Upper));
        const DistanceField lower = solver.distance({&source, 1}, windows(t, Bound::Lower));
        EXPECT_LE(field.max_error_bound, t) << name;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          const double d = truth[v];
          ASSERT_EQ(field.distance[v] == kInfinity, d == kInfinity) << name << ", vertex " << v << ", t " << t;
          if (d == kInfinity) continue;
          ASSERT_LE(std::abs(field.distance[v] - d), field.error_bound[v]) << name << ", vertex " << v << ", t " << t;
          ASSERT_LE(field.error_bound[v], t * d) << name << ", vertex " << v << ", t " << t;
          ASSERT_GE(upper.distance[v], d * (1 - kTruth)) << name << ", vertex " << v << ", t " << t;
          ASSERT_LE(upper.distance[v], d * (1 + t)) << name << ", vertex " << v << ", t " << t;
          ASSERT_LE(lower.distance[v], d * (1 + kTruth)) << name << ", vertex " << v << ", t " << t;
          ASSERT_GE(lower.distance[v], d * (1 - t)) << name << ", vertex " << v << ", t " << t;
        }
      }
    }
  }
}

TEST(Tolerance, IsOfThePathsLengthWhereSourcesHaveOffsets) {
  const Mesh mesh = shapes::noise_terrain(40, 40, 0.5).mesh();
  const std::vector<Source> sources{
      {vertex_point(mesh, 20), -3.0}, {{900, {0.3, 0.3, 0.4}}, -2.9}, {{2500, {0, 1, 0}}, -2.8}};
  DistanceOptions exact;
  exact.method = Method::Exact;
  const DistanceField truth = distance(mesh, sources, exact);
  for (const double t : {1e-2, 1e-4}) {
    const DistanceField field = distance(mesh, sources, windows(t));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double length = truth.distance[v] - sources[truth.source[v]].offset;
      ASSERT_LE(std::abs(field.distance[v] - truth.distance[v]), field.error_bound[v] + 1e-15) << v;
      ASSERT_LE(field.error_bound[v], t * std::max(length, 0.2)) << v;
    }
  }
}

TEST(Tolerance, HoldsForTargetsToo) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  std::mt19937 random(5);
  DistanceOptions exact;
  exact.method = Method::Exact;
  for (int i = 0; i < 200; ++i) {
    const double a = static_cast<double>(random() % 1000) / 1000;
    exact.targets.push_back({static_cast<Index>(random() % mesh.face_count()), {a, (1 - a) / 3, 2 * (1 - a) / 3}});
  }
  const Source source{vertex_point(mesh, 5)};
  const DistanceField truth = distance(mesh, {&source, 1}, exact);
  for (const double t : {1e-2, 1e-3}) {
    DistanceOptions options = windows(t);
    options.targets = exact.targets;
    const DistanceField field = distance(mesh, {&source, 1}, options);
    for (std::size_t i = 0; i < options.targets.size(); ++i) {
      EXPECT_LE(std::abs(field.target_distance[i] - truth.target_distance[i]), t * truth.target_distance[i]) << i;
    }
  }
}

TEST(Tolerance, CostsNothingWhereOneSourceExplainsEverything) {
  const Mesh mesh = shapes::plane(60, 40, 3, 1).mesh();
  const Source source{{1000, {0.5, 0.2, 0.3}}};
  const Vec3 from = position(mesh, source.point);
  for (const double t : {1e-1, 1e-2, 1e-3}) {
    const DistanceField field = distance(mesh, {&source, 1}, windows(t));
    EXPECT_LE(field.max_error_bound, 1e-5);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double d = norm(mesh.positions()[v] - from);
      ASSERT_LE(std::abs(field.distance[v] - d), 1e-6 * d);
    }
  }
}

TEST(Tolerance, OutsideItsRangeIsAnError) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  const Source source{vertex_point(mesh, 0)};
  EXPECT_THROW(distance(mesh, {&source, 1}, windows(-1e-3)), Error);
  EXPECT_THROW(distance(mesh, {&source, 1}, windows(0.2)), Error);
  EXPECT_THROW(distance(mesh, {&source, 1}, windows(std::nan(""))), Error);
}

TEST(Tolerance, OfZeroIsExactToTheBit) {
  const Mesh mesh = shapes::saddle(15, 1.0).mesh();
  const Source source{vertex_point(mesh, 7)};
  DistanceOptions exact;
  exact.method = Method::Exact;
  EXPECT_EQ(distance(mesh, {&source, 1}, windows(0)).distance, distance(mesh, {&source, 1}, exact).distance);
}

}  // namespace
}  // namespace brushfire
