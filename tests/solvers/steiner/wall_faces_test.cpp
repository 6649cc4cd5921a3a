// Walls that can be left in a mesh, and those that have to be cut out; costs among either.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/steiner/detail/wall_faces.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace brushfire::steiner {
namespace {

// Unit squares over [0, 6] x [0, 6]: vertex 7 y + x; faces 2 (6 y + x), below the diagonal, and the next one.
Mesh squares() { return shapes::plane(6, 6, 6, 6).mesh(); }

Weights with_walls(const Mesh& mesh, const std::vector<Index>& faces) {
  Weights weights;
  weights.face.assign(mesh.face_count(), 1);
  for (const Index f : faces) weights.face[f] = kInfinity;
  return weights;
}

std::vector<Index> faces_at(const Mesh& mesh, Index v) {
  std::vector<Index> faces;
  for (const Index h : mesh.corners(v)) faces.push_back(Mesh::face_of(h));
  return faces;
}

TEST(WallFaces, ADiscPartsNoVertexAndTwoFacesThatTouchInOneDo) {
  const Mesh mesh = squares();
  EXPECT_FALSE(walls_part_a_vertex(mesh, with_walls(mesh, {})));
  EXPECT_FALSE(walls_part_a_vertex(mesh, with_walls(mesh, {0})));
  EXPECT_FALSE(walls_part_a_vertex(mesh, with_walls(mesh, faces_at(mesh, 24))));
  const std::vector<Index> around = faces_at(mesh, 24);
  for (std::size_t i = 0; i < around.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      int shared = 0;
      for (const Index a : mesh.faces()[around[i]]) {
        for (const Index b : mesh.faces()[around[j]]) shared += a == b;
      }
      EXPECT_EQ(walls_part_a_vertex(mesh, with_walls(mesh, {around[i], around[j]})), shared == 1) << i << " " << j;
    }
  }
}

TEST(WallFaces, ABorderAndAFencePartWhatAWallTouches) {
  const Mesh mesh = squares();
  // One of the three faces at a vertex of the border, the middle one, from its inside.
  int parting = 0;
  for (const Index f : faces_at(mesh, 3)) parting += walls_part_a_vertex(mesh, with_walls(mesh, {f}));
  EXPECT_EQ(parting, 1);
  // A fence that ends at the wall: only the two together are a barrier.
  Weights weights = with_walls(mesh, {2 * (6 * 3 + 3), 2 * (6 * 3 + 3) + 1});  // the square over (3, 3)
  EXPECT_FALSE(walls_part_a_vertex(mesh, weights));
  weights.edges.push_back({{23, 24}, kInfinity, 5});  // from (2, 3) to (3, 3), its corner
  EXPECT_TRUE(walls_part_a_vertex(mesh, weights));
  weights.edges.front().vertices = {22, 23};  // and one that ends before it
  EXPECT_FALSE(walls_part_a_vertex(mesh, weights));
}

// Left or cut out: nothing passes, and all that is open is reached, nowhere below the bounds that
// windows give on the mesh that is cut.
TEST(WallFaces, CostsAmongWallsLeftAreThoseAmongWallsCut) {
  int left = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Mesh mesh = shapes::noise_terrain(12, 10, 0.3, seed).mesh();
    Weights weights;
    std::uniform_real_distribution<double> weight(1, 4);
    for (Index f = 0; f < mesh.face_count(); ++f) weights.face.push_back(weight(random));
    Weights walled = weights;
    Barriers barriers;
    for (int i = 0; i < 3; ++i) {  // all faces around some vertices, or single ones
      const auto any = static_cast<Index>(random() % mesh.vertex_count());
      for (const Index f : seed % 2 ? faces_at(mesh, any) : std::vector<Index>{mesh.corners(any)[0] / 3}) {
        walled.face[f] = kInfinity;
        barriers.faces.push_back(f);
      }
    }
    left += !walls_part_a_vertex(mesh, walled);
    const Domain domain(mesh, barriers);
    const std::vector<Source> sources{{{0, {0.3, 0.3, 0.4}}}};
    if (domain.on_open(sources[0].point).empty()) {
      EXPECT_THROW(weighted_distance(mesh, walled, sources, {.lower = false}), Error);
      continue;
    }
    const WeightedField here = weighted_distance(mesh, walled, sources, {.tolerance = 0.01, .lower = false});
    const WeightedField cut = weighted_distance(domain, weights, sources, {.tolerance = 0.003});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(here.distance[v] < kInfinity, cut.distance[v] < kInfinity) << v;
      if (cut.distance[v] == kInfinity) continue;
      EXPECT_GE(here.distance[v], cut.lower[v] * (1 - 1e-12)) << v;
      EXPECT_LE(here.distance[v], cut.distance[v] * 1.05) << v;
    }
  }
  EXPECT_GE(left, 5);
  EXPECT_LE(left, 22);
}

}  // namespace
}  // namespace brushfire::steiner
