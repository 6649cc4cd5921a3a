// What hangs together.
#include <brushfire/core/error.h>
#include <brushfire/mesh/reachable.h>

#include <gtest/gtest.h>

namespace brushfire {
namespace {

// Two triangles that meet in a vertex, one on its own, a face of one vertex named thrice, and a vertex in no face.
Mesh islands() {
  std::vector<Vec3> positions;
  for (int i = 0; i < 10; ++i) positions.push_back({1.0 * i, 1.0 * i * i, 0});
  return Mesh(positions, std::vector<Face>{{0, 1, 2}, {2, 3, 4}, {5, 6, 7}, {8, 8, 8}});
}

TEST(Reachable, IsWhatFacesLeadToThroughVertices) {
  const Mesh mesh = islands();
  const auto from = [&](std::vector<SurfacePoint> points) { return reachable(mesh, points); };
  using Flags = std::vector<std::uint8_t>;
  EXPECT_EQ(from({vertex_point(mesh, 0)}), (Flags{1, 1, 1, 1, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(from({{2, {0.2, 0.3, 0.5}}, vertex_point(mesh, 8)}), (Flags{0, 0, 0, 0, 0, 1, 1, 1, 1, 0}));
  EXPECT_EQ(from({target_point(mesh, 9)}), Flags(10, 0));
  EXPECT_EQ(from({}), Flags(10, 0));
  EXPECT_THROW(from({{4, {1, 0, 0}}}), Error);
}

}  // namespace
}  // namespace brushfire
