// Curves with everything that a run can be told: methods, targets, radius, threads, walls, labels, errors.
#include <brushfire/core/error.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/surface_curves.h>
#include <brushfire/queries/voronoi.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include "curves/random_curves.h"
#include "curves/samples.h"
#include "curves/surfaces.h"
#include "support/engine_run.h"
#include "support/same_field.h"

namespace brushfire {
namespace {

std::string message(const auto& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

CurveSource walk_on(const Mesh& mesh, unsigned seed, int places = 9) {
  std::mt19937 random(seed);
  CurveSource curve;
  curve.places = test::random_walk(mesh, places, random);
  return curve;
}

TEST(Curves, OfOnePlaceArePoints) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    std::mt19937 random(3);
    const SurfacePoint p = test::any_point(mesh, random);
    CurveSource curve{{p, p, p}};
    for (const bool closed : {false, true}) {
      curve.closed = closed;
      const DistanceField line = distance(mesh, std::vector{source_along(curve, 0.5)}, {.method = Method::Exact});
      const DistanceField point = distance(mesh, std::vector{Source{p, 0.5}}, {.method = Method::Exact});
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (point.distance[v] == kInfinity) continue;
        EXPECT_NEAR(line.distance[v], point.distance[v], 1e-12 * point.distance[v]) << name;
      }
    }
  }
}

TEST(Curves, InPiecesAreTheLeastOfTheirPieces) {
  const Mesh mesh = shapes::noise_terrain(12, 9, 0.4).mesh();
  CurveSource first = walk_on(mesh, 1), second = walk_on(mesh, 2), both = first;
  both.places.emplace_back();
  both.places.insert(both.places.end(), second.places.begin(), second.places.end());
  const DistanceField a = distance(mesh, std::vector{source_along(first)}, {.method = Method::Exact});
  const DistanceField b = distance(mesh, std::vector{source_along(second)}, {.method = Method::Exact});
  const DistanceField c = distance(mesh, std::vector{source_along(both)}, {.method = Method::Exact});
  const DistanceField d =
      distance(mesh, std::vector{source_along(first), source_along(second)}, {.method = Method::Exact});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double least = std::min(a.distance[v], b.distance[v]);
    EXPECT_NEAR(c.distance[v], least, 1e-12 * least);
    EXPECT_NEAR(d.distance[v], least, 1e-12 * least);
    EXPECT_EQ(c.source[v], 0U);
    if (std::abs(a.distance[v] - b.distance[v]) > 1e-9) {
      EXPECT_EQ(d.source[v], a.distance[v] < b.distance[v] ? 0U : 1U);
    }
  }
}

TEST(Curves, AndPointsMix) {
  const Mesh mesh = shapes::folded_sphere(2).mesh();
  const CurveSource curve = walk_on(mesh, 4);
  const Source point{vertex_point(mesh, 17), -0.1};
  const DistanceField a = distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact});
  const DistanceField b = distance(mesh, std::vector{point}, {.method = Method::Exact});
  const DistanceField both = distance(mesh, std::vector{source_along(curve), point}, {.method = Method::Exact});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double least = std::min(a.distance[v], b.distance[v]);
    EXPECT_NEAR(both.distance[v], least, 1e-12 * (least + 0.1));
    if (std::abs(a.distance[v] - b.distance[v]) > 1e-9) {
      EXPECT_EQ(both.source[v], a.distance[v] < b.distance[v] ? 0U : 1U);
    }
  }
}

TEST(Curves, TurnedAroundAreTheSameToRounding) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    CurveSource curve = walk_on(mesh, 6);
    const DistanceField one = distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact});
    std::reverse(curve.places.begin(), curve.places.end());
    const DistanceField other = distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (one.distance[v] == kInfinity) continue;
      EXPECT_NEAR(one.distance[v], other.distance[v], one.error_bound[v]) << name;
    }
  }
}

TEST(Curves, GiveTheSameBitsOnAnyNumberOfThreadsAndAgain) {
  const Mesh mesh = shapes::folded_sphere(5).mesh();  // 20,480 faces
  const std::vector<Source> sources{source_along(walk_on(mesh, 8, 40)), {vertex_point(mesh, 5000)}};
  for (const DistanceOptions& options :
       {DistanceOptions{.method = Method::Exact}, DistanceOptions{.tolerance = 1e-2}}) {
    DistanceOptions how = options;
    DistanceSolver solver(mesh);
    const DistanceField alone = solver.distance(sources, how);
    for (const unsigned threads : {1U, 2U, 3U}) {
      how.threads = threads;
      test::expect_equal_bits(solver.distance(sources, how), alone, std::to_string(threads) + " threads");
    }
  }
}

// Parts of 64 faces, side by side.
TEST(Curves, CrossThePartsOfAMesh) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    const auto whole = windows::make_windows(mesh, 31, windows::Merging::Always);
    const auto parts = windows::make_windows(mesh, 6, windows::Merging::Always);
    for (unsigned seed = 0; seed < 4; ++seed) {
      const std::vector<Source> sources{source_along(walk_on(mesh, seed)), {{0, {0.25, 0.25, 0.5}}, 0.02}};
      for (const DistanceOptions& how :
           {DistanceOptions{.method = Method::Exact}, DistanceOptions{.tolerance = 1e-3}}) {
        const DistanceField a = test::run(*whole, mesh, sources, how), b = test::run(*parts, mesh, sources, how);
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          if (a.distance[v] == kInfinity && b.distance[v] == kInfinity) continue;
          ASSERT_NEAR(a.distance[v], b.distance[v], a.error_bound[v] + b.error_bound[v]) << name << ", seed " << seed;
        }
      }
    }
  }
}

TEST(Curves, ReadTheSameInSparseFields) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  const std::vector<Source> sources{source_along(walk_on(mesh, 5))};
  for (const Method method : {Method::Exact, Method::Windows, Method::CarriedSource, Method::Dijkstra}) {
    const DistanceOptions how{.method = method, .max_distance = 0.4, .targets = {{7, {0.5, 0.25, 0.25}}}};
    DistanceSolver solver(mesh);
    const DistanceField dense = solver.distance(sources, how);
    const SparseField sparse = solver.distance_sparse(sources, how);
    ASSERT_EQ(sparse.vertex.size(), dense.reached) << name_of(method);
    for (std::size_t i = 0; i < sparse.vertex.size(); ++i) {
      EXPECT_EQ(sparse.distance[i], dense.distance[sparse.vertex[i]]) << name_of(method);
      EXPECT_EQ(sparse.source[i], 0U) << name_of(method);
    }
    EXPECT_EQ(sparse.target_distance, dense.target_distance) << name_of(method);
  }
}

TEST(Curves, WithinARadiusReadWhatTheWholeFieldReads) {
  const Mesh mesh = shapes::noise_terrain(20, 20, 0.3).mesh();
  const std::vector<Source> sources{source_along(walk_on(mesh, 9))};
  for (const Method method : {Method::Exact, Method::Windows}) {
    const DistanceField whole = distance(mesh, sources, {.method = method});
    const DistanceField near = distance(mesh, sources, {.method = method, .max_distance = 0.2});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (whole.distance[v] > 0.2 + 1e-9) {
        EXPECT_EQ(near.distance[v], kInfinity);
      } else if (whole.distance[v] < 0.2 - 1e-9) {
        EXPECT_NEAR(near.distance[v], whole.distance[v], 1e-12 + whole.error_bound[v] + near.error_bound[v]);
      }
    }
    EXPECT_GT(near.reached, 10U);
  }
}

// Everywhere: at targets, and where all windows were kept, also on the curve itself and in its faces.
TEST(Curves, AreReadInsideOfFaces) {
  const Mesh mesh = shapes::plane(6, 5).mesh();
  std::mt19937 random(12);
  for (int seed = 0; seed < 20; ++seed) {
    CurveSource curve;
    curve.places = test::random_walk(mesh, 8, random);
    if (seed % 2 == 1) test::give_offsets(mesh, curve, random);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 30; ++i) points.push_back(test::any_point(mesh, random));
    for (const CurveSegment& s : locate(mesh, curve).segments) {
      SurfacePoint on{s.face, {}}, beside = test::any_point_in(s.face, random);
      for (std::size_t k = 0; k < 3; ++k) on.weights[k] = 0.5 * (s.from[k] + s.to[k]);
      points.push_back(on);
      points.push_back(beside);
    }
    const std::vector<Source> sources{source_along(curve)};
    const DistanceField field =
        distance(mesh, sources, {.method = Method::Exact, .targets = points, .keep_windows = true});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double truth = test::planar_distance(mesh, curve, position(mesh, points[i]));
      EXPECT_NEAR(field.target_distance[i], truth, 1e-13) << "seed " << seed << ", target " << i;
      EXPECT_NEAR(field.windows->value(points[i]).distance, truth, 1e-13) << "seed " << seed << ", point " << i;
      const WindowField::Leg leg = field.windows->last_leg(points[i]);
      ASSERT_FALSE(leg.points.empty()) << "seed " << seed << ", point " << i;
    }
  }
}

TEST(Curves, BehindWallsAreTheCurvesOfTheCutMesh) {
  const Mesh mesh = shapes::plane(8, 8).mesh();
  std::mt19937 random(2);
  for (int seed = 0; seed < 10; ++seed) {
    const CurveSource curve = walk_on(mesh, static_cast<unsigned>(seed));
    Barriers barriers;
    for (Index row = 0; row < 7; ++row) barriers.edges.push_back({row * 9 + 4, (row + 1) * 9 + 4});
    const Domain domain(mesh, barriers);
    const DistanceField walled = distance(domain, std::vector{source_along(curve)}, {.method = Method::Exact});
    constexpr int kPieces = 24;
    const double spacing = test::longest_segment(mesh, curve) / kPieces;
    const DistanceField sampled = distance(domain, test::samples(mesh, curve, kPieces), {.method = Method::Exact});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_LE(walled.distance[v], sampled.distance[v] + 1e-12) << "seed " << seed << ", vertex " << v;
      EXPECT_GE(walled.distance[v], sampled.distance[v] - 0.5 * spacing - 1e-12) << "seed " << seed << ", vertex " << v;
    }
  }
}

// Each corner of a face with a part of the curve in it is no farther than from that, and what carries the nearest point
// on goes wrong by less than half an edge.
TEST(Curves, AreStartedFromExactlyByMarchingMethods) {
  const Mesh mesh = shapes::plane(10, 9).mesh();
  for (unsigned seed = 0; seed < 20; ++seed) {
    const CurveSource curve = walk_on(mesh, seed);
    const std::vector<Source> sources{source_along(curve)};
    const LocatedCurve located = locate(mesh, curve);
    std::vector<SurfacePoint> middles;
    for (const CurveSegment& s : located.segments) middles.push_back({s.face, {0.25, 0.25, 0.5}});
    for (const Method method : {Method::CarriedSource, Method::NovotniKlein, Method::KimmelSethian, Method::Dijkstra}) {
      SCOPED_TRACE(std::string(name_of(method)) + ", seed " + std::to_string(seed));
      const DistanceOptions how{.method = method, .precision = Precision::Double};
      DistanceOptions with_targets = how;
      with_targets.targets = middles;
      const DistanceField field = distance(mesh, sources, how), targets = distance(mesh, sources, with_targets);
      for (std::size_t i = 0; i < middles.size(); ++i) {
        const CurveSegment& s = located.segments[i];
        const CurveSource here{{{s.face, s.from}, {s.face, s.to}}};
        EXPECT_LE(targets.target_distance[i], test::planar_distance(mesh, here, position(mesh, middles[i])) + 1e-12);
        for (const Index v : mesh.faces()[s.face]) {
          EXPECT_LE(field.distance[v], test::planar_distance(mesh, here, mesh.positions()[v]) + 1e-12) << v;
        }
      }
      if (method != Method::CarriedSource) continue;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const double truth = test::planar_distance(mesh, curve, mesh.positions()[v]);
        EXPECT_GE(field.distance[v], truth - 1e-9) << "seed " << seed << ", vertex " << v;
        EXPECT_LE(field.distance[v], truth + 0.05) << "seed " << seed << ", vertex " << v;  // half an edge
      }
    }
  }
}

TEST(Curves, HaveCellsWhoseAreasAddUp) {
  const Mesh mesh = shapes::plane(20, 20).mesh();
  // Two parallel lines, at x = 0.2 and x = 0.6: the border is at 0.4.
  std::vector<Index> left, right;
  for (Index row = 0; row <= 20; ++row) {
    left.push_back(row * 21 + 4);
    right.push_back(row * 21 + 12);
  }
  const std::vector<Source> sources{source_along({curve_along(mesh, left).points}),
                                    source_along({curve_along(mesh, right).points})};
  const VoronoiDiagram cells = voronoi(mesh, sources, {.method = Method::Exact});
  EXPECT_NEAR(cells.area[0], 0.4, 1e-9);
  EXPECT_NEAR(cells.area[1], 0.6, 1e-9);
}

// What lies at a distance r from a segment: two straight sides, and half a circle around each end.
TEST(Curves, HaveCurvedIsolinesOfStraightPiecesAndArcs) {
  const Mesh mesh = shapes::plane(16, 16).mesh();
  std::vector<Index> along;
  for (Index column = 5; column <= 11; ++column) along.push_back(8 * 17 + column);
  const std::vector<Source> sources{source_along({curve_along(mesh, along).points})};
  const DistanceField field = distance(mesh, sources, {.method = Method::Exact, .keep_windows = true});
  const std::vector<double> levels{0.2};
  const std::vector<Isoline> lines = curved_isolines(*field.windows, levels, 1e-7);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].line.closed);
  EXPECT_NEAR(lines[0].line.length, 2 * 6.0 / 16 + 2 * kPi * 0.2, 1e-4);
}

TEST(Curves, ThatAreNoneAreRefusedWithTheirPlaces) {
  const Mesh mesh = shapes::plane(4, 4).mesh();
  const auto run = [&](CurveSource curve, DistanceOptions how = {}) {
    return message([&] { static_cast<void>(distance(mesh, std::vector{source_along(std::move(curve))}, how)); });
  };
  const SurfacePoint a = vertex_point(mesh, 0), b = vertex_point(mesh, 1), far = vertex_point(mesh, 24);
  EXPECT_NE(run({}).find("source 0: a curve without places"), std::string::npos);
  EXPECT_NE(run({{a, b, far}}).find("places 1 and 2 of a curve share no face"), std::string::npos);
  EXPECT_NE(run({{a, b}, false, {0}}).find("1 offsets for a curve of 2 places"), std::string::npos);
  EXPECT_NE(run({{a, b}, false, {0, 1}}).find("places 0 and 1 of a curve are 0.25 apart"), std::string::npos);
  EXPECT_NE(run({{a, a}, false, {0, 1}}).find("differ by more"), std::string::npos);
  EXPECT_NE(run({{a, b}, false, {0, kInfinity}}).find("offset inf of place 1"), std::string::npos);
  EXPECT_NE(run({{a, b}, false, {0, 0.1}}, {.method = Method::NovotniKlein}).find("not for novotni-klein"),
            std::string::npos);
  if (std::ranges::count(all_methods(), Method::Heat) > 0) {
    EXPECT_NE(run({{a, b}}, {.method = Method::Heat}).find("heat starts at points"), std::string::npos);
  }
  EXPECT_EQ(run({{a, b}, false, {0, 0.25}}), "");
}

}  // namespace
}  // namespace brushfire
