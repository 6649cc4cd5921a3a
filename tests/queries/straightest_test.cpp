// Straightest geodesics and the logarithmic map.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/log_coordinates.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/straightest.h>

#include "support/path_checker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire {
namespace {

using test::place;

double uniform(std::mt19937& random) { return (static_cast<double>(random() % 1000000) + 0.5) / 1000000; }

TEST(Straightest, OnAPlaneIsTheStraightLine) {
  const Mesh mesh = shapes::plane(16, 16, 4, 4).mesh();
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    const SurfacePoint from = vertex_point(mesh, 8 * 17 + 8);
    const double a = 2 * kPi * uniform(random), length = 1.9 * uniform(random);
    const double angle = angle_of(mesh, from, {std::cos(a), std::sin(a), 0});
    const Trace trace = straightest(mesh, from, angle, length);
    EXPECT_EQ(trace.end, TraceEnd::Length);
    const Vec3 end = place(mesh, trace.path.points.back());
    EXPECT_NEAR(norm(end - Vec3{2 + length * std::cos(a), 2 + length * std::sin(a), 0}), 0, 1e-13);
    EXPECT_NEAR(trace.path.length, length, 1e-14);
    EXPECT_EQ(test::judge(mesh, trace.path), "");
  }
}

TEST(Straightest, FromEdgesAndFacesOnAPlaneIsTheStraightLine) {
  const Mesh mesh = shapes::plane(16, 16, 4, 4).mesh();
  std::mt19937 random(8);
  for (int i = 0; i < 300; ++i) {
    const SurfacePoint from{2 * (8 * 16 + 8), i % 2 == 0 ? std::array{0.3, 0.7, 0.0} : std::array{0.2, 0.5, 0.3}};
    const double a = 2 * kPi * uniform(random), length = 1.7 * uniform(random);
    const Trace trace = straightest(mesh, from, angle_of(mesh, from, {std::cos(a), std::sin(a), 0}), length);
    const Vec3 end = place(mesh, trace.path.points.back()), begin = place(mesh, from);
    EXPECT_NEAR(norm(end - begin - length * Vec3{std::cos(a), std::sin(a), 0}), 0, 1e-13) << i;
  }
}

TEST(Straightest, OnACylinderIsTheUnrolledLine) {
  const Index segments = 24;
  const double height = 10;
  const Mesh mesh = shapes::cylinder(12, segments, 1, height).mesh();
  const double side = 2 * std::sin(kPi / segments);  // one segment's width, laid flat
  std::mt19937 random(9);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint from = vertex_point(mesh, 6 * segments + 5);
    const double rise = 4.5 * (2 * uniform(random) - 1), run = 30 * (2 * uniform(random) - 1);
    // The direction in the plane of the face to the right: along the chord, and up.
    const Vec3 chord = mesh.positions()[6 * segments + 6] - mesh.positions()[6 * segments + 5];
    const Vec3 back = mesh.positions()[6 * segments + 4] - mesh.positions()[6 * segments + 5];
    const Vec3 across = run > 0 ? (1 / side) * chord : (1 / side) * back;
    const double angle = angle_of(mesh, from, std::abs(run) * across + Vec3{0, 0, rise});
    const Trace trace = straightest(mesh, from, angle, std::hypot(rise, run));
    ASSERT_EQ(trace.end, TraceEnd::Length);
    const Vec3 end = place(mesh, trace.path.points.back());
    EXPECT_NEAR(end.z, height / 2 + rise, 1e-11);
    const double steps = 5 + run / side, whole = std::floor(steps), part = steps - whole;
    const auto corner = [&](double k) {
      return Vec3{std::cos(k * 2 * kPi / segments), std::sin(k * 2 * kPi / segments), end.z};
    };
    const Vec3 expected = (1 - part) * corner(whole) + part * corner(whole + 1);
    EXPECT_NEAR(norm(end - expected), 0, 1e-10) << "rise " << rise << ", run " << run;
  }
}

TEST(Straightest, EndsAtTheBoundary) {
  const Mesh mesh = shapes::plane(4, 4).mesh();
  const SurfacePoint from = vertex_point(mesh, 12);
  const Trace trace = straightest(mesh, from, angle_of(mesh, from, {1, 0.1, 0}), 5);
  EXPECT_EQ(trace.end, TraceEnd::Boundary);
  EXPECT_NEAR(place(mesh, trace.path.points.back()).x, 1, 1e-15);
  EXPECT_LT(trace.path.length, 5);
}

TEST(Straightest, EndsAtAnEdgeOfThreeFaces) {
  const Mesh mesh = shapes::book(3, 2, 2).mesh();
  std::mt19937 random(10);
  int stopped = 0;
  for (int i = 0; i < 100; ++i) {
    const SurfacePoint from{static_cast<Index>(random() % mesh.face_count()), {0.3, 0.4, 0.3}};
    const Trace trace = straightest(mesh, from, 7 * uniform(random), 10);
    EXPECT_NE(trace.end, TraceEnd::Length);
    stopped += trace.end == TraceEnd::NonManifold;
  }
  EXPECT_GT(stopped, 10);
}

TEST(Straightest, CrossesVerticesWithEqualAnglesOnBothSides) {
  // Straight at the corner of a cube: three right angles, so 135 degrees on either side.
  const Mesh mesh = shapes::cube(1).mesh();
  for (Index v = 0; v < 8; ++v) {
    for (const Index h : mesh.corners(v)) {
      const SurfacePoint from{Mesh::face_of(h), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
      const Vec3 to = mesh.positions()[v] - place(mesh, from);
      const Trace trace = straightest(mesh, from, angle_of(mesh, from, to), norm(to) + 0.3);
      ASSERT_EQ(trace.end, TraceEnd::Length);
      ASSERT_GE(trace.path.points.size(), 3u);
      ASSERT_NEAR(norm(place(mesh, trace.path.points[1]) - mesh.positions()[v]), 0, 1e-12);
      const auto holding = [&](const SurfacePoint& p) {
        return test::faces_holding(mesh, test::support_of(mesh, p), test::support_of(mesh, vertex_point(mesh, v)));
      };
      const SurfacePoint& after = trace.path.points[2];
      const double angle =
          test::angle_around(mesh, v, holding(from), place(mesh, from), holding(after), place(mesh, after));
      EXPECT_NEAR(angle, 0.75 * kPi, 1e-9);
    }
  }
}

TEST(Straightest, OnASphereApproachesTheGreatCircleWithTheMeshSize) {
  double last = 1;
  for (const Index level : {3u, 4u, 5u}) {
    const Mesh mesh = shapes::icosphere(level).mesh();
    double worst = 0;
    for (int i = 0; i < 20; ++i) {
      const SurfacePoint from{static_cast<Index>(17 * i) % mesh.face_count(), {0.3, 0.3, 0.4}};
      const Vec3 begin = place(mesh, from), up{0.3, -0.5, 0.8 + 0.01 * i};
      const Trace trace = straightest(mesh, from, angle_of(mesh, from, up), kPi / 2);
      // The plane of the great circle that starts the same way.
      const Face& t = mesh.faces()[from.face];
      const Vec3 n =
          cross(mesh.positions()[t[1]] - mesh.positions()[t[0]], mesh.positions()[t[2]] - mesh.positions()[t[0]]);
      const Vec3 tangent = up - (dot(up, n) / dot(n, n)) * n;
      const Vec3 axis = cross(begin, tangent);
      worst = std::max(worst, std::abs(dot(place(mesh, trace.path.points.back()), axis)) / norm(axis));
    }
    EXPECT_LT(worst, 0.65 * last) << "level " << level;  // at least first order in the edge length
    last = worst;
  }
  EXPECT_LT(last, 0.05);
}

TEST(Straightest, BadArgumentsAreErrors) {
  const Mesh mesh = shapes::cube(1).mesh();
  const SurfacePoint p = vertex_point(mesh, 0);
  EXPECT_THROW(straightest(mesh, p, std::nan(""), 1), Error);
  EXPECT_THROW(straightest(mesh, p, 0, -1), Error);
  EXPECT_THROW(straightest(mesh, p, 0, kInfinity), Error);
  EXPECT_THROW(angle_of(mesh, p, {0, 0, 0}), Error);
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const std::vector<Face> bow_tie{{0, 1, 2}, {0, 3, 4}};
  const Mesh tie(positions, bow_tie);
  EXPECT_THROW(straightest(tie, vertex_point(tie, 0), 0, 1), Error);
}

void expect_inverse(const Mesh& mesh, const SurfacePoint& source, double radius, const std::string& name) {
  const LogMap map = log_map(mesh, source, radius);
  int tested = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (map.radius[v] == kInfinity) {
      EXPECT_TRUE(std::isnan(map.angle[v]));
      continue;
    }
    const Trace trace = straightest(mesh, source, map.angle[v], map.radius[v]);
    ASSERT_NEAR(norm(place(mesh, trace.path.points.back()) - mesh.positions()[v]), 0, 1e-9) << name << ", vertex " << v;
    ++tested;
  }
  EXPECT_GT(tested, 5) << name;
}

TEST(LogMap, IsUndoneByTheStraightestGeodesicInsideTheInjectivityRadius) {
  const Mesh plane = shapes::plane(12, 12).mesh();
  expect_inverse(plane, vertex_point(plane, 85), 1, "plane, vertex");
  expect_inverse(plane, {100, {0.5, 0.5, 0}}, 1, "plane, edge");
  expect_inverse(plane, {100, {0.2, 0.5, 0.3}}, 1, "plane, face");
  const Mesh sphere = shapes::icosphere(3).mesh();
  expect_inverse(sphere, vertex_point(sphere, 3), 1.2, "sphere, vertex");
  expect_inverse(sphere, {41, {0.3, 0, 0.7}}, 1.2, "sphere, edge");
  expect_inverse(sphere, {41, {0.3, 0.1, 0.6}}, 1.2, "sphere, face");
  // No saddle vertex within the radius, else angles behind it are its own.
  const Mesh cone = shapes::cone(8, 16).mesh();
  expect_inverse(cone, vertex_point(cone, 0), 1, "cone, apex");
}

TEST(LogMap, OfAPlaneIsItsPolarCoordinates) {
  const Mesh mesh = shapes::plane(8, 8).mesh();
  const SurfacePoint centre = vertex_point(mesh, 40);
  const LogMap map = log_map(mesh, centre);
  EXPECT_NEAR(map.total_angle, 2 * kPi, 1e-14);
  const double zero = angle_of(mesh, centre, {1, 0, 0});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 d = mesh.positions()[v] - mesh.positions()[40];
    EXPECT_NEAR(map.radius[v], norm(d), 1e-14);
    if (v != 40) {
      EXPECT_NEAR(std::remainder(map.angle[v] - zero - std::atan2(d.y, d.x), 2 * kPi), 0, 1e-12);
    }
  }
}

// One solver, discs of many sizes around points of every kind, a field and a path in between.
TEST(LogMap, OfADiscIsToTheBitWhatAFreshSolverGives) {
  const Mesh mesh = shapes::folded_sphere(5).mesh();
  DistanceSolver solver(mesh);
  const std::vector<SurfacePoint> centres{
      vertex_point(mesh, 7), {411, {0.2, 0.5, 0.3}}, {9000, {0.5, 0, 0.5}}, vertex_point(mesh, 7)};
  for (const double radius : {0.05, 0.4, kInfinity, 0.1}) {
    for (const SurfacePoint& centre : centres) {
      const SparseLogMap disc = log_map(solver, centre, radius);
      const LogMap whole = log_map(mesh, centre, radius);
      const auto reached =
          std::count_if(whole.radius.begin(), whole.radius.end(), [](double d) { return d < kInfinity; });
      ASSERT_EQ(disc.vertex.size(), static_cast<std::size_t>(reached)) << radius;
      EXPECT_EQ(disc.total_angle, whole.total_angle);
      for (std::size_t i = 0; i < disc.vertex.size(); ++i) {
        ASSERT_EQ(disc.radius[i], whole.radius[disc.vertex[i]]);
        ASSERT_EQ(disc.angle[i], whole.angle[disc.vertex[i]]);
      }
      const Source source{centre};
      solver.distance(std::span(&source, 1));
      path_between(solver, centre, vertex_point(mesh, 99));
    }
  }
}

// Every angle against the path itself: its first step, as a direction in space.
void expect_angles_of_paths(const Mesh& mesh, const SurfacePoint& source, const std::string& name) {
  const LogMap map = log_map(mesh, source);
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  const Source origin{source};
  const DistanceField field = distance(mesh, std::span(&origin, 1), options);
  const Vec3 here = place(mesh, source);
  int compared = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!(field.distance[v] < kInfinity) || field.distance[v] == 0) continue;
    const SurfacePath path = path_to(*field.windows, vertex_point(mesh, v));
    const double expected = angle_of(mesh, source, place(mesh, path.points[1]) - here);
    ASSERT_NEAR(std::remainder(map.angle[v] - expected, map.total_angle), 0, 1e-9) << name << ", vertex " << v;
    ++compared;
  }
  EXPECT_GT(compared, 10) << name;
}

// Some faces the other way round: angles still count as the source's face runs.
Mesh with_turned_faces(const Shape& shape, std::uint64_t seed) {
  std::vector<Face> faces = shape.faces;
  std::mt19937_64 random(seed);
  for (Face& f : faces) {
    if (random() % 3 == 0) std::swap(f[1], f[2]);
  }
  return Mesh(shape.positions, faces);
}

TEST(LogMap, AnglesAreThoseOfTheShortestPaths) {
  std::mt19937_64 random(11);
  const std::vector<std::pair<std::string, Shape>> kinds{{"plane", shapes::plane(9, 7)},
                                                         {"sphere", shapes::icosphere(3)},
                                                         {"folded", shapes::folded_sphere(4)},
                                                         {"deep folds", shapes::folded_sphere(4, 9, 0.5)},
                                                         {"cube", shapes::cube(3)},
                                                         {"cone", shapes::cone(8, 16)}};
  for (const auto& [name, shape] : kinds) {
    for (const Mesh& mesh : {shape.mesh(), with_turned_faces(shape, 5)}) {
      for (int k = 0; k < 2; ++k) {
        expect_angles_of_paths(mesh, vertex_point(mesh, static_cast<Index>(random() % mesh.vertex_count())), name);
        expect_angles_of_paths(mesh, {static_cast<Index>(random() % mesh.face_count()), {0.2, 0.3, 0.5}}, name);
        // (On an edge, directions in space are those of both its faces in a plane only.)
        if (name == "plane") expect_angles_of_paths(mesh, {mesh.face_count() / 2, {0.4, 0, 0.6}}, name);
      }
    }
  }
}

// From points inside, on edges, on the border and in corners, with faces either way round.
TEST(LogMap, OfAPlaneIsFlatFromEveryPlaceAndDirection) {
  Shape s = shapes::plane(6, 6, 6, 6);
  for (const bool turned : {false, true}) {
    if (turned) {
      for (Face& f : s.faces) std::swap(f[1], f[2]);
    }
    const Mesh mesh = s.mesh();
    std::vector<SurfacePoint> places{{17, {0.2, 0.3, 0.5}}, {17, {0.5, 0.5, 0}}};
    for (const Index v : {0, 6, 42, 48, 3, 21, 24}) places.push_back(vertex_point(mesh, v));
    DistanceSolver solver(mesh);
    for (const SurfacePoint& source : places) {
      const Vec3 at = position(mesh, source);
      const bool in_corner = (at.x == 0 || at.x == 6) && (at.y == 0 || at.y == 6);
      const Vec3 along = in_corner ? Vec3{3, 3, 0} - at : Vec3{0.6, 0.8, 0};  // onto the surface
      const Vec3 u = (1 / norm(along)) * along;
      SparseLogMap map = log_map(solver, source, 2.5);
      turn(mesh, source, along, map);
      const std::vector<std::array<double, 2>> flat = flat_coordinates(mesh, source, map);
      for (std::size_t i = 0; i < map.vertex.size(); ++i) {
        const Vec3 d = mesh.positions()[map.vertex[i]] - at;
        EXPECT_NEAR(flat[i][0], u.x * d.x + u.y * d.y, 1e-13);
        EXPECT_NEAR(flat[i][1], (turned ? -1 : 1) * (u.x * d.y - u.y * d.x), 1e-13);
      }
    }
  }
}

TEST(Straightest, ADirectionAtRightAnglesToTheSurfaceIsRefused) {
  const Mesh mesh = shapes::plane(2, 2, 4, 4).mesh();
  EXPECT_THROW(angle_of(mesh, vertex_point(mesh, 4), {0, 0, 3}), Error);
  EXPECT_THROW(angle_of(mesh, {0, {0.2, 0.3, 0.5}}, {0, 0, 3}), Error);
  EXPECT_NO_THROW(angle_of(mesh, vertex_point(mesh, 4), {0.001, 0, 3}));
  for (const double scale : {1e297, 1e-300, 5e-324}) {
    EXPECT_EQ(angle_of(mesh, vertex_point(mesh, 4), {scale, scale, 0}),
              angle_of(mesh, vertex_point(mesh, 4), {1, 1, 0}));
  }
}

// Beyond an edge of many faces, two sheets may see the source in the same place by different ways.
TEST(LogMap, AnglesAreThoseOfTheShortestPathsOnManySheets) {
  for (const Index pages : {3u, 4u}) {
    const Mesh book = shapes::book(pages, 6, 5).mesh();
    for (Index f = 2; f < book.face_count(); f += 17) expect_angles_of_paths(book, {f, {0.25, 0.35, 0.4}}, "book");
  }
  Shape twice = shapes::folded_sphere(3);
  const std::vector<Face> once = twice.faces;
  for (const Face& f : once) twice.faces.push_back({f[1], f[2], f[0]});
  expect_angles_of_paths(twice.mesh(), {40, {0.2, 0.3, 0.5}}, "twice");
}

TEST(LogMap, AnglesLieWithinTheFullTurn) {
  const std::vector<Mesh> meshes{shapes::plane(8, 8).mesh(), shapes::cone(8, 12, 1, 0.5).mesh(),
                                 shapes::saddle(8).mesh()};
  for (const Mesh& mesh : meshes) {
    for (Index v = 0; v < mesh.vertex_count(); v += 5) {
      const LogMap map = log_map(mesh, vertex_point(mesh, v));
      for (const double angle : map.angle) {
        ASSERT_GE(angle, 0);
        ASSERT_LE(angle, map.total_angle);
      }
    }
    expect_angles_of_paths(mesh, vertex_point(mesh, 0), "corner or apex");
  }
}

}  // namespace
}  // namespace brushfire
