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

}  // namespace
}  // namespace brushfire
