// distance_sparse(): the same numbers as distance(), for what it reaches only, again and again.
#include <brushfire/core/error.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <random>

namespace brushfire {
namespace {

// An n x n grid of unit squares, each split in two.
Mesh grid(Index n) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      positions.push_back({static_cast<double>(x), static_cast<double>(y), 0});
      if (x + 1 == n || y + 1 == n) continue;
      const Index v = y * n + x;
      faces.push_back({v, v + 1, v + n});
      faces.push_back({v + 1, v + n + 1, v + n});
    }
  }
  return Mesh(positions, faces);
}

void expect_same(const SparseField& sparse, const DistanceField& dense) {
  ASSERT_EQ(sparse.vertex.size(), dense.reached);
  std::size_t i = 0;
  for (Index v = 0; v < dense.distance.size(); ++v) {
    if (dense.distance[v] == kInfinity) continue;
    ASSERT_EQ(sparse.vertex[i], v);
    ASSERT_EQ(sparse.distance[i], dense.distance[v]);
    ASSERT_EQ(sparse.source[i], dense.source[v]);
    ++i;
  }
  EXPECT_EQ(sparse.target_distance, dense.target_distance);
  EXPECT_EQ(sparse.target_source, dense.target_source);
}

TEST(DistanceSparse, RunsInAnyOrderOnOneSolverEqualSingleRunsToTheBit) {
  const Mesh mesh = grid(40);
  for (const Method method : all_methods()) {
    DistanceSolver solver(mesh);
    const unsigned seed = 7;
    SCOPED_TRACE(testing::Message() << name_of(method) << ", seed " << seed);
    std::mt19937 random(seed);
    const auto random_point = [&] {
      return vertex_point(mesh, std::uniform_int_distribution<Index>(0, mesh.vertex_count() - 1)(random));
    };
    for (int run = 0; run < 30; ++run) {
      std::vector<Source> sources;
      for (unsigned k = 0; k <= random() % 3; ++k) {
        sources.push_back({random_point(), static_cast<double>(random() % 4)});
      }
      DistanceOptions options;
      options.method = method;
      options.max_distance = run % 3 == 0 ? kInfinity : static_cast<double>(random() % 12);
      if (run % 4 == 1) options.targets.push_back(random_point());
      expect_same(solver.distance_sparse(sources, options), distance(mesh, sources, options));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(DistanceSparse, ARunThatIsCancelledLeavesNothingBehind) {
  const Mesh mesh = grid(150);
  for (const Method method : all_methods()) {
    SCOPED_TRACE(name_of(method));
    DistanceSolver solver(mesh);
    CancelToken cancel;
    cancel.cancel();
    DistanceOptions options;
    options.method = method;
    options.cancel = &cancel;
    const std::vector<Source> corner{{vertex_point(mesh, 0), 0}};
    const std::vector<Source> middle{{vertex_point(mesh, 150 * 75 + 75), 0}};
    EXPECT_THROW(solver.distance_sparse(corner, options), Error);
    options.cancel = nullptr;
    options.max_distance = 5;
    expect_same(solver.distance_sparse(middle, options), distance(mesh, middle, options));
  }
}

TEST(DistanceSparse, DijkstraStopsAtItsTargetsAndLeavesNothingHalfDone) {
  const Mesh mesh = grid(30);
  DistanceSolver solver(mesh);
  const std::vector<Source> sources{{vertex_point(mesh, 435)}, {vertex_point(mesh, 12)}};
  DistanceOptions options;
  options.method = Method::Dijkstra;
  const DistanceField whole = solver.distance(sources, options);
  options.targets = {vertex_point(mesh, 497), SurfacePoint{900, {0.5, 0.25, 0.25}}};
  const DistanceField field = solver.distance(sources, options);
  EXPECT_LT(field.reached, whole.reached / 2);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (field.distance[v] == kInfinity) continue;
    EXPECT_EQ(field.distance[v], whole.distance[v]);
    EXPECT_EQ(field.source[v], whole.source[v]);
  }
  EXPECT_EQ(field.target_distance[0], whole.distance[497]);
  EXPECT_LT(field.target_distance[1], kInfinity);
  expect_same(solver.distance_sparse(sources, options), field);
  // From one source to one vertex the front spreads that way first.
  options.targets.clear();
  const DistanceField all = solver.distance(std::span(sources).first(1), options);
  for (const Index v : {0u, 31u, 434u, 899u}) {
    options.targets = {vertex_point(mesh, v)};
    const DistanceField one = solver.distance(std::span(sources).first(1), options);
    EXPECT_EQ(one.target_distance[0], all.distance[v]);
    for (Index u = 0; u < mesh.vertex_count(); ++u) {
      EXPECT_TRUE(one.distance[u] == kInfinity || one.distance[u] == all.distance[u]);
    }
    options.max_distance = all.distance[v];
    EXPECT_EQ(solver.distance(std::span(sources).first(1), options).target_distance[0], all.distance[v]);
    options.max_distance = kInfinity;
  }
  options.targets = {SurfacePoint{}};  // nowhere: there is nothing to wait for
  EXPECT_EQ(solver.distance(sources, options).reached, whole.reached);
}

}  // namespace
}  // namespace brushfire
