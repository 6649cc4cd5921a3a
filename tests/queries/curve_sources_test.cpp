// Boundaries and regions as sources, on planes, where distances from them are known.
#include <brushfire/core/error.h>
#include <brushfire/mesh/boundaries.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/curve_sources.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire {
namespace {

constexpr Index kColumns = 7, kRows = 6;

Mesh plane() { return shapes::plane(kColumns, kRows, kColumns, kRows).mesh(); }

double to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return norm(p - (a + t * along));
}

std::vector<double> distances_from(const Mesh& mesh, CurveSource curve) {
  const std::vector<Source> sources{source_along(std::move(curve))};
  return distance(mesh, sources, {.method = Method::Exact}).distance;
}

// The least distance of each vertex from the segments; from a vertex as a segment of no length.
std::vector<double> by_hand(const Mesh& mesh, const std::vector<std::array<Index, 2>>& segments) {
  std::vector<double> least(mesh.vertex_count(), kInfinity);
  const auto p = mesh.positions();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    for (const auto& [a, b] : segments) least[v] = std::min(least[v], to_segment(p[v], p[a], p[b]));
  }
  return least;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t v = 0; v < found.size(); ++v) EXPECT_NEAR(found[v], expected[v], 1e-12) << what << " vertex " << v;
}

std::size_t pieces(const CurveSource& curve) {
  return 1 + static_cast<std::size_t>(std::count_if(curve.places.begin(), curve.places.end(),
                                                    [](const SurfacePoint& p) { return p.is_nowhere(); }));
}

TEST(CurveSources, TheBoundaryIsAsFarAsTheNearestSide) {
  const Mesh mesh = plane();
  const std::vector<double> found = distances_from(mesh, curve_source(mesh, boundaries(mesh)));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.positions()[v];
    EXPECT_NEAR(found[v], std::min({p.x, p.y, kColumns - p.x, kRows - p.y}), 1e-12) << v;
  }
}

TEST(CurveSources, ARegionOfVerticesHasTheEdgesAndFacesBetweenThem) {
  const Mesh mesh = plane();
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> in(mesh.vertex_count());
    for (std::uint8_t& v : in) v = random() % 100 < 10 + seed * 2;
    in[random() % in.size()] = 1;
    std::vector<std::array<Index, 2>> segments;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (in[v]) segments.push_back({v, v});
    }
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      if (in[mesh.from(h)] && in[mesh.to(h)]) segments.push_back({mesh.from(h), mesh.to(h)});
    }
    const std::string what = "seed " + std::to_string(seed);
    expect_near(distances_from(mesh, region_of_vertices(mesh, in)), by_hand(mesh, segments), what);
  }
}

TEST(CurveSources, ARegionOfFacesIsZeroInsideAndStartsAtItsBorder) {
  const Mesh mesh = plane();
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::vector<Index> faces{static_cast<Index>(random() % mesh.face_count())};
    for (Index f = 0; f < mesh.face_count(); ++f) {
      if (random() % 100 < 2 * seed) faces.push_back(f);
    }
    std::vector<std::array<Index, 2>> segments;
    for (const Index f : faces) {
      const auto& c = mesh.faces()[f];
      for (std::size_t k = 0; k < 3; ++k) segments.push_back({c[k], c[(k + 1) % 3]});
    }
    const std::string what = "seed " + std::to_string(seed);
    expect_near(distances_from(mesh, region_of_faces(mesh, faces)), by_hand(mesh, segments), what);
  }
}

// Pages over one spine: a page that is not in the region meets it along the spine, not at its ends only.
TEST(CurveSources, ARegionEndsAtAnEdgeOfThreeFacesThatAFaceBeyondShares) {
  const std::vector<Vec3> corners{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0, 3}};
  const std::vector<Face> pages{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const Mesh book(corners, pages);
  const std::vector<Index> faces{0, 1};
  EXPECT_NEAR(distances_from(book, region_of_faces(book, faces))[4], 3, 1e-12);
}

TEST(CurveSources, ABorderIsOnePieceHoweverManyEdgesItHas) {
  const Mesh mesh = plane();
  std::vector<std::uint8_t> in(mesh.vertex_count(), 0);
  for (Index y = 1; y < 4; ++y) {
    for (Index x = 2; x < 5; ++x) in[y * (kColumns + 1) + x] = 1;
  }
  const CurveSource block = region_of_vertices(mesh, in);
  EXPECT_EQ(pieces(block), 2u) << "its border, and the vertex in its middle";
}

TEST(CurveSources, APathIsASourceAndPathsToItMeetItAtRightAngles) {
  const Mesh mesh = plane();
  DistanceSolver solver(mesh);
  const CurveSource curve = curve_source(path_between(solver, vertex_point(mesh, 0), vertex_point(mesh, kColumns)));
  const std::vector<double> found = distances_from(mesh, curve);
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(found[v], mesh.positions()[v].y, 1e-12) << v;
}

TEST(CurveSources, WhatIsEmptyIsRefused) {
  const Mesh mesh = plane(), closed = shapes::icosphere(1).mesh();
  EXPECT_THROW(curve_source(SurfacePath{}), Error);
  EXPECT_THROW(curve_source(closed, boundaries(closed)), Error);
  EXPECT_THROW(region_of_faces(mesh, {}), Error);
  EXPECT_THROW(region_of_vertices(mesh, std::vector<std::uint8_t>(mesh.vertex_count(), 0)), Error);
  EXPECT_THROW(region_of_vertices(mesh, std::vector<std::uint8_t>(3, 1)), Error);
  const std::vector<Index> beyond{mesh.face_count()};
  EXPECT_THROW(region_of_faces(mesh, beyond), Error);
}

}  // namespace
}  // namespace brushfire
