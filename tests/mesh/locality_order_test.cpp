// The locality order: a permutation that keeps neighbours together, and cheap.
#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/detail/hilbert.h>
#include <brushfire/mesh/detail/locality_order.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace brushfire {
namespace {

bool is_permutation(UninitializedArray<Index> order, std::size_t n) {
  std::sort(order.begin(), order.end());
  UninitializedArray<Index> expected(n);
  std::iota(expected.begin(), expected.end(), Index{0});
  return order == expected;
}

Shape shuffled(Shape s, std::uint64_t seed) {
  Random random(seed);
  std::vector<Index> name(s.positions.size());
  std::iota(name.begin(), name.end(), Index{0});
  for (std::size_t i = name.size(); i > 1; --i) std::swap(name[i - 1], name[random.below(i)]);
  Shape result = s;
  for (std::size_t v = 0; v < name.size(); ++v) result.positions[name[v]] = s.positions[v];
  for (Face& t : result.faces) t = {name[t[0]], name[t[1]], name[t[2]]};
  for (std::size_t i = s.faces.size(); i > 1; --i) std::swap(result.faces[i - 1], result.faces[random.below(i)]);
  return result;
}

double mean_step_along_edges(const Mesh& mesh, std::span<const Index> rank) {
  double sum = 0;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    sum += std::abs(static_cast<double>(rank[mesh.from(h)]) - static_cast<double>(rank[mesh.to(h)]));
  }
  return sum / mesh.halfedge_count();
}

Mesh without_positions(const Mesh& mesh) {
  std::vector<std::array<double, 3>> lengths;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    lengths.push_back({mesh.lengths()[3 * f], mesh.lengths()[3 * f + 1], mesh.lengths()[3 * f + 2]});
  }
  return Mesh::from_lengths(mesh.vertex_count(), mesh.faces(), lengths);
}

TEST(LocalityOrder, ConsecutiveCellsOfTheHilbertCurveAreNeighbours) {
  // All cells of a 16^3 corner block: their places are the first 16^3, and one step of place is one step in space.
  std::vector<std::array<int, 3>> at(16 * 16 * 16, {-1, -1, -1});
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 16; ++y) {
      for (int z = 0; z < 16; ++z) {
        const std::uint64_t place = detail::hilbert_index(x, y, z);
        ASSERT_LT(place, at.size());
        at[place] = {x, y, z};
      }
    }
  }
  for (std::size_t i = 1; i < at.size(); ++i) {
    ASSERT_GE(at[i][0], 0) << "place " << i << " is not taken";
    EXPECT_EQ(std::abs(at[i][0] - at[i - 1][0]) + std::abs(at[i][1] - at[i - 1][1]) + std::abs(at[i][2] - at[i - 1][2]),
              1)
        << "at place " << i;
  }
}

TEST(LocalityOrder, IsAPermutationOfVerticesAndFacesWithItsInverse) {
  for (const Mesh& mesh : {shuffled(shapes::folded_sphere(4), 1).mesh(), without_positions(shapes::torus(9, 7).mesh()),
                           shapes::book(4, 3, 5).mesh(), Mesh()}) {
    const LocalityOrder order = locality_order(mesh);
    EXPECT_TRUE(is_permutation(order.vertices, mesh.vertex_count()));
    EXPECT_TRUE(is_permutation(order.faces, mesh.face_count()));
    for (Index i = 0; i < mesh.vertex_count(); ++i) EXPECT_EQ(order.vertex_rank[order.vertices[i]], i);
    const UninitializedArray<Index> rank = face_ranks(mesh.faces(), order.vertex_rank);
    for (Index f = 0; f < mesh.face_count(); ++f) EXPECT_EQ(order.faces[rank[f]], f);
  }
}

TEST(LocalityOrder, ARenumberedMeshIsTheSameMesh) {
  const std::vector<Index> slits{7, 40};
  const Mesh scanned = shuffled(shapes::folded_sphere(2), 4).mesh();
  for (const Mesh& mesh : {scanned, without_positions(scanned), scanned.with_slits(slits)}) {
    const LocalityOrder order = locality_order(mesh);
    const UninitializedArray<Index> rank = face_ranks(mesh.faces(), order.vertex_rank);
    const Mesh other = mesh.renumbered(order.vertices, order.vertex_rank, rank);
    EXPECT_EQ(other.unit(), mesh.unit());
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      const Index there = 3 * rank[h / 3] + h % 3;
      EXPECT_EQ(order.vertices[other.from(there)], mesh.from(h));
      EXPECT_EQ(other.length(there), mesh.length(h));
      const Index across = mesh.opposite()[h];
      EXPECT_EQ(other.opposite()[there], 3 * rank[across / 3] + across % 3);
    }
    if (!mesh.has_positions()) continue;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_EQ(other.positions()[v], mesh.positions()[order.vertices[v]]);
    }
  }
}

TEST(LocalityOrder, BringsTheEndsOfEdgesTogether) {
  const Mesh mesh = shuffled(shapes::icosphere(6), 2).mesh();  // 40962 vertices
  const double n = mesh.vertex_count();
  EXPECT_LT(mean_step_along_edges(mesh, locality_order(mesh).vertex_rank), 0.01 * n);
  EXPECT_LT(mean_step_along_edges(mesh, locality_order(without_positions(mesh)).vertex_rank), 0.02 * n);
}

TEST(LocalityOrder, FacesFollowTheirVertices) {
  const Mesh mesh = shuffled(shapes::torus(40, 30), 3).mesh();
  const LocalityOrder order = locality_order(mesh);
  Index last = 0;
  for (const Index f : order.faces) {
    const Face& t = mesh.faces()[f];
    const Index least = std::min({order.vertex_rank[t[0]], order.vertex_rank[t[1]], order.vertex_rank[t[2]]});
    EXPECT_LE(last, least);
    last = least;
  }
}

TEST(LocalityOrder, ExtremeAndCoincidentCoordinatesAreOrdered) {
  for (const double scale : {1e-300, 1e298, 0.0}) {
    Shape s = shapes::plane(5, 5);
    for (Vec3& p : s.positions) p = scale * (2.0 * p - Vec3{1, 1, 0});
    EXPECT_TRUE(is_permutation(locality_order(s.mesh()).vertices, 36));
  }
}

}  // namespace
}  // namespace brushfire
