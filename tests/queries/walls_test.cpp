// Walls: every method and query in a domain gives what it gives on a mesh that was cut apart by hand.
#include <brushfire/core/error.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/certify.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/gradient.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/straightest.h>
#include <brushfire/queries/voronoi.h>

#include "../support/random_points.h"
#include "cut_by_hand.h"
#include "random_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace brushfire {
namespace {

using test::ByHand;
using test::difference;
using test::kRounding;
using test::least_by_hand;
using test::open_point;
using test::random_walls;
using Case = test::WalledCase;

TEST(Walls, EveryMethodReadsWhatItReadsOnTheMeshCutByHand) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Case c = random_walls(random);
    const Domain domain(c.mesh, c.barriers);
    const ByHand hand(c.mesh, c.barriers), numbered = hand.numbered_as(domain.open());
    std::vector<Source> sources, by_hand, named;
    for (unsigned i = 0; i < 1 + seed % 3; ++i) {
      sources.push_back({open_point(domain, random), 0.1 * i});
      for (const SurfacePoint& p : hand.sides(c.mesh, sources.back().point)) by_hand.push_back({p, 0.1 * i});
      // What marches depends on how a point of an edge is named, too.
      for (const SurfacePoint& p : domain.on_open(sources.back().point)) named.push_back({p, 0.1 * i});
    }
    DistanceOptions options;
    options.precision = Precision::Double;
    for (const Method method : all_methods()) {
      SCOPED_TRACE(name_of(method));
      options.method = method;
      options.tolerance = 0;
      const DistanceField field = distance(domain, sources, options);
      const bool marches = method != Method::Windows && method != Method::Exact && method != Method::Dijkstra;
      const ByHand& cut = marches ? numbered : hand;
      const DistanceField truth = distance(cut.mesh, marches ? named : by_hand, options);
      EXPECT_LE(difference(field.distance, least_by_hand(cut, truth.distance, c.mesh.vertex_count())), kRounding);
      options.threads = 2;
      const DistanceField threaded = distance(domain, sources, options);
      EXPECT_EQ(threaded.distance, field.distance);
      EXPECT_EQ(threaded.source, field.source);
      options.threads = 1;
      const SparseField sparse = DistanceSolver(domain).distance_sparse(sources, options);
      EXPECT_EQ(sparse.vertex.size(), field.reached);
      for (std::size_t i = 0; i < sparse.vertex.size(); ++i) {
        EXPECT_EQ(sparse.distance[i], field.distance[sparse.vertex[i]]);
        EXPECT_EQ(sparse.source[i], field.source[sparse.vertex[i]]);
      }
    }
    // The promise of a tolerance holds at every vertex, and so does the bound that is told.
    options.method = Method::Windows;
    options.tolerance = 0.02;
    const DistanceField within = distance(domain, sources, options);
    options.tolerance = 0;
    const DistanceField exact = distance(domain, sources, options);
    for (Index v = 0; v < c.mesh.vertex_count(); ++v) {
      if (exact.distance[v] == kInfinity) continue;
      EXPECT_LE(std::abs(within.distance[v] - exact.distance[v]), within.error_bound[v] + kRounding) << v;
      EXPECT_LE(within.error_bound[v], 0.02 * std::abs(within.distance[v]) * 1.03 + kRounding) << v;
    }
  }
}

// Sixteen sources at a time, of which those on walls run alone: as near to the truth as single runs.
TEST(Walls, GroupedRowsGoAroundThem) {
  double error = 0, error_single = 0;
  for (unsigned seed = 300; seed < 310; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Case c = random_walls(random);
    const Domain domain(c.mesh, c.barriers);
    MatrixOptions matrix;
    matrix.distance.method = Method::CarriedSource;
    const std::vector<double> rows = distance_matrix<double>(domain, {}, {}, matrix);
    const std::size_t n = c.mesh.vertex_count();
    DistanceSolver solver(domain);
    for (Index v = 0; v < n; ++v) {
      if (c.mesh.corners(v).empty() || !domain.is_open(v)) continue;
      const Source source{vertex_point(c.mesh, v)};
      const std::vector<double> truth = solver.distance({&source, 1}, {.method = Method::Exact}).distance;
      const std::vector<double> single = solver.distance({&source, 1}, matrix.distance).distance;
      for (Index u = 0; u < n; ++u) {
        const double d = rows[v * n + u];
        ASSERT_EQ(std::isfinite(d), std::isfinite(truth[u])) << v << " to " << u;
        if (!std::isfinite(d) || u == v) continue;
        error += std::abs(d - truth[u]) / truth[u], error_single += std::abs(single[u] - truth[u]) / truth[u];
      }
    }
  }
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 1.1 * error_single);
}

// The polar coordinates of the nearest side of every vertex (of sides that are equally near to rounding, of any), by
// whoever has used the solver before.
void expect_map_of_nearest_sides(DistanceSolver& solver, const SurfacePoint& from, double radius) {
  const Domain& domain = solver.domain();
  const LogMap open = log_map(domain.open(), domain.on_open(from).front(), radius);
  const SparseLogMap map = log_map(solver, from, radius);
  std::map<Index, double> nearest;
  for (Index v = 0; v < domain.open().vertex_count(); ++v) {
    if (open.radius[v] == kInfinity) continue;
    double& least = nearest.try_emplace(domain.vertex(v), kInfinity).first->second;
    least = std::min(least, open.radius[v]);
  }
  ASSERT_EQ(map.vertex.size(), nearest.size());
  std::set<Index> explained;
  for (Index v = 0; v < domain.open().vertex_count(); ++v) {
    if (open.radius[v] == kInfinity || open.radius[v] > nearest.at(domain.vertex(v)) + kRounding) continue;
    const auto i = std::lower_bound(map.vertex.begin(), map.vertex.end(), domain.vertex(v)) - map.vertex.begin();
    EXPECT_EQ(map.vertex[i], domain.vertex(v));
    EXPECT_EQ(map.radius[i], nearest.at(domain.vertex(v)));
    if (std::abs(std::remainder(map.angle[i] - open.angle[v], map.total_angle)) < 1e-9)
      explained.insert(domain.vertex(v));
  }
  EXPECT_EQ(explained.size(), nearest.size());
}

TEST(Walls, TargetsPathsMatricesAndLogMapsAgreeWithTheField) {
  for (unsigned seed = 100; seed < 130; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Case c = random_walls(random);
    const Domain domain(c.mesh, c.barriers);
    const ByHand hand(c.mesh, c.barriers);
    const SurfacePoint from = open_point(domain, random);
    DistanceOptions options;
    options.method = Method::Exact;
    std::vector<SurfacePoint> targets;
    for (int i = 0; i < 6; ++i) targets.push_back(test::any_point(c.mesh, random));
    for (const SurfacePoint& t : targets) options.targets.push_back(t);
    const Source source{from};
    const DistanceField field = distance(domain, std::span(&source, 1), options);
    DistanceSolver solver(domain);
    std::vector<Place> rows{from};
    const std::vector<Place> columns(targets.begin(), targets.end());
    MatrixOptions matrix;
    matrix.distance.method = Method::Exact;
    const std::vector<double> row =
        distance_matrix<double>(domain, std::span<const Place>(rows), std::span<const Place>(columns), matrix);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      EXPECT_NEAR(row[i] == kInfinity ? -1 : row[i],
                  field.target_distance[i] == kInfinity ? -1 : field.target_distance[i], kRounding);
      const SurfacePath path = path_between(solver, from, targets[i]);
      if (field.target_distance[i] == kInfinity) {
        EXPECT_TRUE(path.points.empty());
        continue;
      }
      EXPECT_NEAR(path.length, field.target_distance[i], 1e-10);
      EXPECT_NEAR(length_of(c.mesh, path.points), path.length, 1e-10);
      for (const SurfacePoint& p : path.points) EXPECT_NE(hand.face_of[p.face], kNoIndex);
    }
    options.targets.clear();
    const DistanceField whole = distance(domain, std::span(&source, 1), options);
    if (domain.on_open(from).size() == 1) {
      const LogMap map = log_map(domain, from);
      EXPECT_LE(difference(map.radius, whole.distance), kRounding);
      for (const double radius : {kInfinity, 0.4, 0.1}) expect_map_of_nearest_sides(solver, from, radius);
    }
    const SparseMatrix<double> near = distances_within<double>(domain, 0.4, std::span<const Place>(rows), matrix);
    for (std::size_t i = 0; i < near.column.size(); ++i)
      EXPECT_NEAR(near.value[i], whole.distance[near.column[i]], kRounding);
    EXPECT_EQ(near.column.size(), static_cast<std::size_t>(std::count_if(whole.distance.begin(), whole.distance.end(),
                                                                         [](double d) { return d <= 0.4; })));
  }
}

TEST(Walls, CellsSamplesAndCertificatesKnowThem) {
  for (unsigned seed = 200; seed < 220; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Case c = random_walls(random);
    const Domain domain(c.mesh, c.barriers);
    std::vector<Source> sources;
    for (int i = 0; i < 4; ++i) sources.push_back({open_point(domain, random), 0.03 * i});
    DistanceOptions options;
    options.method = Method::Exact;
    const DistanceField field = distance(domain, sources, options);
    const VoronoiDiagram cells = voronoi(domain, sources, options);
    EXPECT_EQ(cells.distance, field.distance);
    EXPECT_EQ(cells.source, field.source);
    for (const VoronoiBorder& b : cells.borders) {
      EXPECT_NEAR(length_of(c.mesh, b.line.points, b.line.closed), b.line.length, kRounding);
    }
    double reached = 0;
    const std::vector<double>& side = domain.has_walls() ? field.side_distance : field.distance;
    for (Index f = 0; f < domain.open().face_count(); ++f) {
      const auto [x, y, z] = domain.open().faces()[f];
      if (std::max({side[x], side[y], side[z]}) == kInfinity) continue;
      reached += 0.5 * domain.open().double_areas()[f] * domain.open().unit() * domain.open().unit();
    }
    EXPECT_NEAR(std::accumulate(cells.area.begin(), cells.area.end(), 0.0), reached, 1e-10);

    const Certificate good = certify(domain, field.distance, sources);
    EXPECT_EQ(good.proven_wrong(), 0u);
    const DistanceField through = distance(c.mesh, sources, options);
    const Certificate bad = certify(domain, through.distance, sources);
    for (Index v = 0; v < c.mesh.vertex_count(); ++v) {
      if (through.distance[v] < field.distance[v] * (1 - 1e-6)) {
        EXPECT_NE(bad.finding[v], Finding::Possible) << v;
      }
    }

    const Samples samples = farthest_points(domain, 8, {}, options);
    std::vector<Source> taken;
    for (const Index v : samples.vertices) taken.push_back({vertex_point(c.mesh, v)});
    EXPECT_LE(difference(samples.distance, distance(domain, taken, options).distance), kRounding);
  }
}

TEST(Walls, AWallOnAPlaneIsWalkedAroundAndIsolinesEndAtIt) {
  // [0, 4]^2 with a wall up x = 2 from y = 0 to y = 3, from (0, 0): to (4, 0) around its end at (2, 3).
  const Mesh mesh = shapes::plane(4, 4, 4, 4).mesh();
  const auto at = [](Index x, Index y) { return y * 5 + x; };
  Barriers wall;
  for (Index y = 0; y < 3; ++y) wall.edges.push_back({at(2, y), at(2, y + 1)});
  const Domain domain(mesh, wall);
  const Source source{vertex_point(mesh, 0)};
  DistanceOptions options;
  options.method = Method::Exact;
  const DistanceField field = distance(domain, std::span(&source, 1), options);
  EXPECT_NEAR(field.distance[at(4, 0)], std::sqrt(13.0) + std::sqrt(13.0), 1e-12);
  EXPECT_NEAR(field.distance[at(2, 0)], 2, 1e-12);  // the near side of the wall
  EXPECT_NEAR(field.side_distance[mesh.vertex_count()] + field.side_distance[at(2, 0)], 2 + std::sqrt(13.0) + 3,
              1e-12);  // and both
  const SurfacePath path = PathFinder(domain).between(vertex_point(mesh, 0), vertex_point(mesh, at(4, 0)));
  EXPECT_TRUE(std::any_of(path.points.begin(), path.points.end(),
                          [&](const SurfacePoint& p) { return position(mesh, p) == (Vec3{2, 3, 0}); }));
  // At level 1.9 nothing is beyond the wall, and at 5 the curve has an end at it.
  for (const Isoline& line : isolines(domain, field.side_distance, std::vector<double>{1.9})) {
    for (const SurfacePoint& p : line.line.points) EXPECT_LE(position(mesh, p).x, 2);
  }
  const std::vector<Isoline> behind = isolines(domain, field.side_distance, std::vector<double>{5.0});
  ASSERT_EQ(behind.size(), 1u);
  const Vec3 a = position(mesh, behind[0].line.points.front()), b = position(mesh, behind[0].line.points.back());
  EXPECT_EQ(std::min(a.x, b.x), 2);
  // Downhill at the wall: on its near side, to the source.
  const SurfaceDirection down = steepest_descent(domain, field.side_distance, vertex_point(mesh, at(2, 1)));
  EXPECT_LT(in_space(mesh, down).x, 0);
  // Straight on ends at the wall.
  const Trace trace = straightest(domain, vertex_point(mesh, 0), angle_of(mesh, vertex_point(mesh, 0), {1, 0.3, 0}), 9);
  EXPECT_EQ(trace.end, TraceEnd::Boundary);
  EXPECT_NEAR(position(mesh, trace.path.points.back()).x, 2, 1e-12);
}

TEST(Walls, WhatIsBehindAWallIsNowhere) {
  const Mesh mesh = shapes::plane(4, 4, 4, 4).mesh();
  std::vector<std::uint8_t> open(mesh.vertex_count(), 1);
  for (Index y = 0; y < 5; ++y) open[y * 5 + 3] = 0;  // the column x = 3
  const Domain domain(mesh, {.faces = closed_faces(mesh, open)});
  EXPECT_EQ(domain.open().face_count(), 16u);
  const Source inside{vertex_point(mesh, 0)}, behind{vertex_point(mesh, 3)};
  EXPECT_THROW(distance(domain, std::span(&behind, 1)), Error);
  DistanceOptions options;
  options.targets = {vertex_point(mesh, 3), vertex_point(mesh, 2)};
  const DistanceField field = distance(domain, std::span(&inside, 1), options);
  EXPECT_EQ(field.target_distance[0], kInfinity);
  EXPECT_NEAR(field.target_distance[1], 2, 1e-6);
  options.targets = {vertex_point(mesh, 3)};
  EXPECT_EQ(distance(domain, std::span(&inside, 1), options).target_distance[0], kInfinity);
  EXPECT_FALSE(domain.is_open(3));
  EXPECT_TRUE(domain.is_open(2));
  EXPECT_THROW(closed_faces(mesh, std::vector<std::uint8_t>(3)), Error);
  const std::vector<Place> rows{Index{3}, Index{0}};
  const std::vector<double> matrix = distance_matrix<double>(domain, std::span<const Place>(rows), std::nullopt);
  EXPECT_EQ(*std::min_element(matrix.begin(), matrix.begin() + 25), kInfinity);
  EXPECT_EQ(matrix[25 + 3], kInfinity);
  EXPECT_EQ(matrix[25], 0);
}

}  // namespace
}  // namespace brushfire
