// Boundary curves of known shapes.
#include <brushfire/core/error.h>
#include <brushfire/mesh/boundaries.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace brushfire {
namespace {

TEST(Boundaries, OfKnownShapes) {
  EXPECT_TRUE(boundaries(shapes::icosphere(1).mesh()).empty());
  const std::vector<Boundary> square = boundaries(shapes::plane(5, 3, 2, 1).mesh());
  ASSERT_EQ(square.size(), 1u);
  EXPECT_TRUE(square[0].closed);
  EXPECT_EQ(square[0].vertices.size(), 16u);
  EXPECT_EQ(square[0].vertices[0], 0u);
  EXPECT_EQ(square[0].vertices[1], 1u);  // the surface on its left
  EXPECT_NEAR(square[0].length, 6, 1e-12);
  const std::vector<Boundary> pipe = boundaries(shapes::cylinder(3, 12, 1, 2).mesh());
  ASSERT_EQ(pipe.size(), 2u);
  EXPECT_TRUE(pipe[0].closed && pipe[1].closed);
  EXPECT_EQ(pipe[0].vertices.size(), 12u);
}

TEST(Boundaries, LongestFirstAndEachItsOwnWhereTheyTouch) {
  const Mesh bow = shapes::bow_tie(3, 6).mesh();
  const std::vector<Boundary> three = boundaries(bow);
  ASSERT_EQ(three.size(), 3u);
  for (const Boundary& b : three) EXPECT_EQ(b.vertices.size(), 6u);
  // Two holes that touch in a vertex of a plane.
  const Mesh mesh = shapes::plane(4, 4).mesh();
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Index cell = f / 2;
    if (cell != 1 * 4 + 1 && cell != 2 * 4 + 2) faces.push_back(f);
  }
  const std::vector<Boundary> holes = boundaries_of(mesh, faces);
  ASSERT_EQ(holes.size(), 2u);  // the square, and a figure of eight or two: around what meets there
  EXPECT_NEAR(holes[0].length, 4, 1e-12);
  EXPECT_TRUE(std::all_of(holes.begin(), holes.end(), [](const Boundary& b) { return b.closed; }));
  EXPECT_THROW(boundaries_of(mesh, std::vector<Index>{99}), Error);
}

TEST(Boundaries, HoldEveryBoundaryEdgeOnceWhateverIsCutOutAndTurnedOver) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Shape shape = seed % 3 ? shapes::plane(8, 9) : shapes::book(3, 4, 5);
    std::vector<Face> kept;
    for (Face t : shape.faces) {
      if (random() % 4 == 0) continue;
      if (random() % 2) std::swap(t[0], t[1]);
      kept.push_back(t);
    }
    shape.faces = kept;
    const Mesh mesh = shape.mesh();
    const std::vector<Boundary> found = boundaries(mesh);
    std::size_t edges = 0;
    double length = 0, expected = 0;
    for (const Boundary& b : found) {
      edges += b.vertices.size() - (b.closed ? 0 : 1);
      length += b.length;
    }
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      if (mesh.opposite()[h] == h) expected += mesh.lengths()[h] * mesh.unit();
    }
    EXPECT_EQ(edges, mesh.report().boundary_edges);
    EXPECT_NEAR(length, expected, 1e-9);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(),
                               [](const Boundary& a, const Boundary& b) { return a.length > b.length; }));
    if (seed % 3) {
      EXPECT_TRUE(std::all_of(found.begin(), found.end(), [](const Boundary& b) { return b.closed; }));
    }
  }
}

}  // namespace
}  // namespace brushfire
