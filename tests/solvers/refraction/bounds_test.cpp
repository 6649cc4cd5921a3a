// Bounds by windows on random complexes, beside a dense graph and locally shortest paths.
#include <brushfire/queries/weighted_path.h>
#include <brushfire/solvers/refraction/detail/run.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "solvers/weighted/dense_graph.h"
#include "solvers/weighted/random_weighted.h"

namespace brushfire {
namespace {

using testing_support::DenseGraph, testing_support::kFansAtAVertex, testing_support::kKinds,
    testing_support::random_complex, testing_support::random_weights;

constexpr double kRounding = 1e-11;

// No lower bound may be above what a real path costs, and no upper one below a lower one that was proven otherwise.
TEST(WeightedWindows, HoldOnThreeHundredRandomComplexes) {
  std::size_t answered = 0;
  for (std::uint64_t seed = 1000; seed < 1300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::uint64_t kind = random.below(kKinds);
    const Mesh mesh = random_complex(kind, random);
    const Weights weights = random_weights(mesh, false, random);
    const auto source = static_cast<Index>(random.below(mesh.vertex_count()));
    const std::vector<Source> sources{{vertex_point(mesh, source)}};
    WeightedSolver solver(mesh, weights);
    const WeightedField field = solver.distance(sources, {.tolerance = 1e-3});
    if (field.engine != WeightedEngine::Windows) continue;  // 1 beside 1e9
    ++answered;
    DenseGraph graph(mesh, weights, 16);
    if (kind == kFansAtAVertex) graph.join_at_vertices();
    const std::vector<double> dense = graph.from(source);
    const WeightedField points = solver.distance(sources, {.tolerance = 0.05, .keep_paths = true});
    std::vector<SurfacePoint> targets;
    for (Index v = 0; v < mesh.vertex_count(); ++v) targets.push_back(target_point(mesh, v));
    const std::vector<WeightedPath> paths =
        weighted_paths(solver, sources, targets, {.tolerance = 0.05, .lower = false});
    ASSERT_LE(field.max_error_bound, 2e-3);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_LE(field.lower[v], field.distance[v]) << v;
      ASSERT_LE(field.lower[v], dense[v] * (1 + kRounding)) << v;
      ASSERT_LE(field.lower[v], paths[v].cost * (1 + kRounding)) << v;
      ASSERT_GE(field.distance[v], points.lower[v] * (1 - kRounding)) << v;
    }
  }
  EXPECT_GT(answered, 150U);
}

struct Rough {
  explicit Rough(Index cells) : mesh(shapes::noise_terrain(cells, cells, 0.2, 5).mesh()), medium(weighted()) {
    sources.push_back({locate(mesh, vertex_point(mesh, 0)), 0, 0, nullptr});
  }
  steiner::WeightedMesh weighted() const {
    Random random(3);
    Weights weights;
    for (Index f = 0; f < mesh.face_count(); ++f) weights.face.push_back(random.uniform(1, 10));
    return {Domain(mesh), weights};
  }

  Mesh mesh;
  refraction::Medium medium;
  std::vector<detail::LocatedSource> sources;
};

// Light that winds round a vertex must not become cheaper by what its refractions may lose.
TEST(WeightedWindows, AreSomeDozenAVertexWhereEveryFaceHasAWeightOfItsOwn) {
  Rough rough(50);
  refraction::Run run(rough.medium, rough.sources, {.share = 0.01, .most_per_vertex = 200});
  ASSERT_TRUE(run());
  EXPECT_LT(run.windows(), 30 * std::uint64_t{rough.mesh.vertex_count()});
}

TEST(WeightedWindows, GiveUpByWhatHasBeenReachedSoFar) {
  Rough rough(100);
  refraction::Run run(rough.medium, rough.sources, {.share = 0.01, .most_per_vertex = 1});
  EXPECT_FALSE(run());
  EXPECT_LT(run.windows(), 130000U);  // 190,000 would have done
}

}  // namespace
}  // namespace brushfire
