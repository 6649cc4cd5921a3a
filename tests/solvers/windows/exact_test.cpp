// Exact distances against files of truth, and identities that need no truth.
#include "support/shared_meshes.h"

#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

namespace brushfire {
namespace {

constexpr double kPromise = 1e-12;

DistanceOptions exact() {
  DistanceOptions options;
  options.method = Method::Exact;
  return options;
}

double worst_deviation(const std::vector<double>& values, const std::vector<double>& truth) {
  double worst = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (truth[v] == values[v]) continue;
    worst =
        std::max(worst, std::isfinite(values[v]) && std::isfinite(truth[v]) ? std::abs(values[v] - truth[v]) / truth[v]
                                                                            : kInfinity);
  }
  return worst;
}

class Truth : public testing::TestWithParam<test::SharedTruth> {};

TEST_P(Truth, IsMetToOnePartInTenToTheTwelve) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  const auto& [name, source] = GetParam();
  const Mesh mesh = test::shared_mesh(name);
  const std::vector<Source> sources{{vertex_point(mesh, source)}};
  const DistanceField field = distance(mesh, sources, exact());
  const double worst = worst_deviation(field.distance, test::shared_truth(name, source));
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LE(worst, kPromise);
}

std::string case_name(const testing::TestParamInfo<test::SharedTruth>& truth) {
  std::string name = truth.param.name + "_" + std::to_string(truth.param.source);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Shared, Truth, testing::ValuesIn(test::shared_truths()), case_name);

// From a handful of vertices up to half of the mesh.
std::vector<double> some_radii(std::vector<double> distances) {
  std::sort(distances.begin(), distances.end());
  std::vector<double> radii;
  for (const double share : {0.001, 0.01, 0.05, 0.2, 0.5}) {
    radii.push_back(distances[static_cast<std::size_t>(share * static_cast<double>(distances.size()))]);
  }
  return radii;
}

class Radius : public testing::TestWithParam<const char*> {};

TEST_P(Radius, LeavesEveryBitWithinItAsItIs) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  const Mesh mesh = test::shared_mesh(GetParam());
  DistanceSolver solver(mesh);
  const Index middle = mesh.vertex_count() / 2, face = mesh.face_count() / 3;
  const std::vector<std::vector<Source>> all{{{vertex_point(mesh, middle)}},
                                             {{{face, {0.2, 0.3, 0.5}}}},
                                             {{vertex_point(mesh, 0)}, {{face, {0.1, 0.6, 0.3}}}}};
  for (const std::vector<Source>& sources : all) {
    DistanceOptions options = exact();
    const DistanceField whole = solver.distance(sources, options);
    for (const double radius : some_radii(whole.distance)) {
      options.max_distance = radius;
      const DistanceField part = solver.distance(sources, options);
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const bool within = whole.distance[v] <= radius;
        ASSERT_EQ(part.distance[v], within ? whole.distance[v] : kInfinity) << "radius " << radius << ", vertex " << v;
        if (!within) continue;
        ASSERT_EQ(part.source[v], whole.source[v]) << "radius " << radius << ", vertex " << v;
        ASSERT_EQ(part.error_bound[v], whole.error_bound[v]) << "radius " << radius << ", vertex " << v;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, Radius, testing::Values("3holes", "cow", "homer", "nm-fin", "mountain"));

}  // namespace
}  // namespace brushfire
