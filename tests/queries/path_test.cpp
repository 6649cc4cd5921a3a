// Shortest paths: judged by coordinates, as long as the field says, the same in both directions.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>

#include "support/good_paths.h"
#include "support/shared_meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace brushfire {
namespace {

TEST(Path, OnShapesIsJudgedGoodAndAsLongAsTheFieldSays) {
  test::expect_good_paths(shapes::plane(9, 7).mesh(), 60, 1, "plane");
  test::expect_good_paths(shapes::cube(3).mesh(), 60, 2, "cube");
  test::expect_good_paths(shapes::saddle(10).mesh(), 60, 3, "saddle");
  test::expect_good_paths(shapes::torus(20, 10).mesh(), 60, 4, "torus");
  test::expect_good_paths(shapes::folded_sphere(3).mesh(), 60, 5, "folded sphere");
  test::expect_good_paths(shapes::book(5, 4, 4).mesh(), 60, 6, "book");
  test::expect_good_paths(shapes::noise_terrain(20, 20, 0.5).mesh(), 60, 7, "terrain");
}

// Two faces without area over one edge: their third corners lie at one place of it, and no edge joins them.
TEST(Path, CrossesAnEdgeBetweenTwoVerticesAtOnePlaceOfIt) {
  const Shape shape{{{-0.75, -0.5, 0}, {-1, 0, 0}, {0, -2, 0}, {-0.75, -0.5, 0}, {-2, -1, 0}, {1, 1, 0}},
                    {{0, 2, 1}, {3, 1, 2}, {0, 1, 4}, {3, 5, 1}}};
  const Mesh mesh = shape.mesh();
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  for (const Index v : {0u, 3u}) {
    const Index other = 3 - v, behind = v == 0 ? 5 : 4;
    const std::vector<Source> sources{{vertex_point(mesh, v)}};
    const DistanceField field = distance(mesh, sources, options);
    EXPECT_EQ(field.distance[other], 0);
    EXPECT_EQ(path_to(*field.windows, vertex_point(mesh, other)).length, 0);
    const SurfacePath path = path_to(*field.windows, vertex_point(mesh, behind));
    EXPECT_EQ(test::judge(mesh, path), "");
    EXPECT_NEAR(path.length, field.distance[behind], 1e-14);
  }
}

// On a grid many lines run over vertices exactly, some of them to a target on an edge from a corner of the face beyond.
TEST(Path, ToEdgePointsByEitherNameOverVerticesExactlyIsJudgedGood) {
  const Mesh mesh = shapes::plane(5, 4).mesh();
  PathFinder finder(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const SurfacePoint from = vertex_point(mesh, v);
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      SurfacePoint to{h / 3, {0, 0, 0}};
      to.weights[h % 3] = to.weights[Mesh::next(h) % 3] = 0.5;
      const SurfacePath path = finder.between(from, to);
      ASSERT_EQ(test::judge(mesh, path), "") << "vertex " << v << ", halfedge " << h;
      ASSERT_NEAR(path.length, norm(test::place(mesh, to) - mesh.positions()[v]), 1e-14);
    }
  }
}

// A ray that passes a vertex at 1e-9 of an edge goes on from the vertex; the length is counted up to there.
TEST(Path, PastVerticesOfANearlyFlatGridIsAsLongAsTheStraightLine) {
  const Mesh mesh = shapes::plane(30, 20, 1, 1e-4).mesh();
  const Source source{{mesh.face_count() / 2, {0, 0.5, 0.5}}};
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  const DistanceField field = distance(mesh, {&source, 1}, options);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double straight = norm(mesh.positions()[v] - position(mesh, source.point));
    EXPECT_NEAR(path_to(*field.windows, vertex_point(mesh, v)).length, straight, 1e-13) << "vertex " << v;
  }
}

TEST(Path, OnScansAndDirtyMeshesIsJudgedGood) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const std::string& name : test::shared_mesh_names()) {
    const Mesh mesh = test::shared_mesh(name);
    if (mesh.vertex_count() < 20000) test::expect_good_paths(mesh, 2, 8, name);
  }
}

TEST(Path, BetweenAPointAndItselfIsThePoint) {
  const Mesh mesh = shapes::cube(2).mesh();
  const SurfacePoint p{3, {0.2, 0.3, 0.5}};
  const SurfacePath path = PathFinder(mesh).between(p, p);
  EXPECT_EQ(path.points.size(), 1u);
  EXPECT_EQ(path.length, 0);
}

TEST(Path, AcrossTheDiagonalOfABoxMatchesTheUnfoldedBox) {
  // From a corner of the unit cube to the opposite one: over two faces laid flat, a 1 x 2 rectangle.
  const Shape cube = shapes::cube(4);
  const Mesh mesh = cube.mesh();
  Index a = 0, b = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions()[v] == Vec3{0, 0, 0}) a = v;
    if (mesh.positions()[v] == Vec3{1, 1, 1}) b = v;
  }
  EXPECT_NEAR(PathFinder(mesh).between(vertex_point(mesh, a), vertex_point(mesh, b)).length, std::sqrt(5.0), 1e-14);
}

TEST(Path, ThroughWaypointsIsTheSumOfItsPiecesAndRepeatsNoPoint) {
  const Mesh mesh = shapes::torus(20, 10).mesh();
  const std::vector<SurfacePoint> waypoints{vertex_point(mesh, 3), vertex_point(mesh, 77), vertex_point(mesh, 77),
                                            vertex_point(mesh, 140)};
  PathFinder finder(mesh);
  const double sum =
      finder.between(waypoints[0], waypoints[1]).length + finder.between(waypoints[2], waypoints[3]).length;
  const SurfacePath open = finder.through(waypoints);
  EXPECT_NEAR(open.length, sum, 1e-12);
  EXPECT_NEAR(length_of(mesh, open.points), open.length, 1e-12);
  const SurfacePath closed = finder.through(waypoints, true);
  EXPECT_NEAR(closed.length, sum + finder.between(waypoints[3], waypoints[0]).length, 1e-12);
  EXPECT_NEAR(length_of(mesh, closed.points, true), closed.length, 1e-12);
}

TEST(Path, ThereAndBackAgainIsTwiceAsLong) {
  const Mesh mesh = shapes::saddle(8).mesh();
  const SurfacePoint a = vertex_point(mesh, 0), b = vertex_point(mesh, 44);
  const std::vector<SurfacePoint> waypoints{a, b, a};
  PathFinder finder(mesh);
  EXPECT_NEAR(finder.through(waypoints).length, 2 * finder.between(a, b).length, 1e-13);
}

TEST(Path, ToAnotherComponentIsInfiniteAndHasNoPoints) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {3, 4, 5}};
  const Mesh mesh(positions, faces);
  const SurfacePath path = PathFinder(mesh).between(vertex_point(mesh, 0), vertex_point(mesh, 4));
  EXPECT_TRUE(path.points.empty());
  EXPECT_EQ(path.length, kInfinity);
}

TEST(Path, GoesToTheNearestOfSeveralSources) {
  const Mesh mesh = shapes::plane(10, 10).mesh();
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  const std::vector<Source> sources{{vertex_point(mesh, 0)}, {vertex_point(mesh, 120)}};
  const DistanceField field = distance(mesh, sources, options);
  for (Index v = 0; v < mesh.vertex_count(); v += 7) {
    const SurfacePath path = path_to(*field.windows, vertex_point(mesh, v));
    const Vec3 start = test::place(mesh, path.points.front());
    EXPECT_EQ(start, mesh.positions()[field.source[v] == 0 ? 0 : 120]);
    EXPECT_NEAR(path.length, field.distance[v], 1e-14);
  }
}

TEST(Path, AlongEdgesIsADijkstraPathOfTheFieldsLength) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  DistanceOptions options;
  options.method = Method::Dijkstra;
  const Source source{vertex_point(mesh, 5)};
  const DistanceField field = distance(mesh, std::span(&source, 1), options);
  for (Index v = 0; v < mesh.vertex_count(); v += 31) {
    const SurfacePath path = edge_path_to(mesh, field, v);
    EXPECT_NEAR(path.length, field.distance[v], 1e-12);
    EXPECT_NEAR(length_of(mesh, path.points), path.length, 1e-12);
    EXPECT_EQ(locate(mesh, path.points.front()).vertex, 5u);
    EXPECT_EQ(locate(mesh, path.points.back()).vertex, v);
  }
  const DistanceField other = distance(mesh, std::span(&source, 1), {});
  EXPECT_THROW(edge_path_to(mesh, other, 0), Error);
}

TEST(Path, OffASparseFieldIsThatOffAFullOne) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  DistanceSolver solver(mesh);
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  for (const double radius : {0.15, 0.5, kInfinity}) {
    options.max_distance = radius;
    const Source source{{300, {0.2, 0.3, 0.5}}};
    const SparseField sparse = solver.distance_sparse(std::span(&source, 1), options);
    const DistanceField full = solver.distance(std::span(&source, 1), options);
    ASSERT_GT(sparse.vertex.size(), 3U) << radius;
    for (const Index v : sparse.vertex) {
      const SurfacePath a = path_to(*sparse.windows, vertex_point(mesh, v));
      const SurfacePath b = path_to(*full.windows, vertex_point(mesh, v));
      ASSERT_EQ(a.length, b.length) << v;
      ASSERT_EQ(a.points.size(), b.points.size()) << v;
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double value = sparse.windows->value(vertex_point(mesh, v)).distance;
      ASSERT_EQ(value, full.windows->value(vertex_point(mesh, v)).distance) << v;
    }
  }
}

TEST(Path, ToSeveralTargetsComesFromTheNearestSource) {
  const Mesh mesh = shapes::plane(8, 8, 4, 4).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 0)}, {vertex_point(mesh, 80), 1.0}};
  const std::vector<SurfacePoint> targets{vertex_point(mesh, 1), vertex_point(mesh, 79), vertex_point(mesh, 40)};
  DistanceSolver solver(mesh);
  const std::vector<SourcePath> paths = paths_to(solver, sources, targets);
  const double half = std::sqrt(8.0);
  EXPECT_EQ(paths[0].source, 0u);
  EXPECT_NEAR(paths[0].length, 0.5, 1e-15);
  EXPECT_EQ(paths[1].source, 1u);
  EXPECT_NEAR(paths[1].length, 0.5, 1e-15);  // without the offset
  EXPECT_EQ(paths[2].source, 0u);
  EXPECT_NEAR(paths[2].length, half, 1e-14);
  DistanceOptions near;
  near.max_distance = 2;
  const std::vector<SourcePath> within = paths_to(solver, sources, targets, near);
  EXPECT_EQ(within[0].length, paths[0].length);
  EXPECT_TRUE(within[2].points.empty());
  EXPECT_EQ(within[2].source, kNoIndex);
}

TEST(Path, ThroughWaypointsIsNoneBeyondTheLimitOfTheWhole) {
  const Mesh mesh = shapes::plane(8, 8, 4, 4).mesh();
  DistanceSolver solver(mesh);
  const std::vector<SurfacePoint> waypoints{vertex_point(mesh, 0), vertex_point(mesh, 2), vertex_point(mesh, 5)};
  DistanceOptions how;
  how.max_distance = 2.5;
  EXPECT_NEAR(path_through(solver, waypoints, false, how).length, 2.5, 1e-14);
  how.max_distance = 2.4;
  EXPECT_TRUE(path_through(solver, waypoints, false, how).points.empty());
  EXPECT_EQ(path_through(solver, waypoints, false, how).length, kInfinity);
}

}  // namespace
}  // namespace brushfire
