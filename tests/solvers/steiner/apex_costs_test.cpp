// Costs to a vertex from beside it, against a dense graph of paths, and at any scale.
#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/steiner/detail/apex_costs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "solvers/weighted/dense_graph.h"
#include "solvers/weighted/random_weighted.h"

namespace brushfire {
namespace {

using steiner::ApexCosts, steiner::NearVertices, steiner::WeightedMesh;
using testing_support::DenseGraph, testing_support::kFansAtAVertex, testing_support::kKinds,
    testing_support::random_complex, testing_support::random_weights;

// The mesh with a vertex in the middle of one of its faces, last.
Mesh with_vertex(const Mesh& mesh, Weights& weights, Index f, const std::array<double, 3>& at) {
  std::vector<Vec3> p(mesh.positions().begin(), mesh.positions().end());
  std::vector<Face> t(mesh.faces().begin(), mesh.faces().end());
  const Face old = t[f];
  const auto v = static_cast<Index>(p.size());
  p.push_back(at[0] * p[old[0]] + at[1] * p[old[1]] + at[2] * p[old[2]]);
  t[f] = {old[0], old[1], v};
  t.push_back({old[1], old[2], v});
  t.push_back({old[2], old[0], v});
  weights.face.insert(weights.face.end(), 2, weights.face[f]);
  return {p, t};
}

// Where nothing outside of the cone is cheaper, they are distances. Some of them go along spokes, others through two
// faces and more.
TEST(ApexCosts, AreThoseOfADenseGraph) {
  int compared = 0, bent = 0;
  for (std::uint64_t seed = 0; seed < 250; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::uint64_t kind = random.below(kKinds);
    const Mesh mesh = random_complex(kind, random);
    Weights weights = random_weights(mesh, false, random);
    const WeightedMesh weighted(Domain(mesh), weights);
    const auto h = static_cast<Index>(random.below(mesh.halfedge_count())), f = h / 3, v = mesh.from(h);
    const double share = random.uniform(0.2, 0.6), part = random.uniform(0.05, 0.95);
    std::array<double, 3> at{};
    at[h % 3] = 1 - share;
    at[Mesh::next(h) % 3] = share * part;
    at[Mesh::previous(h) % 3] = share * (1 - part);
    const ApexCosts costs(weighted, v);
    if (!costs.is_known()) continue;  // 1 beside 1e9
    const ApexCosts::Way way = costs.to_apex(h, at);
    if (!(way.cost <= costs.beyond()) || !way.is_real) continue;
    const double straight = weights.face[f] * norm(position(mesh, {f, at}) - mesh.positions()[v]);
    const Mesh finer = with_vertex(mesh, weights, f, at);
    DenseGraph graph(finer, weights, 64);
    if (kind == kFansAtAVertex) graph.join_at_vertices();
    const double dense = graph.from(finer.vertex_count() - 1)[v], cost = way.cost * mesh.unit();
    ASSERT_LE(cost, dense * (1 + 1e-9));
    ASSERT_GE(cost, dense * (1 - 0.04));
    ++compared;
    bent += cost < 0.96 * straight;
  }
  EXPECT_GT(compared, 40);
  EXPECT_GT(bent, 8);
}

TEST(ApexCosts, GrowInProportionToTheDistance) {
  const Mesh mesh = shapes::icosphere(0).mesh();
  Random random(7);
  const Weights weights = random_weights(mesh, false, random);
  const WeightedMesh weighted(Domain(mesh), weights);
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const ApexCosts costs(weighted, mesh.from(h));
    const auto cost = [&](double share) {
      std::array<double, 3> at{};
      at[h % 3] = 1 - share;
      at[Mesh::next(h) % 3] = 0.3 * share;
      at[Mesh::previous(h) % 3] = 0.7 * share;
      return costs.to_apex(h, at).cost / share;
    };
    for (const double share : {1e-3, 1e-9, 1e-15, 1e-30}) EXPECT_NEAR(cost(share) / cost(0.5), 1, 1e-12) << h;
  }
}

// Two sources beside one vertex and one at another: the least of what they say.
TEST(ApexCosts, OfSeveralSourcesTheLeastCounts) {
  const Mesh mesh = shapes::icosphere(0).mesh();
  const Weights weights{.face = std::vector<double>(mesh.face_count(), 2.0), .edges = {{{0, 1}, 1.0}}};
  const WeightedMesh weighted(Domain(mesh), weights);
  std::vector<detail::LocatedSource> sources;
  const auto add = [&](const SurfacePoint& p, double offset) {
    sources.push_back({locate(mesh, p), offset, static_cast<Index>(sources.size()), nullptr});
  };
  const Index v = mesh.faces()[3][0];
  add({3, {1 - 3e-9, 1e-9, 2e-9}}, 0);
  add({3, {1 - 3e-10, 1e-10, 2e-10}}, 0);
  add(vertex_point(mesh, mesh.faces()[3][1]), 0);
  NearVertices near(weighted, sources);
  ASSERT_EQ(near.bounds.size(), 1U);
  ASSERT_NE(near.at(v), nullptr);
  EXPECT_LT(near.at(v)->upper, 1e-9 * 2);
  EXPECT_GT(near.at(v)->lower, near.at(v)->upper * (1 - 1e-9));
  EXPECT_NEAR(near.of_source[0].upper / near.of_source[1].upper, 10, 1e-9);
  EXPECT_EQ(near.of_source[2].vertex, kNoIndex);
  add(vertex_point(mesh, v), 1e-12);  // and one at the vertex itself
  near = NearVertices(weighted, sources);
  EXPECT_EQ(near.at(v)->upper, 1e-12);
  EXPECT_EQ(near.at(v)->lower, 1e-12);
}

}  // namespace
}  // namespace brushfire
