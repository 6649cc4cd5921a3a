// The oracle itself: cases that can be checked by hand, closed forms, the visibility graph, a dense Steiner graph, and
// the exact distances of other programs.
#include "oracle/deviation.h"
#include "oracle/planar_domain.h"
#include "oracle/polyhedral.h"
#include "oracle/zoo.h"
#include "support/shared_meshes.h"

#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>

namespace brushfire::oracle {
namespace {

std::vector<Real> from_vertex(const Mesh& mesh, Index v) {
  const Source source{vertex_point(mesh, v), 0};
  return polyhedral_distance(mesh, std::span(&source, 1)).distance;
}

std::vector<Real> from_point(const Mesh& mesh, const SurfacePoint& p) {
  const Source source{p, 0};
  return polyhedral_distance(mesh, std::span(&source, 1)).distance;
}

Real relative_error(Real a, Real b) { return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b)); }

TEST(Oracle, RhombusOfTwoTrianglesIsCrossedStraight) {
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, -1, 0}},
                  std::vector<Face>{{0, 3, 1}, {1, 3, 2}});
  const auto d = from_vertex(mesh, 0);
  EXPECT_EQ(d[2], 4);
  EXPECT_LT(relative_error(d[1], std::sqrt(5.0L)), 1e-18);
}

// Light along an edge enters a face without area whose third corner lies on the source's side of the edge.
TEST(Oracle, LightAlongALineDoesNotTurnBackInAFaceWithoutArea) {
  const Mesh mesh(std::vector<Vec3>{{-3, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, -2, 0}, {-2, 0, 0}, {0, 2, 0}},
                  std::vector<Face>{{0, 3, 1}, {3, 2, 1}, {1, 2, 4}, {1, 4, 5}});
  const Source source{vertex_point(mesh, 0), 0};
  const std::vector<SurfacePoint> targets{{3, {0.5, 0.5, 0}}, {2, {0.25, 0, 0.75}}};
  for (const Arithmetic arithmetic : {Arithmetic::LongDouble, Arithmetic::Quad, Arithmetic::Octuple}) {
    const Truth truth = polyhedral_distance(mesh, std::span(&source, 1), kFar, targets, arithmetic);
    EXPECT_EQ(truth.target[0], 4);
    EXPECT_EQ(truth.target[1], 4.5L);
  }
}

TEST(Oracle, PathBendsAtTheReflexCornerOfASheet) {
  // An L of three unit squares: from one end around the inner corner (1,1) to the other.
  const Mesh mesh(
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}},
      std::vector<Face>{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}});
  const auto d = from_vertex(mesh, 2);
  EXPECT_LT(relative_error(d[7], std::sqrt(2.0L) + 1), 1e-18);
  EXPECT_LT(relative_error(d[6], std::sqrt(8.0L)), 1e-18);
}

TEST(Oracle, PagesOfABookAreUnfoldedIntoOnePlane) {
  const Shape book = shapes::book(5, 4, 4);
  const Mesh mesh = book.mesh();
  const Index from = 5 + 3 * 5;  // somewhere on the first page
  const auto d = from_vertex(mesh, from);
  const Vec3 s = book.positions[from];
  const Real sx = std::hypot(Real{s.x}, Real{s.y});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = book.positions[v];
    const Real x = std::hypot(Real{p.x}, Real{p.y});
    const bool same_page = std::abs(p.x * s.y - p.y * s.x) < 1e-12 && p.x * s.x + p.y * s.y >= -1e-12;
    const Real expected = std::hypot(same_page ? x - sx : x + sx, Real{p.z} - Real{s.z});
    EXPECT_LT(std::abs(d[v] - expected), 1e-15) << v;
  }
}

TEST(Oracle, BowTieIsPassedThroughItsVertexOnly) {
  const Mesh mesh = shapes::bow_tie(3, 6).mesh();
  const auto centre = from_vertex(mesh, 0);
  const auto rim = from_vertex(mesh, 1);
  for (Index v = 7; v < mesh.vertex_count(); ++v) EXPECT_LT(relative_error(rim[v], rim[0] + centre[v]), 1e-16);
}

TEST(Oracle, FlatTorusFromLengthsHasTheDistancesOfTheLattice) {
  constexpr Index kColumns = 7, kRows = 5;
  constexpr Real kWidth = 3.5, kHeight = 2;
  const Mesh mesh = flat_torus(kColumns, kRows, 3.5, 2);
  const auto d = from_vertex(mesh, 0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Real x = kWidth / kColumns * (v % kColumns), y = kHeight / kRows * (v / kColumns);
    const Real expected = std::hypot(std::min(x, kWidth - x), std::min(y, kHeight - y));
    EXPECT_LT(std::abs(d[v] - expected), 4e-15) << v;  // the lengths are doubles
  }
}

TEST(Oracle, FaceOfNoAreaConductsFromEdgeToEdge) {
  // Vertex 2 lies on the edge 0-1; above it two faces, below it one, between them a face without area.
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {1.5, -1, 0}},
                  std::vector<Face>{{0, 2, 3}, {2, 1, 3}, {0, 1, 2}, {1, 0, 4}});
  EXPECT_LT(relative_error(from_vertex(mesh, 3)[4], std::sqrt(5.0L)), 1e-18);
  EXPECT_LT(relative_error(from_vertex(mesh, 4)[3], std::sqrt(5.0L)), 1e-18);
  EXPECT_LT(relative_error(from_vertex(mesh, 2)[4], std::sqrt(1.25L)), 1e-18);
  EXPECT_LT(relative_error(from_vertex(mesh, 4)[2], std::sqrt(1.25L)), 1e-18);
}

TEST(Oracle, RepeatedIndicesConductAlongTheirEdge) {
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {5, 5, 5}},
                  std::vector<Face>{{0, 1, 0}, {1, 2, 2}, {3, 3, 3}});
  const auto d = from_vertex(mesh, 0);
  EXPECT_EQ(d[1], 1);
  EXPECT_EQ(d[2], 3);
  EXPECT_EQ(d[3], kFar);
  const auto from_edge = from_point(mesh, {1, {0.25, 0.75, 0}});
  EXPECT_EQ(from_edge[1], 1.5);
  EXPECT_EQ(from_edge[0], 2.5);
}

TEST(Oracle, OffsetsAndTheRadiusAreThoseOfTheFront) {
  const Mesh mesh = shapes::plane(4, 4, 4, 4).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 0), -1}, {vertex_point(mesh, 24), 0.5}};
  const Truth truth = polyhedral_distance(mesh, sources, 1.75);
  EXPECT_EQ(truth.distance[0], -1);
  EXPECT_EQ(truth.distance[2], 1);
  EXPECT_EQ(truth.distance[4], kFar);
  EXPECT_EQ(truth.distance[23], 1.5);
}

TEST(Oracle, TargetsInFacesAndOnEdgesAreReached) {
  const Mesh mesh = shapes::plane(3, 3, 3, 3).mesh();
  const Source source{{0, {0, 0.5, 0.5}}, 0};  // the middle of the edge (1,0)-(1,1)
  const std::vector<SurfacePoint> targets{
      {17, {1.0 / 4, 1.0 / 4, 1.0 / 2}}, {0, {0, 0.25, 0.75}}, {0, {0.5, 0.25, 0.25}}, {16, {0, 1, 0}}};
  const Truth truth = polyhedral_distance(mesh, std::span(&source, 1), kFar, targets);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Vec3 d = position(mesh, targets[i]) - Vec3{1, 0.5, 0};
    EXPECT_LT(std::abs(truth.target[i] - std::hypot(Real{d.x}, Real{d.y})), 1e-16) << i;
  }
}

// Dijkstra's algorithm on points on all edges; within a face all are joined. Real paths, hence never below the truth.
std::vector<double> steiner_distances(const Mesh& mesh, Index source, int pieces) {
  std::vector<Vec3> nodes(mesh.positions().begin(), mesh.positions().end());
  std::map<std::pair<Index, Index>, std::vector<Index>> on_edge;
  const auto nodes_of = [&](Index a, Index b) -> const std::vector<Index>& {
    auto& list = on_edge[std::minmax(a, b)];
    if (!list.empty()) return list;
    list = {a, b};
    for (int k = 1; k < pieces && a != b; ++k) {
      const double t = static_cast<double>(k) / pieces;
      list.push_back(static_cast<Index>(nodes.size()));
      const Vec3 p = (1 - t) * nodes[a] + t * nodes[b];
      nodes.push_back(p);
    }
    return list;
  };
  std::vector<std::vector<Index>> cliques;
  for (const Face& t : mesh.faces()) {
    std::vector<Index> all;
    for (int k = 0; k < 3; ++k) {
      const auto& list = nodes_of(t[k], t[(k + 1) % 3]);
      if (mesh.is_face_usable(static_cast<Index>(&t - mesh.faces().data()))) {
        all.insert(all.end(), list.begin(), list.end());
      } else {
        cliques.push_back(list);
      }
    }
    cliques.push_back(all);
  }
  std::vector<std::vector<Index>> member(nodes.size());
  for (Index c = 0; c < cliques.size(); ++c) {
    for (const Index v : cliques[c]) member[v].push_back(c);
  }
  std::vector<double> distance(nodes.size(), kInfinity);
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.emplace(distance[source] = 0, source);
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d != distance[v]) continue;
    for (const Index c : member[v]) {
      for (const Index w : cliques[c]) {
        const double through = d + norm(nodes[w] - nodes[v]);
        if (through < distance[w]) queue.emplace(distance[w] = through, w);
      }
    }
  }
  distance.resize(mesh.vertex_count());
  return distance;
}

TEST(Oracle, SoupsAgreeWithADenseSteinerGraph) {
  double worst = 0;
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    const Mesh mesh = random_soup(seed, 7 + seed % 9, 6 + seed % 17);
    const Index source = mesh.faces()[0][0];
    const auto truth = from_vertex(mesh, source);
    const auto bound = steiner_distances(mesh, source, 24);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(truth[v] == kFar, bound[v] == kInfinity) << "seed " << seed << " vertex " << v;
      if (truth[v] == kFar) continue;
      ASSERT_LE(truth[v], bound[v] * (1 + 1e-14)) << "seed " << seed << " vertex " << v;
      worst = std::max(worst, static_cast<double>((bound[v] - truth[v]) / std::max(truth[v], Real{1})));
      ASSERT_GE(truth[v], bound[v] * (1 - 4e-3) - 4e-3) << "seed " << seed << " vertex " << v;
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(Oracle, AwkwardMeshesAgreeWithADenseSteinerGraph) {
  for (const Specimen& s : awkward_meshes()) {
    if (!s.mesh.has_positions()) continue;
    for (const Index source : {s.mesh.faces()[0][0], s.mesh.faces()[s.mesh.face_count() / 2][2]}) {
      const auto truth = from_vertex(s.mesh, source);
      const auto bound = steiner_distances(s.mesh, source, 40);
      for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
        ASSERT_EQ(truth[v] == kFar, bound[v] == kInfinity) << s.name << " vertex " << v;
        if (truth[v] == kFar) continue;
        ASSERT_LE(truth[v], bound[v] * (1 + 1e-14)) << s.name << " vertex " << v;
        ASSERT_GE(truth[v], bound[v] * (1 - 2e-2)) << s.name << " vertex " << v;
      }
    }
  }
}

TEST(Oracle, DistancesAreSymmetricOnEveryComplex) {
  std::vector<Specimen> all = awkward_meshes();
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    all.push_back({"soup " + std::to_string(seed), random_soup(seed, 6 + seed % 7, 9 + seed % 11)});
    all.push_back({"intrinsic " + std::to_string(seed), random_intrinsic(seed, 5 + seed % 9, 8 + seed % 25)});
  }
  for (const Specimen& s : all) {
    std::vector<std::vector<Real>> rows;
    const Index count = std::min(s.mesh.vertex_count(), Index{20});
    for (Index v = 0; v < count; ++v) {
      rows.push_back(s.mesh.corners(v).empty() ? std::vector<Real>(s.mesh.vertex_count(), kFar)
                                               : from_vertex(s.mesh, v));
    }
    for (Index a = 0; a < count; ++a) {
      for (Index b = 0; b < a; ++b) {
        ASSERT_LT(relative_error(rows[a][b], rows[b][a]), 1e-14) << s.name << ": " << a << " - " << b;
      }
    }
  }
}

TEST(Oracle, DomainsWithHolesAgreeWithTheVisibilityGraph) {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const PlanarDomain domain = random_domain(random, 5 + static_cast<int>(seed % 4), 9, seed % 3 == 0);
    const DomainPoint source = random_point(domain, random);
    const auto expected = visibility_distances(domain, source.at);
    const auto d = from_point(domain.mesh(), source.on);
    for (std::size_t v = 0; v < d.size(); ++v) {
      // The weights 1/3 are doubles.
      ASSERT_TRUE(d[v] == expected[v] || std::abs(d[v] - expected[v]) < 1e-12)
          << "seed " << seed << " vertex " << v << ": " << d[v] << " instead of " << expected[v];
    }
  }
}

TEST(Oracle, AgreesWithOtherExactPrograms) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const test::SharedTruth& t : test::shared_truths()) {
    const Mesh mesh = test::shared_mesh(t.name);
    if (mesh.vertex_count() > 7000 || t.name.rfind("grid", 0) == 0) continue;  // the benchmark does the rest
    const auto known = test::shared_truth(t.name, t.source);
    const auto d = from_vertex(mesh, t.source);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_LT(relative_error(d[v], known[v]), 2e-13) << t.name << " from " << t.source << " vertex " << v;
    }
  }
}

// A source on a vertex that lies on an edge of a row without altitude was lost beside another source (by rounding, in
// rule 3): distances from several sources are the least of those from each.
TEST(Oracle, SeveralSourcesOnRowsWithoutAltitudeAreTheLeastOfEach) {
  for (std::uint32_t grid = 1; grid <= 60; ++grid) {
    const Mesh mesh = needle_grid(grid, 6, 0);
    std::mt19937 random(grid);
    const std::vector<Source> sources{{random_vertex(mesh, random), 0.05}, {random_edge_point(mesh, random), 0}};
    const Truth both = polyhedral_distance(mesh, sources);
    const Truth one = polyhedral_distance(mesh, std::span(sources).first(1));
    const Truth other = polyhedral_distance(mesh, std::span(sources).last(1));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Real least = std::min(one.distance[v], other.distance[v]);
      EXPECT_LE(std::abs(both.distance[v] - least), 1e-14L) << "grid " << grid << ", vertex " << v;
    }
  }
}

}  // namespace
}  // namespace brushfire::oracle
