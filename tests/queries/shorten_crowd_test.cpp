// Two thousand paths and loops through random vertices: every shortening ends, in a curve that an independent judge
// finds locally shortest, and that is no longer than what it was.
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/shorten.h>
#include <brushfire/solvers/distance.h>

#include "support/path_checker.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace brushfire {
namespace {

// From stop to stop along the shortest ways of edges; multiply visited vertices, stretches there and back and all.
std::vector<SurfacePoint> way_through(DistanceSolver& solver, const std::vector<Index>& stops, bool closed) {
  const Mesh& mesh = solver.mesh();
  DistanceOptions options;
  options.method = Method::Dijkstra;
  std::vector<SurfacePoint> way;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < stops.size(); ++i) {
    const Source from{vertex_point(mesh, stops[i])};
    const DistanceField field = solver.distance({&from, 1}, options);
    const SurfacePath leg = edge_path_to(mesh, field, stops[(i + 1) % stops.size()]);
    way.insert(way.end(), leg.points.begin(), leg.points.end() - 1);
  }
  if (!closed) way.push_back(vertex_point(mesh, stops.back()));
  return way;
}

#ifdef __SANITIZE_ADDRESS__
constexpr int kRuns = 40;  // every instruction counts ten times there
#else
constexpr int kRuns = 400;
#endif

class Crowd : public testing::TestWithParam<std::pair<std::string, Mesh>> {};

TEST_P(Crowd, OfRandomPathsAndLoopsEndsLocallyShortestAndNoLonger) {
  const Mesh& mesh = GetParam().second;
  DistanceSolver solver(mesh);
  const unsigned seed = 17;
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> vertex(0, mesh.vertex_count() - 1);
  for (int run = 0; run < kRuns; ++run) {
    const bool closed = run % 2 == 1;
    std::vector<Index> stops;
    for (int i = 0; i < 2 + run % 5; ++i) stops.push_back(vertex(random));
    for (std::size_t i = 1; i < stops.size(); ++i) {
      while (stops[i] == stops[i - 1] || (i + 1 == stops.size() && stops[i] == stops[0])) stops[i] = vertex(random);
    }
    SCOPED_TRACE(GetParam().first + ", seed " + std::to_string(seed) + ", run " + std::to_string(run));
    const std::vector<SurfacePoint> way = way_through(solver, stops, closed);
    const SurfacePath path = shorten(mesh, way, closed);
    const double before = length_of(mesh, way, closed);
    ASSERT_EQ(path.closed, closed);
    ASSERT_LE(path.length, before * (1 + 1e-12));
    ASSERT_EQ(test::judge(mesh, path, 1e-5), "");
    if (closed) continue;
    ASSERT_EQ(norm(position(mesh, path.points.front()) - position(mesh, way.front())), 0);
    const SurfacePath again = shorten(mesh, path.points, closed);
    ASSERT_NEAR(again.length, path.length, 1e-9 * before);  // nothing is left to shorten
  }
}

INSTANTIATE_TEST_SUITE_P(Shorten, Crowd,
                         testing::Values(std::pair{"torus", shapes::torus(24, 12).mesh()},
                                         std::pair{"terrain", shapes::noise_terrain(18, 18, 0.5).mesh()},
                                         std::pair{"folds", shapes::folded_sphere(3).mesh()},
                                         std::pair{"book", shapes::book(3, 7, 9).mesh()},
                                         std::pair{"cone", shapes::cone(8, 16, 0.5, 3).mesh()}),
                         [](const auto& crowd) { return crowd.param.first; });

}  // namespace
}  // namespace brushfire
