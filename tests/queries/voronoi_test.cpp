// Voronoi diagrams: straight bisectors on the plane, areas that add up, borders that close.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/voronoi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace brushfire {
namespace {

std::vector<Source> at_vertices(const Mesh& mesh, std::initializer_list<Index> vertices) {
  std::vector<Source> sources;
  for (const Index v : vertices) sources.push_back({vertex_point(mesh, v), 0});
  return sources;
}

struct BisectorErrors {
  double border, area;
};

// Two sources on the unit square in a grid of n x n cells: how far the border is from the bisector.
BisectorErrors bisector_errors(Index n) {
  const Mesh mesh = shapes::plane(n, n).mesh();
  const Index u = n / 30;
  const std::vector<Source> sources = at_vertices(mesh, {8 * u * (n + 1) + 4 * u, 21 * u * (n + 1) + 25 * u});
  const Vec3 a = position(mesh, sources[0].point), b = position(mesh, sources[1].point);
  DistanceOptions options;
  options.method = Method::Exact;
  const VoronoiDiagram d = voronoi(mesh, sources, options);
  EXPECT_EQ(d.borders.size(), 1u);
  EXPECT_FALSE(d.borders[0].line.closed);
  EXPECT_EQ(d.borders[0].sources, (std::array<Index, 2>{0, 1}));
  EXPECT_NEAR(d.area[0] + d.area[1], 1, 1e-12);
  double worst = 0;
  for (const SurfacePoint& s : d.borders[0].line.points) {
    const Vec3 p = position(mesh, s);
    worst = std::max(worst, std::abs(norm(p - a) - norm(p - b)));
  }
  // The bisector cuts the square; the area below it by integration along x.
  double below = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = (i + 0.5) / 10000;
    const double y = (dot(b, b) - dot(a, a) - 2 * x * (b.x - a.x)) / (2 * (b.y - a.y));
    below += std::min(1.0, std::max(0.0, y)) / 10000;
  }
  return {worst, std::abs(d.area[0] - below)};
}

TEST(Voronoi, BorderOfTwoSourcesOnAPlaneConvergesToTheirBisectorWithSecondOrder) {
  const BisectorErrors coarse = bisector_errors(30), fine = bisector_errors(120);
  EXPECT_LT(coarse.border, 1e-3);
  EXPECT_LT(fine.border, coarse.border / 10);
  EXPECT_LT(coarse.area, 1e-4);
}

TEST(Voronoi, ThreeCellsMeetInOnePoint) {
  const Index n = 24;
  const Mesh mesh = shapes::plane(n, n).mesh();
  const VoronoiDiagram d = voronoi(mesh, at_vertices(mesh, {3 * (n + 1) + 3, 5 * (n + 1) + 20, 21 * (n + 1) + 10}));
  ASSERT_EQ(d.borders.size(), 3u);
  // Each line has one end at the point of equal distance of all three.
  const auto end_near = [&](const SurfacePath& line, Vec3 p) {
    return std::min(norm(position(mesh, line.points.front()) - p), norm(position(mesh, line.points.back()) - p));
  };
  const SurfacePath& first = d.borders[0].line;
  const Vec3 candidates[] = {position(mesh, first.points.front()), position(mesh, first.points.back())};
  const bool meets =
      (end_near(d.borders[1].line, candidates[0]) < 1e-12 && end_near(d.borders[2].line, candidates[0]) < 1e-12) ||
      (end_near(d.borders[1].line, candidates[1]) < 1e-12 && end_near(d.borders[2].line, candidates[1]) < 1e-12);
  EXPECT_TRUE(meets);
  EXPECT_NEAR(std::accumulate(d.area.begin(), d.area.end(), 0.0), 1, 1e-12);
}

TEST(Voronoi, LabelsAreThoseOfTheCommonField) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  const std::vector<Source> sources = at_vertices(mesh, {0, 100, 200, 300});
  for (const Method method : {Method::Dijkstra, Method::NovotniKlein}) {
    DistanceOptions options;
    options.method = method;
    const DistanceField field = distance(mesh, sources, options);
    const VoronoiDiagram d = voronoi(mesh, sources, options);
    EXPECT_EQ(d.distance, field.distance);
    EXPECT_EQ(d.source, field.source);
    EXPECT_NEAR(std::accumulate(d.area.begin(), d.area.end(), 0.0), mesh.report().area, 1e-12 * mesh.report().area);
  }
}

TEST(Voronoi, TwoPolesOfASphereShareTheEquator) {
  const Mesh mesh = shapes::latlong_sphere(17, 32).mesh();  // no ring of vertices on the equator
  const VoronoiDiagram d = voronoi(mesh, at_vertices(mesh, {0, mesh.vertex_count() - 1}));
  ASSERT_EQ(d.borders.size(), 1u);
  EXPECT_TRUE(d.borders[0].line.closed);
  for (const SurfacePoint& p : d.borders[0].line.points) EXPECT_NEAR(position(mesh, p).z, 0, 1e-3);
  EXPECT_NEAR(d.area[0], d.area[1], 1e-9);
  EXPECT_NEAR(d.borders[0].line.length, 2 * kPi, 0.05);
}

TEST(Voronoi, ADominatedSourceHasNoAreaAndUnreachedPartsNoCell) {
  Shape s = shapes::plane(4, 4);
  const std::vector<Vec3> once = s.positions;
  for (const Vec3& p : once) s.positions.push_back(p + Vec3{9, 0, 0});
  const std::vector<Face> faces = s.faces;
  for (const Face& t : faces) s.faces.push_back({t[0] + 25, t[1] + 25, t[2] + 25});
  const Mesh mesh = s.mesh();
  std::vector<Source> sources = at_vertices(mesh, {0, 24});
  sources[1].offset = 10;
  const VoronoiDiagram d = voronoi(mesh, sources);
  EXPECT_NEAR(d.area[0], 1, 1e-12);
  EXPECT_EQ(d.area[1], 0);
  EXPECT_TRUE(d.borders.empty());
  EXPECT_EQ(d.source[30], kNoIndex);
  EXPECT_THROW(voronoi(mesh, {}), Error);
}

TEST(Voronoi, OffsetsMoveTheBorder) {
  const Mesh mesh = shapes::plane(40, 4, 10, 1).mesh();
  std::vector<Source> sources = at_vertices(mesh, {2 * 41 + 0, 2 * 41 + 40});
  const double even = voronoi(mesh, sources).area[0];
  sources[1].offset = 2;
  EXPECT_NEAR(even, 5, 1e-6);
  EXPECT_NEAR(voronoi(mesh, sources).area[0], 6, 0.01);
  sources[0].offset = -20;
  sources[1].offset = -18;
  EXPECT_NEAR(voronoi(mesh, sources).area[0], 6, 0.01);
}

}  // namespace
}  // namespace brushfire
