// Sources next to a vertex: light does not go round it in circles, and bounds hold.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/refraction/detail/run.h>
#include <brushfire/solvers/steiner/detail/run.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/uneven_wheel.h"

namespace brushfire {
namespace {

// A pyramid without a floor, whose rim is as uneven as a needle's sides: vertex 0 is its tip.
Mesh wheel(std::mt19937_64& random, int i) {
  const Index count = std::array{3U, 5U, 8U, 20U}[static_cast<std::size_t>(i) % 4];
  const double height = std::array{0.0, 0.3, 3.0}[static_cast<std::size_t>(i / 4) % 3];
  return test::uneven_wheel(count, height, i % 3 == 0 ? 0 : 5, random);
}

Weights some_weights(const Mesh& mesh, std::mt19937_64& random, int kind) {
  std::uniform_real_distribution<double> part(0, 1);
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double u = part(random);
    weights.face.push_back(kind == 0   ? 1 + std::floor(4 * u)
                           : kind == 1 ? 1 + 9 * u
                           : kind == 2 ? 1 + 99 * (f % 2)
                           : u < 0.5   ? 1
                                       : 1e9);
  }
  if (kind == 1) weights.edges.push_back({{mesh.from(0), mesh.to(0)}, 0.5, 0});
  return weights;
}

// How much work, and what it may be: windows of a run that answers, for each face; of one that gives up; rows sent.
constexpr double kWindowsForEachFace = 3000;
constexpr std::uint64_t kMostBeforeGivingUp = 250'000;
constexpr double kRowsForEachEdge = 60;

std::uint64_t windows_of(const Mesh& mesh, const Weights& weights, std::span<const Source> sources, double tolerance,
                         bool& answered) {
  const steiner::WeightedMesh weighted(Domain(mesh), weights);
  refraction::Medium medium(weighted);
  answered = false;
  if (!medium.is_followable(tolerance)) return 0;
  steiner::Run run;
  run.mesh = std::make_shared<const steiner::WeightedMesh>(weighted);
  locate(sources, {}, run);
  const steiner::NearVertices near(weighted, run.sources);
  refraction::Run windows(
      medium, run.sources,
      {.share = std::min(tolerance, 0.02), .most_per_vertex = 20 + 0.8 / tolerance, .near = near.of_source});
  answered = windows();
  return windows.windows();
}

TEST(WeightedBeside, ASourceNextToAVertexTakesNoMoreWorkThanOneElsewhere) {
  std::mt19937_64 random(20261130);
  std::uniform_real_distribution<double> power(-62, -12), part(0, 1);
  int answered = 0;
  for (int i = 0; i < 240; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Mesh mesh = i % 5 == 4 ? shapes::icosphere(0).mesh() : wheel(random, i);
    const Weights weights = some_weights(mesh, random, i % 4);
    if (weights.uniform() > 0) continue;
    const double tolerance = std::array{0.01, 0.05, 1e-3}[static_cast<std::size_t>(i / 4) % 3];
    std::vector<Source> sources(static_cast<std::size_t>(1 + (i % 7 == 0) + (i % 3 == 0)));
    double apart = 0;  // no path to vertex 0 costs more
    for (Source& s : sources) {
      const Index h = mesh.corners(0)[random() % mesh.corners(0).size()], f = h / 3;
      const double a = std::exp2(power(random)), b = part(random) < 0.3 ? 0 : std::exp2(power(random));
      s.point.face = f;
      s.point.weights[h % 3] = 1 - a - b;
      s.point.weights[Mesh::next(h) % 3] = a;
      s.point.weights[Mesh::previous(h) % 3] = b;
      const double longest =
          mesh.unit() * std::max({mesh.lengths()[3 * f], mesh.lengths()[3 * f + 1], mesh.lengths()[3 * f + 2]});
      apart = std::max(apart, weights.face[f] * (a + b) * longest);
    }
    bool by_windows = false;
    const std::uint64_t windows = windows_of(mesh, weights, sources, tolerance, by_windows);
    if (by_windows) {
      ++answered;
      EXPECT_LE(static_cast<double>(windows), kWindowsForEachFace * mesh.face_count());
    }
    EXPECT_LE(windows, kMostBeforeGivingUp);
    WeightedSolver solver(mesh, weights);
    const WeightedField field = solver.distance(sources, {.tolerance = tolerance});
    ASSERT_EQ(field.engine == WeightedEngine::Windows, by_windows);
    if (field.run) {
      EXPECT_LE(static_cast<double>(field.run->front.rows_sent), kRowsForEachEdge * field.run->mesh->edges().count());
    }
    const std::vector<Source> vertex{{vertex_point(mesh, 0)}};
    const WeightedField from_vertex = solver.distance(vertex, {.tolerance = tolerance});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_LE(field.lower[v], field.distance[v]) << v;
      ASSERT_LE(field.lower[v], from_vertex.distance[v] + apart) << v;
      ASSERT_GE(field.distance[v], (from_vertex.lower[v] - apart) * (1 - 1e-12)) << v;
    }
    if (by_windows) {
      ASSERT_LE(field.max_error_bound, 2 * tolerance);
    }
  }
  EXPECT_GT(answered, 120);
}

// One window may become thousands behind an edge, and each of these again.
TEST(WeightedBeside, ARunThatIsTooDearGivesUpAmongTheWindowsOfOneHalfedge) {
  const Mesh mesh = shapes::icosphere(0).mesh();
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f) weights.face.push_back(1 + 3 * (f % 2));
  const steiner::WeightedMesh weighted(Domain(mesh), weights);
  refraction::Medium medium(weighted);
  const std::vector<detail::LocatedSource> sources{{locate(mesh, {3, {1 - 1.7e-9, 1e-9, 0.7e-9}}), 0, 0, nullptr}};
  refraction::Run run(medium, sources, {.share = 0.01, .most_per_vertex = 100});  // not told what is near
  EXPECT_FALSE(run());
  EXPECT_LE(run.windows(), kMostBeforeGivingUp);
}

// Where points on edges answer, the vertex next to the source has bounds of its own size.
TEST(WeightedBeside, TheVertexNextToTheSourceHasBoundsAsNearAsOthers) {
  const Mesh mesh = shapes::icosphere(1).mesh();
  Weights weights;
  for (Index f = 0; f < mesh.face_count(); ++f) weights.face.push_back(f < 40 ? 1 : 1e9);
  for (const double e : {1e-4, 1e-8, 1e-11}) {
    const std::vector<Source> sources{{{3, {1 - 1.7 * e, e, 0.7 * e}}}};
    const WeightedField field = weighted_distance(mesh, weights, sources, {.tolerance = 0.05});
    ASSERT_EQ(field.engine, WeightedEngine::Points);
    const Index v = mesh.faces()[3][0];
    EXPECT_LE(field.distance[v], field.lower[v] * 1.05) << e;
    EXPECT_LT(field.distance[v], 2 * e) << e;
  }
}

}  // namespace
}  // namespace brushfire
