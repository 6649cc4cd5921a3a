// Barriers: walls are tight, ends of walls are not, and everything finds its way back.
#include <brushfire/core/error.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace brushfire {
namespace {

constexpr Index kCells = 4;  // plane(4, 4): vertex y * 5 + x

Index at(Index x, Index y) { return y * (kCells + 1) + x; }

Mesh grid() { return shapes::plane(kCells, kCells).mesh(); }

std::vector<std::array<Index, 2>> column(Index x, Index from, Index to) {
  std::vector<std::array<Index, 2>> edges;
  for (Index y = from; y < to; ++y) edges.push_back({at(x, y), at(x, y + 1)});
  return edges;
}

TEST(Cut, NoBarriersChangeNothing) {
  const Mesh mesh = grid();
  const CutMesh c = cut(mesh, {});
  EXPECT_TRUE(std::equal(c.mesh.faces().begin(), c.mesh.faces().end(), mesh.faces().begin()));
  EXPECT_EQ(c.mesh.vertex_count(), mesh.vertex_count());
}

TEST(Cut, AWallFromBoundaryToBoundaryPartsTheMesh) {
  const CutMesh c = cut(grid(), {.edges = column(2, 0, kCells)});
  EXPECT_EQ(c.mesh.report().components, 2u);
  EXPECT_EQ(c.mesh.vertex_count(), 25u + 5);
  EXPECT_EQ(c.mesh.face_count(), 32u);
  for (Index v = 25; v < 30; ++v) EXPECT_EQ(c.original_vertex[v] % 5, 2u);
}

TEST(Cut, AWallThatEndsInsideLeavesItsEndWhole) {
  const CutMesh c = cut(grid(), {.edges = column(2, 0, 3)});
  EXPECT_EQ(c.mesh.report().components, 1u);
  EXPECT_EQ(c.mesh.vertex_count(), 25u + 3);  // the boundary vertex and two inside; not the end
  EXPECT_EQ(c.mesh.report().boundary_edges, 16u + 6);
  EXPECT_EQ(c.mesh.report().euler_characteristic, 1);
  EXPECT_EQ(c.mesh.links()[at(2, 3)], Link::Arc);
}

TEST(Cut, ASlitOfOneEdgeIsOpenThoughBothItsEndsAreWhole) {
  const CutMesh c = cut(grid(), {.edges = {{at(2, 1), at(2, 2)}}});
  EXPECT_EQ(c.mesh.vertex_count(), 25u);
  EXPECT_EQ(c.mesh.report().boundary_edges, 16u + 2);
  EXPECT_EQ(c.mesh.report().nonmanifold_vertices, 0u);
  EXPECT_EQ(c.mesh.links()[at(2, 1)], Link::Arc);
}

TEST(Cut, ABlockedVertexBlocksItsFacesAndIsInNone) {
  const CutMesh c = cut(grid(), {.vertices = {at(2, 2)}});
  EXPECT_EQ(c.mesh.face_count(), 32u - 6);
  EXPECT_TRUE(c.mesh.corners(at(2, 2)).empty());
  EXPECT_EQ(c.mesh.vertex_count(), 25u);
  EXPECT_EQ(c.mesh.report().components, 1u);
}

TEST(Cut, BlockedFacesThatTouchAtVerticesOnlyAreATightWall) {
  // Both faces of the cells on the diagonal that does not run along the cells' own: they touch at corners.
  std::vector<Index> faces;
  for (Index i = 0; i < kCells; ++i) {
    const Index cell = i * kCells + (kCells - 1 - i);
    faces.insert(faces.end(), {2 * cell, 2 * cell + 1});
  }
  const CutMesh c = cut(grid(), {.faces = faces});
  EXPECT_EQ(c.mesh.report().components, 2u);
  EXPECT_EQ(c.mesh.face_count(), 24u);
  EXPECT_EQ(c.mesh.vertex_count(), 25u + 3);
  EXPECT_EQ(c.mesh.report().nonmanifold_vertices, 0u);
  for (Index f = 0; f < c.mesh.face_count(); ++f) EXPECT_EQ(c.cut_face[c.original_face[f]], f);
  for (const Index f : faces) EXPECT_EQ(c.cut_face[f], kNoIndex);
}

TEST(Cut, AClosedWallOnASphereIsTight) {
  // All edges of a ring of a sphere: inside and outside fall apart.
  const Index slices = 8;
  const Mesh mesh = shapes::latlong_sphere(6, slices).mesh();
  std::vector<std::array<Index, 2>> ring;
  for (Index j = 0; j < slices; ++j) ring.push_back({1 + slices + j, 1 + slices + (j + 1) % slices});
  const CutMesh c = cut(mesh, {.edges = ring});
  EXPECT_EQ(c.mesh.report().components, 2u);
  EXPECT_EQ(c.mesh.report().euler_characteristic, 2);  // two discs
  // The same without one edge stays in one piece.
  ring.pop_back();
  EXPECT_EQ(cut(mesh, {.edges = ring}).mesh.report().components, 1u);
}

TEST(Cut, FansThatMetInAVertexBeforeStillDo) {
  const Mesh bow = shapes::bow_tie(3, 6).mesh();
  // One blocked edge at the common vertex: its disc stays one piece there.
  const CutMesh one = cut(bow, {.edges = {{0, 1}}});
  EXPECT_EQ(one.mesh.report().components, 1u);
  // Two blocked edges part their disc, and then nothing may pass through the vertex.
  const CutMesh two = cut(bow, {.edges = {{0, 1}, {0, 4}}});
  EXPECT_EQ(two.mesh.report().components, 4u);
  // A whole fan blocked: the others still meet.
  const CutMesh rest = cut(bow, {.faces = {0, 1, 2, 3, 4, 5}});
  EXPECT_EQ(rest.mesh.report().components, 1u);
  EXPECT_EQ(rest.mesh.corners(0).size(), 12u);
}

TEST(Cut, ASlitAlongTheSpineOfABookPartsItsPages) {
  const Mesh book = shapes::book(3, 2, 2).mesh();
  EXPECT_EQ(cut(book, {.edges = {{0, 1}, {1, 2}}}).mesh.report().components, 3u);
  // A blocked face on the spine leaves the other pages joined over the edge.
  const CutMesh c = cut(book, {.faces = {0, 1}});
  EXPECT_EQ(c.mesh.report().components, 1u);
  EXPECT_EQ(c.mesh.report().nonmanifold_edges, 1u);
}

TEST(Cut, ValuesComeBackAsTheMinimumOfTheCopies) {
  const CutMesh c = cut(grid(), {.edges = column(2, 0, kCells)});
  std::vector<double> values(c.mesh.vertex_count(), 7);
  std::vector<Index> source(c.mesh.vertex_count(), 3);
  values[27] = 2;
  source[27] = 1;
  source[26] = 0;
  std::vector<double> distance;
  std::vector<Index> label;
  c.to_original(values, source, distance, label);
  EXPECT_EQ(distance.size(), 25u);
  EXPECT_EQ(distance[c.original_vertex[27]], 2);
  EXPECT_EQ(label[c.original_vertex[27]], 1u);
  EXPECT_EQ(distance[c.original_vertex[26]], 7);
  EXPECT_EQ(label[c.original_vertex[26]], 0u);  // equal distances: the lowest source
  EXPECT_THROW(c.to_original(distance), Error);
}

TEST(Cut, PointsGoThereAndBack) {
  const Mesh mesh = grid();
  const Index h = 3 * (2 * 1) + 1;  // the upright edge x = 2, y in [0, 1/4], of cell 1
  ASSERT_EQ(mesh.from(h), at(2, 0));
  ASSERT_EQ(mesh.to(h), at(2, 1));
  for (const auto& edges : {column(2, 0, kCells), column(2, 0, 1)}) {
    const CutMesh c = cut(mesh, {.edges = edges});
    SurfacePoint on_wall{Mesh::face_of(h), {0, 0.75, 0.25}};
    const auto sides = c.from_original(mesh, on_wall);
    EXPECT_EQ(sides.size(), 2u);
    for (const SurfacePoint& p : sides) {
      EXPECT_EQ(position(mesh, c.to_original(p)), position(mesh, on_wall));
      EXPECT_EQ(position(c.mesh, p), position(mesh, on_wall));
    }
  }
  const CutMesh c = cut(mesh, {.faces = {0}, .edges = column(2, 0, kCells)});
  EXPECT_EQ(c.from_original(mesh, vertex_point(mesh, at(2, 2))).size(), 2u);
  EXPECT_EQ(c.from_original(mesh, vertex_point(mesh, at(1, 2))).size(), 1u);
  EXPECT_TRUE(c.from_original(mesh, {0, {0.4, 0.3, 0.3}}).empty());
  EXPECT_EQ(c.from_original(mesh, {5, {0.4, 0.3, 0.3}}).size(), 1u);
}

TEST(Cut, MeshesFromLengthsAreCutAlike) {
  const Mesh mesh = grid();
  std::vector<std::array<double, 3>> lengths;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    std::array<double, 3> l;
    for (Index k = 0; k < 3; ++k) l[k] = mesh.lengths()[3 * f + k] * mesh.unit();
    lengths.push_back(l);
  }
  const Mesh intrinsic = Mesh::from_lengths(mesh.vertex_count(), mesh.faces(), lengths);
  const CutMesh c = cut(intrinsic, {.edges = column(2, 0, kCells)});
  EXPECT_FALSE(c.mesh.has_positions());
  EXPECT_EQ(c.mesh.report().components, 2u);
  EXPECT_DOUBLE_EQ(c.mesh.report().area, 1);
}

TEST(Cut, FacesThatNameAVertexTwiceDoNotBridgeAWall) {
  Shape s = shapes::plane(kCells, kCells);
  s.faces.push_back({at(2, 1), at(2, 1), at(2, 2)});
  const CutMesh c = cut(s.mesh(), {.edges = column(2, 0, kCells)});
  EXPECT_GE(c.mesh.report().components, 2u);
  EXPECT_EQ(c.mesh.report().repeated_index_faces, 1u);
  EXPECT_EQ(c.mesh.report().zero_length_edges, 0u);
}

TEST(Cut, BarriersThatDoNotExistAreErrors) {
  const Mesh mesh = grid();
  EXPECT_THROW(cut(mesh, {.vertices = {25}}), Error);
  EXPECT_THROW(cut(mesh, {.faces = {32}}), Error);
  EXPECT_THROW(cut(mesh, {.edges = {{at(0, 0), at(2, 2)}}}), Error);
  EXPECT_THROW(cut(mesh, {.edges = {{at(0, 0), at(0, 0)}}}), Error);
  EXPECT_THROW(cut(mesh, {.edges = {{at(0, 0), 99}}}), Error);
}

}  // namespace
}  // namespace brushfire
