// Cases that users of other programs reported, each with its expected answer.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brushfire {
namespace {

// The methods that are exact where one source lies in a flat convex region.
constexpr std::array kExactInThePlane{Method::NovotniKlein, Method::Exact};
constexpr double kRounding = 1e-12;

Source at_vertex(const Mesh& mesh, Index v) { return {vertex_point(mesh, v)}; }

DistanceField field_of(const Mesh& mesh, const std::vector<Source>& sources, Method method,
                       std::vector<SurfacePoint> targets = {}, double max_distance = kInfinity) {
  DistanceOptions options;
  options.method = method;
  options.precision = Precision::Double;
  options.targets = std::move(targets);
  options.max_distance = max_distance;
  return distance(mesh, sources, options);
}

void expect_distances(const Mesh& mesh, Index source, const std::vector<double>& expected) {
  for (const Method method : kExactInThePlane) {
    const DistanceField field = field_of(mesh, {at_vertex(mesh, source)}, method);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (expected[v] == kInfinity) {
        EXPECT_EQ(field.distance[v], kInfinity) << name_of(method) << ", vertex " << v;
      } else {
        EXPECT_NEAR(field.distance[v], expected[v], kRounding * expected[v]) << name_of(method) << ", vertex " << v;
      }
    }
  }
}

TEST(ReportedCases, OneRightTriangleHasItsLegsAndHypotenuse) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 2}});
  expect_distances(mesh, 0, {0, 1, 1});
  expect_distances(mesh, 1, {1, 0, std::sqrt(2.0)});
}

TEST(ReportedCases, RhombusWithDiagonals2And6GivesItsSideAndItsShortDiagonalHoweverItIsSplit) {
  const std::vector<Vec3> p{{0, -1, 0}, {3, 0, 0}, {0, 1, 0}, {-3, 0, 0}};
  const double side = std::sqrt(10.0);  // 3.1623
  expect_distances(Mesh(p, std::vector<Face>{{0, 1, 2}, {0, 2, 3}}), 0, {0, side, 2, side});
  expect_distances(Mesh(p, std::vector<Face>{{0, 1, 3}, {1, 2, 3}}), 0, {0, side, 2, side});
}

TEST(ReportedCases, TheDiagonalOfAFlatGridIsTheSquareRootOfTwoWhicheverWayItIsSplit) {
  const Mesh mesh = shapes::plane(10, 10).mesh();
  for (const Method method : kExactInThePlane) {
    EXPECT_NEAR(field_of(mesh, {at_vertex(mesh, 0)}, method).distance[120], std::sqrt(2.0), kRounding);
    EXPECT_NEAR(field_of(mesh, {at_vertex(mesh, 10)}, method).distance[110], std::sqrt(2.0), kRounding);
  }
}

TEST(ReportedCases, TheOtherComponentAndTheIsolatedVertexAreInfinitelyFar) {
  const std::vector<Vec3> p{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {9, 0, 0}, {10, 0, 0}, {9, 1, 0}, {0, 0, 1}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 2}, {3, 4, 5}});
  expect_distances(mesh, 0, {0, 3, 4, kInfinity, kInfinity, kInfinity, kInfinity});
  for (const Method method : all_methods()) {
    const DistanceField field = field_of(mesh, {at_vertex(mesh, 0)}, method, {vertex_point(mesh, 4)});
    EXPECT_EQ(field.target_distance[0], kInfinity);
    EXPECT_EQ(field.unreachable, 4u);
    EXPECT_EQ(field.source[6], kNoIndex);
  }
}

TEST(ReportedCases, NeedlesAndCapsGiveFiniteDistancesThatAreRight) {
  // Vertices 1 and 2 are one place; vertex 4 lies on the line from 0 to 3.
  const std::vector<Vec3> p{{0, 0, 0}, {1, 1, 0}, {1, 1, 0}, {4, 0, 0}, {2, 0, 0}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 2}, {0, 4, 1}, {4, 3, 2}, {4, 2, 1}, {0, 3, 4}});
  expect_distances(mesh, 0, {0, std::sqrt(2.0), std::sqrt(2.0), 4, 2});
}

TEST(ReportedCases, BowTiesBooksAndDuplicatesGiveTheDistancesOfTheGivenComplex) {
  // Two triangles that share vertex 2 only: the way leads through it.
  const std::vector<Vec3> p{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 1}};
  expect_distances(Mesh(p, std::vector<Face>{{0, 2, 1}, {2, 3, 4}}), 0, {0, 1, 1, 2, 1 + std::sqrt(2.0), kInfinity});
  // Three pages on the edge 0-2, and every face twice, once the other way round.
  const std::vector<Face> book{{0, 2, 1}, {2, 0, 5}, {0, 2, 4}, {0, 1, 2}, {2, 0, 5}, {0, 4, 2}};
  expect_distances(Mesh(p, book), 0, {0, 1, 1, kInfinity, std::sqrt(5.0), std::sqrt(2.0)});
}

TEST(ReportedCases, ASourceAtAVertexGivenWithATinyNegativeWeightIsTheVertex) {
  const Mesh mesh = shapes::plane(6, 6).mesh();
  const Face t = mesh.faces()[20];
  for (const Method method : all_methods()) {
    const DistanceField direct = field_of(mesh, {at_vertex(mesh, t[1])}, method);
    const DistanceField named = field_of(mesh, {{{20, {-5.6e-17, 1, 5.6e-17}}}}, method);
    EXPECT_EQ(direct.distance, named.distance) << name_of(method);
  }
}

TEST(ReportedCases, SourceAndTargetOnOneEdgeAreAsFarApartAsOnTheEdge) {
  const Mesh mesh = shapes::plane(2, 2).mesh();
  for (const Method method : kExactInThePlane) {
    const DistanceField field =
        field_of(mesh, {{{1, {0.25, 0.75, 0}}}}, method, {{1, {0.875, 0.125, 0}}, {1, {0.25, 0.75, 0}}});
    EXPECT_NEAR(field.target_distance[0], 0.625 * mesh.lengths()[3] * mesh.unit(), kRounding) << name_of(method);
    EXPECT_EQ(field.target_distance[1], 0) << name_of(method);
  }
}

TEST(ReportedCases, AllBoundaryVerticesOfAFlatStarAsSourcesGiveTheMinimumOverThem) {
  // A star of 24 boundary vertices at radius 1 and 2 in turn, a ring of 24 at half of that, and the centre.
  std::vector<Vec3> p{{0, 0, 0}};
  std::vector<Face> faces;
  constexpr Index kRays = 24;
  for (Index i = 0; i < 2 * kRays; ++i) {
    const double radius = (i % 2 == 0 ? 1.0 : 1.4) * (i < kRays ? 0.5 : 1.0), angle = 2 * kPi * (i % kRays) / kRays;
    p.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (Index i = 0; i < kRays; ++i) {
    const Index inner = 1 + i, next = 1 + (i + 1) % kRays;
    faces.push_back({0, inner, next});
    faces.push_back({inner, inner + kRays, next + kRays});
    faces.push_back({inner, next + kRays, next});
  }
  const Mesh mesh(p, faces);
  std::vector<Source> sources;
  for (Index i = 0; i < kRays; ++i) sources.push_back(at_vertex(mesh, 1 + kRays + i));
  for (const Method method : kExactInThePlane) {
    const DistanceField field = field_of(mesh, sources, method);
    EXPECT_NEAR(field.distance[0], 1, kRounding) << name_of(method);
    for (Index i = 0; i < kRays; ++i) {
      double least = kInfinity;
      for (const Source& s : sources) least = std::min(least, norm(position(mesh, s.point) - p[1 + i]));
      EXPECT_NEAR(field.distance[1 + i], least, kRounding) << name_of(method);
      EXPECT_EQ(field.distance[1 + kRays + i], 0);
      EXPECT_EQ(field.source[1 + kRays + i], i);
    }
  }
}

TEST(ReportedCases, TinyTrianglesBetweenOrdinaryOnesKeepThePlaneExact) {
  // As marching cubes leaves them: grid lines at uneven places, down to 1e-9 of a cell.
  const std::vector<double> lines{0, 1e-9, 1, 1 + 1e-7, 2, 3, 3 + 1e-9, 4};
  const Index n = static_cast<Index>(lines.size());
  std::vector<Vec3> p;
  std::vector<Face> faces;
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      p.push_back({lines[x], lines[y], 0});
      if (x + 1 == n || y + 1 == n) continue;
      const Index v = y * n + x;
      faces.push_back({v, v + 1, v + n + 1});
      faces.push_back({v, v + n + 1, v + n});
    }
  }
  const Mesh mesh(p, faces);
  for (const Method method : kExactInThePlane) {
    for (const Index source : {0u, 9u, 35u}) {
      const DistanceField field = field_of(mesh, {at_vertex(mesh, source)}, method);
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_NEAR(field.distance[v], norm(p[v] - p[source]), 1e-11 * 4) << name_of(method);
      }
    }
  }
}

TEST(ReportedCases, FarFromTheOriginAndTinyTheFieldOnlyScales) {
  const Shape shape = shapes::noise_terrain(12, 12);
  const Mesh mesh(shape.positions, shape.faces);
  for (const Method method : all_methods()) {
    const DistanceField original = field_of(mesh, {at_vertex(mesh, 0)}, method);
    for (const auto& [scale, offset] : {std::pair{1.0, 1e6}, std::pair{1e-6, 0.0}, std::pair{1e-6, 1.0}}) {
      std::vector<Vec3> positions = shape.positions;
      for (Vec3& p : positions) p = scale * p + Vec3{offset, -offset, offset};
      const Mesh moved(positions, shape.faces);
      const DistanceField field = field_of(moved, {at_vertex(moved, 0)}, method);
      // Adding the offset rounds the coordinates; the method's own jumps between equal ways come on top.
      const double tolerance = (method == Method::Exact || method == Method::Dijkstra ? 1e-7 : 0.01) * scale;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        ASSERT_NEAR(field.distance[v], scale * original.distance[v], tolerance) << name_of(method) << " " << offset;
      }
    }
  }
}

TEST(ReportedCases, TriangleSoupIsCalledSoup) {
  const Shape grid = shapes::plane(5, 5);
  std::vector<Vec3> p;
  std::vector<Face> faces;
  for (const Face& t : grid.faces) {
    const Index n = static_cast<Index>(p.size());
    for (const Index v : t) p.push_back(grid.positions[v]);
    faces.push_back({n, n + 1, n + 2});
  }
  const Mesh mesh(p, faces);
  ASSERT_TRUE(mesh.report().looks_like_soup);
  EXPECT_NE(mesh.report().remarks().front().find("weld"), std::string::npos);
  for (const Method method : all_methods()) EXPECT_EQ(field_of(mesh, {at_vertex(mesh, 0)}, method).reached, 3u);
}

TEST(ReportedCases, ATargetThatIsTheSourceIsAtZero) {
  const Mesh mesh = shapes::icosphere(2).mesh();
  const SurfacePoint inside{7, {0.2, 0.3, 0.5}};
  for (const Method method : all_methods()) {
    const DistanceField field = field_of(mesh, {{inside}, at_vertex(mesh, 3)}, method, {inside, vertex_point(mesh, 3)});
    EXPECT_EQ(field.target_distance[1], 0) << name_of(method);
    EXPECT_EQ(field.target_source[1], 1u) << name_of(method);
    if (method == Method::Dijkstra) continue;  // knows edges and corners only
    EXPECT_EQ(field.target_distance[0], 0) << name_of(method);
    EXPECT_EQ(field.target_source[0], 0u) << name_of(method);
  }
}

TEST(ReportedCases, AnEmptySourceListIsAnError) {
  const Mesh mesh = shapes::icosphere(1).mesh();
  for (const Method method : all_methods()) {
    try {
      field_of(mesh, {}, method);
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
    }
  }
}

TEST(ReportedCases, RadiusZeroReachesTheSourcesOnly) {
  const Mesh mesh = shapes::icosphere(2).mesh();
  for (const Method method : all_methods()) {
    const DistanceField field = field_of(mesh, {at_vertex(mesh, 5), at_vertex(mesh, 60)}, method, {}, 0);
    EXPECT_EQ(field.reached, 2u) << name_of(method);
    for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(field.distance[v], v == 5 || v == 60 ? 0 : kInfinity);
  }
}

TEST(ReportedCases, AnIndexThatDoesNotExistIsAnErrorThatNamesIt) {
  const Mesh mesh = shapes::icosphere(1).mesh();
  try {
    vertex_point(mesh, 4711);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::IndexOutOfRange);
    EXPECT_NE(std::string(e.what()).find("4711"), std::string::npos);
  }
  const Source source{{4712, {1, 0, 0}}};
  EXPECT_THROW(distance(mesh, {&source, 1}), Error);
}

}  // namespace
}  // namespace brushfire
