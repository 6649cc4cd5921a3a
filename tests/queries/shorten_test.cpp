// Shortening polylines: straight where nothing is in the way, around what is, within the homotopy class.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/shorten.h>
#include <brushfire/solvers/distance.h>

#include "support/holes.h"
#include "support/path_checker.h"
#include "support/shared_meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace brushfire {
namespace {

Index any_vertex(const Mesh& mesh, std::mt19937& random) { return static_cast<Index>(random() % mesh.vertex_count()); }

// A walk along edges, never straight back, `steps` long.
std::vector<SurfacePoint> random_walk(const Mesh& mesh, Index from, int steps, std::mt19937& random) {
  std::vector<SurfacePoint> points{vertex_point(mesh, from)};
  Index here = from, before = kNoIndex;
  for (int i = 0; i < steps; ++i) {
    const auto corners = mesh.corners(here);
    Index next = before;
    for (int attempt = 0; next == before && attempt < 20; ++attempt) {
      const Index h = corners[random() % corners.size()];
      next = random() % 2 == 0 ? mesh.to(h) : mesh.from(Mesh::previous(h));
    }
    points.push_back(vertex_point(mesh, next));
    before = here;
    here = next;
  }
  return points;
}

// The point at share t of the edge from a to b; no face where there is no such edge.
SurfacePoint on_edge(const Mesh& mesh, Index a, Index b, double t) {
  SurfacePoint p;
  for (const Index corner : mesh.corners(a)) {
    for (const Index h : {corner, Mesh::previous(corner)}) {
      if (mesh.from(h) + mesh.to(h) != a + b || (mesh.from(h) != b && mesh.to(h) != b)) continue;
      p = {Mesh::face_of(h), {0, 0, 0}};
      p.weights[h % 3] = mesh.from(h) == a ? 1 - t : t;
      p.weights[Mesh::next(h) % 3] = mesh.from(h) == a ? t : 1 - t;
    }
  }
  return p;
}

std::vector<SurfacePoint> vertices(const Mesh& mesh, std::initializer_list<Index> list) {
  std::vector<SurfacePoint> points;
  for (const Index v : list) points.push_back(vertex_point(mesh, v));
  return points;
}

TEST(Shorten, AnyWalkOnAPlaneBecomesTheStraightLine) {
  std::mt19937 random(5);
  const Mesh mesh = shapes::plane(20, 20).mesh();
  for (int i = 0; i < 200; ++i) {
    const Index from = any_vertex(mesh, random);
    const std::vector<SurfacePoint> walk = random_walk(mesh, from, 1 + static_cast<int>(random() % 60), random);
    const SurfacePath path = shorten(mesh, walk);
    const double straight = norm(test::place(mesh, walk.back()) - test::place(mesh, walk.front()));
    ASSERT_NEAR(path.length, straight, 1e-13) << "walk " << i;
    ASSERT_EQ(test::judge(mesh, path), "") << "walk " << i;
  }
}

TEST(Shorten, PathThroughPointsInsideFacesForgetsThem) {
  const Mesh mesh = shapes::plane(2, 1).mesh();
  const std::vector<SurfacePoint> bent{{0, {1, 0, 0}}, {0, {0.2, 0.7, 0.1}}, {0, {0, 0.9, 0.1}}};
  const SurfacePath path = shorten(mesh, bent);
  EXPECT_EQ(path.points.size(), 2u);
  EXPECT_NEAR(path.length, norm(test::place(mesh, bent[2]) - test::place(mesh, bent[0])), 1e-15);
}

TEST(Shorten, PathAroundAHoleStaysOnItsSideAndHugsTheCorner) {
  // 3 x 3 squares without the middle one: from the middle of the left side to that of the right, below or above.
  const Mesh mesh = test::with_faces(shapes::plane(3, 3, 3, 3), [](Vec3 centre) {
    return std::abs(centre.x - 1.5) > 0.5 || std::abs(centre.y - 1.5) > 0.5;
  });
  const SurfacePath below = shorten(mesh, vertices(mesh, {4, 0, 1, 2, 3, 7}));
  const SurfacePath above = shorten(mesh, vertices(mesh, {4, 8, 12, 13, 14, 15, 11, 7}));
  EXPECT_NEAR(below.length, 3, 1e-14);  // along the row of the hole's lower side
  EXPECT_NEAR(above.length, 1 + 2 * std::sqrt(2.0), 1e-14);
  EXPECT_EQ(test::judge(mesh, below), "");
  EXPECT_EQ(test::judge(mesh, above), "");
}

TEST(Shorten, WalkOverABoxRunsStraightOverItsEdges) {
  const Mesh mesh = shapes::cube(4).mesh();
  std::mt19937 random(11);
  for (int i = 0; i < 100; ++i) {
    const SurfacePath path = shorten(mesh, random_walk(mesh, any_vertex(mesh, random), 25, random));
    ASSERT_EQ(test::judge(mesh, path), "") << "walk " << i;
  }
}

TEST(Shorten, NeverShorterThanTheShortestPathAndNoLongerThanTheWalk) {
  std::mt19937 random(3);
  for (const Shape& shape : {shapes::folded_sphere(3), shapes::torus(24, 12), shapes::saddle(12)}) {
    const Mesh mesh = shape.mesh();
    DistanceSolver solver(mesh);
    for (int i = 0; i < 25; ++i) {
      const Index from = any_vertex(mesh, random);
      const std::vector<SurfacePoint> walk = random_walk(mesh, from, 30, random);
      const SurfacePath path = shorten(mesh, walk);
      ASSERT_EQ(test::judge(mesh, path), "") << "walk " << i;
      DistanceOptions options;
      options.method = Method::Exact;
      options.targets = {walk.back()};
      const Source source{walk.front()};
      const double d = solver.distance(std::span(&source, 1), options).target_distance[0];
      ASSERT_GE(path.length, d * (1 - 1e-12));
      ASSERT_LE(path.length, length_of(mesh, walk) * (1 + 1e-12));
    }
  }
}

TEST(Shorten, ClosedCurveAroundACylinderBecomesItsCircumference) {
  const Index segments = 12;
  const Mesh mesh = shapes::cylinder(6, segments).mesh();
  std::vector<SurfacePoint> zigzag;
  for (Index k = 0; k < segments; ++k) {
    // Up and down by one ring: vertex (ring, segment) = ring * segments + segment.
    zigzag.push_back(vertex_point(mesh, 3 * segments + k));
    zigzag.push_back(vertex_point(mesh, (k % 2 == 0 ? 4 : 2) * segments + k));
    zigzag.push_back(vertex_point(mesh, 3 * segments + k));
  }
  const SurfacePath path = shorten(mesh, zigzag, true);
  EXPECT_TRUE(path.closed);
  EXPECT_NEAR(path.length, segments * 2 * std::sin(kPi / segments), 1e-12);
  EXPECT_EQ(test::judge(mesh, path), "");
}

TEST(Shorten, ClosedCurveThatStartsInsideFacesAroundACylinderBecomesItsCircumference) {
  const Index segments = 10;
  const Mesh mesh = shapes::cylinder(4, segments).mesh();
  // Over every edge between two rings, some way up: verticals and diagonals in turn.
  std::vector<SurfacePoint> curve;
  for (Index k = 0; k < segments; ++k) {
    const Index low = segments + k, high = 2 * segments + k;
    const Index low_next = segments + (k + 1) % segments, high_next = 2 * segments + (k + 1) % segments;
    curve.push_back(on_edge(mesh, low, high, 0.35));
    const SurfacePoint diagonal = on_edge(mesh, low, high_next, 0.6);
    curve.push_back(diagonal.face != kNoIndex ? diagonal : on_edge(mesh, low_next, high, 0.6));
  }
  const SurfacePath path = shorten(mesh, curve, true);
  EXPECT_NEAR(path.length, segments * 2 * std::sin(kPi / segments), 1e-9);
  EXPECT_EQ(test::judge(mesh, path, 1e-4), "");
}

TEST(Shorten, ContractibleLoopPullsTogetherToAPoint) {
  std::mt19937 random(17);
  for (const Shape& shape : {shapes::icosphere(2), shapes::plane(8, 8), shapes::cube(3)}) {
    const Mesh mesh = shape.mesh();
    for (int i = 0; i < 40; ++i) {
      // There and back again by different ways, then closed: on a sphere and a disc everything is contractible.
      std::vector<SurfacePoint> walk = random_walk(mesh, any_vertex(mesh, random), 12, random);
      const SurfacePath back = shorten(mesh, std::vector<SurfacePoint>(walk.rbegin(), walk.rend()));
      walk.insert(walk.end(), back.points.begin() + 1, back.points.end());
      const SurfacePath path = shorten(mesh, walk, true);
      // A closed geodesic can hold on a cube or an icosphere; a plane has none.
      ASSERT_EQ(test::judge(mesh, path, 1e-4), "");
      if (shape.positions.size() == 81) {
        ASSERT_EQ(path.length, 0) << "walk " << i;
      }
    }
  }
}

TEST(Shorten, LoopsAroundATorusKeepTheirHandle) {
  const Index major = 16, minor = 8;
  const Mesh mesh = shapes::torus(major, minor, 1, 0.4).mesh();
  std::vector<SurfacePoint> around, through;
  for (Index i = 0; i < major; ++i) around.push_back(vertex_point(mesh, i * minor));
  for (Index j = 0; j < minor; ++j) through.push_back(vertex_point(mesh, j));
  const SurfacePath hole = shorten(mesh, around, true), tube = shorten(mesh, through, true);
  EXPECT_NEAR(hole.length, major * 2 * 0.6 * std::sin(kPi / major), 1e-9);  // the inner equator
  // Between two meridians the tube is a little thinner: the curve slides there.
  EXPECT_LE(tube.length, minor * 2 * 0.4 * std::sin(kPi / minor));
  EXPECT_GE(tube.length, minor * 2 * 0.4 * std::sin(kPi / minor) * std::cos(kPi / major));
  EXPECT_EQ(test::judge(mesh, hole, 1e-4), "");
  EXPECT_EQ(test::judge(mesh, tube, 1e-4), "");
}

TEST(Shorten, WalkAcrossTheSpineOfABookIsJudgedGood) {
  const Mesh mesh = shapes::book(4, 5, 5).mesh();
  std::mt19937 random(23);
  for (int i = 0; i < 60; ++i) {
    const SurfacePath path = shorten(mesh, random_walk(mesh, any_vertex(mesh, random), 20, random));
    ASSERT_EQ(test::judge(mesh, path), "") << "walk " << i;
  }
}

TEST(Shorten, SinglePointIsAPathOfLengthZero) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  const SurfacePath path = shorten(mesh, vertices(mesh, {4}));
  EXPECT_EQ(path.length, 0);
  EXPECT_EQ(path.points.size(), 1u);
  EXPECT_EQ(shorten(mesh, vertices(mesh, {4, 4, 4})).length, 0);
}

TEST(Shorten, PointsThatShareNoFaceAreAnErrorThatNamesThem) {
  const Mesh mesh = shapes::plane(4, 4).mesh();
  try {
    shorten(mesh, vertices(mesh, {0, 1, 24}));
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("points 1 and 2"), std::string::npos) << e.what();
  }
  EXPECT_THROW(shorten(mesh, {}), Error);
}

TEST(Shorten, WalksOnScansAreJudgedGood) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  std::mt19937 random(29);
  for (const char* name : {"rocker-arm", "fandisk", "cow", "nm-fin", "nm-bowtie"}) {
    const Mesh mesh = test::shared_mesh(name);
    for (int i = 0; i < 10; ++i) {
      Index from = any_vertex(mesh, random);
      while (mesh.corners(from).empty()) from = any_vertex(mesh, random);
      const SurfacePath path = shorten(mesh, random_walk(mesh, from, 80, random));
      ASSERT_EQ(test::judge(mesh, path, 1e-5), "") << name << ", walk " << i;
    }
  }
}

// Over faces that name a vertex twice, which conduct along their edges: there is nothing to cross and go round.
TEST(Shorten, ClosedWalkThereAndBackOverDegenerateFacesPullsTogether) {
  const std::vector<Vec3> positions{{1, 2.098249616101384, 3.1122733149677515},
                                    {0, 0.5480647776275873, 3.94677866040729},
                                    {3, 1, 0.9489168550353497},
                                    {3.940353937447071, 2.768662933493033, 1},
                                    {0.5277850760612637, 2.3478644769638777, 1},
                                    {3, 2.7676450989674777, 3}};
  const std::vector<Face> faces{{5, 1, 0}, {4, 5, 5}, {5, 4, 5}, {5, 3, 4}, {0, 2, 1},
                                {5, 0, 3}, {0, 3, 5}, {4, 4, 4}, {1, 4, 4}};
  const std::vector<SurfacePoint> walk{{0, {0, 0, 1}}, {1, {0, 0, 1}}, {3, {0, 0, 1}}, {0, {1, 0, 0}}};
  EXPECT_NEAR(shorten(Mesh(positions, faces), walk, true).length, 0, 1e-9);
}

}  // namespace
}  // namespace brushfire
