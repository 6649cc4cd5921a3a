// The quick way with obtuse corners that one face splits against the general one.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/detail/unfolding_limit.h>
#include <brushfire/solvers/fast_marching/detail/corner_unfolder.h>
#include <brushfire/solvers/fast_marching/detail/unfold.h>
#include <brushfire/solvers/fast_marching/detail/unfolded_corner.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
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
      const Unfolding unfolding = unfolder.unfold(h, brushfire::detail::UnfoldingLimit::kMostUnfolded, triangles);
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

// The rim curves slowly up and down, so that no vertex of it splits the obtuse corner of another one: 64 triangles each
// were 5 kB of memory a face, and 20 in records of carried sources.
TEST(UnfoldedCorner, OfAWavyFanOfNeedlesDoNotFillTheMemory) {
  constexpr Index kFaces = 60000;
  std::vector<Vec3> positions{{0, 0, 0}};
  std::vector<Face> faces;
  for (Index i = 0; i < kFaces; ++i) {
    const double angle = 2 * kPi * i / kFaces;
    positions.push_back({std::cos(angle), std::sin(angle), 0.5 * std::sin(3 * angle)});
    faces.push_back({0, 1 + i, 1 + (i + 1) % kFaces});
  }
  const Mesh mesh(positions, faces);
  struct Count {
    std::size_t updates = 0;
    void add_unfolded(Index, const Corner&) { ++updates; }
    void prefetch(Index) const {}
  } count;
  std::vector<Index> corners(mesh.halfedge_count());
  std::iota(corners.begin(), corners.end(), 0);
  CornerUnfolder<double> unfolder(mesh, Variant::Portable, {});
  unfolder.unfold(corners, count);
  EXPECT_EQ(unfolder.most_crossed(), brushfire::detail::UnfoldingLimit::kMostUnfolded);
  EXPECT_LE(count.updates, 2 * (100'000 + 8 * std::size_t{kFaces}));
}

}  // namespace
}  // namespace brushfire::fast_marching
