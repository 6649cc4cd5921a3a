// The quick way with obtuse corners that one face splits against the general one.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/fast_marching/detail/unfold.h>
#include <brushfire/solvers/fast_marching/detail/unfolded_corner.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../support/shared_meshes.h"

namespace brushfire::fast_marching {
namespace {

void expect_same(const UnfoldedTriangle& t, Index first, Index second, double to_first, double to_second,
                 double dot_first, double dot_second, double between, double area) {
  constexpr double kRounding = 1e-13;
  const Vec2 along = t.at_second - t.at_first;
  EXPECT_EQ(t.first, first);
  EXPECT_EQ(t.second, second);
  EXPECT_NEAR(norm(t.at_first), to_first, kRounding * to_first);
  EXPECT_NEAR(norm(t.at_second), to_second, kRounding * to_second);
  EXPECT_NEAR(norm(along), between, kRounding * between);
  EXPECT_NEAR(-dot(t.at_first, along), dot_first, kRounding * to_first * between);
  EXPECT_NEAR(dot(t.at_second, along), dot_second, kRounding * to_second * between);
  EXPECT_NEAR(std::abs(cross(t.at_first, t.at_second)), area, kRounding * to_first * between);
}

TEST(UnfoldedCorner, GivesTheTrianglesOfTheUnfolder) {
  std::vector<Mesh> meshes{shapes::torus(37, 23).mesh(), shapes::folded_sphere(3).mesh()};
  if (test::has_shared_data()) meshes.push_back(test::shared_mesh("camelhead"));
  std::size_t splits = 0;
  for (const Mesh& mesh : meshes) {
    const Unfolder unfolder(mesh);
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      if (!mesh.is_face_usable(Mesh::face_of(h))) continue;
      std::vector<UnfoldedTriangle> triangles;
      const Unfolding unfolding = unfolder.unfold(h, triangles);
      const FacePair pair = face_pair(mesh, unfolder, h), pairs[kCorners] = {pair, pair, pair, pair};
      UnfoldedCorners<double> four;
      const CornerSets sets = portable::unfold_corners(mesh.positions(), 1 / mesh.unit(), pairs, four);
      ASSERT_EQ(sets.obtuse, unfolding.obtuse ? 15u : 0u) << "halfedge " << h;
      ASSERT_EQ(sets.split, unfolding.split && unfolding.crossed == 1 ? 15u : 0u) << "halfedge " << h;
      if (sets.split == 0) continue;
      ASSERT_EQ(triangles.size(), 2u);
      const auto& [a, b] = four.side;
      expect_same(triangles[0], pair.end[0], pair.behind, a.length[3], four.length[3], a.dot_end[3], a.dot_behind[3],
                  a.between[3], a.cross[3]);
      expect_same(triangles[1], pair.behind, pair.end[1], four.length[3], b.length[3], b.dot_behind[3], b.dot_end[3],
                  b.between[3], b.cross[3]);
      ++splits;
    }
  }
  EXPECT_GT(splits, 100u);
}

}  // namespace
}  // namespace brushfire::fast_marching
