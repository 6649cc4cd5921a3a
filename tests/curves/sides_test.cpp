// On which side of a curve, and where on it, paths arrive.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/curve_sides.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/surface_curves.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "curves/random_curves.h"
#include "curves/random_polygons.h"

namespace brushfire {
namespace {

TEST(Sides, OfRandomSimplePolygonsInEitherSenseAreInsideAndOutside) {
  std::vector<unsigned> seeds(1000);
  std::iota(seeds.begin(), seeds.end(), 0u);
  // A corner that is there twice, 1e-16 apart: what lies between has no direction.
  seeds.insert(seeds.end(), {1435, 1494, 1749, 1925, 1975});
  for (const unsigned seed : seeds) {
    std::mt19937 random(seed);
    const Mesh mesh = test::random_triangulation(random);
    const bool turned = seed % 2 == 1;
    const test::SimplePolygon polygon(mesh, random, turned);
    const std::vector<double> d = signed_distance(mesh, std::vector{source_along(polygon.curve)});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (!(std::abs(d[v]) > 1e-9) || d[v] == kInfinity) continue;
      const bool inside = polygon.holds(mesh.positions()[v]);
      ASSERT_EQ(d[v] < 0, inside != turned) << "seed " << seed << ", vertex " << v;
    }
  }
}

// Two arms a constant distance apart, round and round.
TEST(Sides, OfASpiralAreBetweenItsArms) {
  const Mesh mesh = shapes::plane(40, 40).mesh();
  std::vector<Vec3> outer, inner;
  for (int i = 0; i <= 60; ++i) {
    const double turn = 2 * kPi * i / 20, radius = 0.05 + 0.12 * i / 20;
    outer.push_back({0.5 + (radius + 0.05) * std::cos(turn), 0.5 + (radius + 0.05) * std::sin(turn), 0});
    inner.push_back({0.5 + radius * std::cos(turn), 0.5 + radius * std::sin(turn), 0});
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  const CurveSource spiral{project_curve(mesh, outer, true).path.points, true};
  std::vector<Vec3> polygon;
  for (const SurfacePoint& p : spiral.places) polygon.push_back(position(mesh, p));
  const std::vector<double> d = signed_distance(mesh, std::vector{source_along(spiral)});
  int negative = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!(std::abs(d[v]) > 1e-9)) continue;
    EXPECT_EQ(d[v] < 0, test::is_inside(polygon, mesh.positions()[v])) << v;
    negative += d[v] < 0;
  }
  EXPECT_GT(negative, 100);
}

std::vector<SurfacePoint> square(const Mesh& mesh, Index low, Index high) {
  std::vector<Index> chain;
  const auto vertex = [](Index x, Index y) { return y * 11 + x; };
  for (Index i = low; i < high; ++i) chain.push_back(vertex(i, low));
  for (Index i = low; i < high; ++i) chain.push_back(vertex(high, i));
  for (Index i = high; i > low; --i) chain.push_back(vertex(i, high));
  for (Index i = high; i > low; --i) chain.push_back(vertex(low, i));
  return curve_along(mesh, chain, true).points;
}

TEST(Sides, OfCurvesThatNestWithOppositeSensesAreNegativeBetweenThem) {
  const Mesh mesh = shapes::plane(10, 10, 10, 10).mesh();
  std::vector<SurfacePoint> inner = square(mesh, 4, 6);
  std::reverse(inner.begin(), inner.end());
  const std::vector<Source> curves{source_along({square(mesh, 1, 9), true}), source_along({inner, true})};
  const std::vector<double> d = signed_distance(mesh, curves);
  const auto at = [&](Index x, Index y) { return d[y * 11 + x]; };
  EXPECT_NEAR(at(0, 5), 1, 1e-12);   // outside of both
  EXPECT_NEAR(at(2, 5), -1, 1e-12);  // between
  EXPECT_NEAR(at(5, 5), 1, 1e-12);   // inside of the inner one
  EXPECT_NEAR(at(0, 0), std::sqrt(2), 1e-12);
  EXPECT_EQ(at(1, 5), 0);
}

// Along the boundary there is one side; beyond the ends of an open curve the line straight on parts the sides.
TEST(Sides, OfBoundariesAndOpenCurves) {
  const Mesh mesh = shapes::plane(10, 10, 10, 10).mesh();
  for (const double d : signed_distance(mesh, std::vector{source_along({square(mesh, 0, 10), true})})) EXPECT_LE(d, 0);
  std::vector<Index> chain{5 * 11 + 4, 5 * 11 + 5, 5 * 11 + 6};  // to the right
  const std::vector<double> d = signed_distance(mesh, std::vector{source_along({curve_along(mesh, chain).points})});
  for (Index y = 0; y <= 10; ++y) {
    for (Index x = 0; x <= 10; ++x) {
      if (y == 5) continue;
      EXPECT_EQ(d[y * 11 + x] < 0, y > 5) << x << ", " << y;
    }
  }
}

// Past the end of an open curve on a boundary there may be no line straight on.
TEST(Sides, OfACurveThatLeavesABoundaryObliquely) {
  const Mesh mesh = shapes::plane(8, 4, 8, 4).mesh();
  const auto vertex = [](Index x, Index y) { return y * 9 + x; };
  for (const bool turned : {false, true}) {
    for (const bool mirrored : {false, true}) {
      const Index next = mirrored ? 5 : 3;
      std::vector<Index> chain{vertex(4, 0), vertex(next, 0), vertex(next, 1)};
      if (turned) std::reverse(chain.begin(), chain.end());
      const std::vector<double> d = signed_distance(mesh, std::vector{source_along({curve_along(mesh, chain).points})});
      const bool is_left = mirrored != turned;  // where the curve came from, if it were straight
      EXPECT_EQ(d[vertex(mirrored ? 3 : 5, 0)] < 0, is_left) << turned << mirrored;
      EXPECT_EQ(d[vertex(mirrored ? 0 : 8, 1)] < 0, is_left) << turned << mirrored;
    }
  }
}

// Two petals from one place to the right, of which the upper one runs clockwise: of the four pieces that meet there the
// first one clockwise from what is to the left goes out.
TEST(Sides, OfACurveThatComesToAPlaceAgainAreThoseOfAllThatMeetsThere) {
  const Mesh mesh = shapes::plane(16, 16, 4, 4).mesh();
  for (const Vec3 place : {Vec3{2, 2, 0}, Vec3{2.125, 2, 0}, Vec3{2.15, 2.05, 0}}) {  // vertex, edge, face
    const auto at = [&](double x, double y) { return Vec3{place.x + x, place.y + y, 0}; };
    for (const bool turned : {false, true}) {
      std::vector<Vec3> petals{place, at(0.5, -1), at(1, -0.3), place, at(0.5, 1), at(1, 0.3)};
      if (turned) std::reverse(petals.begin(), petals.end());
      const CurveSource curve{project_curve(mesh, petals, true).path.points, true};
      const std::vector<double> d = signed_distance(mesh, std::vector{source_along(curve)});
      for (const Index v : {8 * 17 + 4, 8 * 17 + 0, 7 * 17 + 2}) EXPECT_LT(turned ? -d[v] : d[v], 0) << place.x << v;
    }
  }
}

TEST(Arrivals, AreThePlacesWherePathsBegin) {
  for (const Mesh& mesh : {shapes::folded_sphere(2).mesh(), shapes::noise_terrain(12, 9, 0.4).mesh()}) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      std::mt19937 random(seed);
      CurveSource curve;
      curve.places = test::random_walk(mesh, 8, random);
      const std::vector<Source> sources{source_along(curve), {test::any_point(mesh, random), 0.05}};
      const DistanceField field = distance(mesh, sources, {.method = Method::Exact, .keep_paths = true});
      const std::vector<CurveArrival> where = arrivals(*field.windows, sources);
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        ASSERT_EQ(where[v].source, field.source[v]) << "seed " << seed << ", vertex " << v;
        if (where[v].source != 0) continue;
        const SurfacePath path = path_to(*field.windows, vertex_point(mesh, v));
        ASSERT_LT(where[v].place, curve.places.size());
        const Vec3 a = position(mesh, curve.places[where[v].place]);
        std::size_t next = where[v].place + 1;  // the next one that differs
        while (next + 1 < curve.places.size() && norm(position(mesh, curve.places[next]) - a) < 1e-12) ++next;
        const Vec3 b = position(mesh, curve.places[std::min(next, curve.places.size() - 1)]);
        const Vec3 there = a + where[v].share * (b - a);
        EXPECT_LE(norm(there - position(mesh, path.points.front())), 1e-7) << "seed " << seed << ", vertex " << v;
      }
    }
  }
}

TEST(Sides, AreRefusedOfPointsAndOffsets) {
  const Mesh mesh = shapes::plane(4, 4).mesh();
  EXPECT_THROW(signed_distance(mesh, std::vector<Source>{{vertex_point(mesh, 0)}}), Error);
  const CurveSource edge{curve_along(mesh, std::vector<Index>{0, 1}).points};
  EXPECT_THROW(signed_distance(mesh, std::vector{source_along(edge, 1)}), Error);
}

}  // namespace
}  // namespace brushfire
