// Signed distances among walls: inside and outside of polygons, and what the mesh that is cut apart has.
#include <brushfire/core/error.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/curve_sides.h>
#include <brushfire/queries/surface_curves.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "curves/random_curves.h"
#include "curves/random_polygons.h"

namespace brushfire {
namespace {

// Blocked edges, faces and vertices, a few of each.
Barriers random_walls(const Mesh& mesh, std::mt19937& random) {
  Barriers walls;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (random() % 5 == 0) walls.edges.push_back({mesh.from(h), mesh.to(h)});
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (random() % 15 == 0) walls.faces.push_back(f);
  }
  if (random() % 2 == 0) walls.vertices.push_back(static_cast<Index>(random() % mesh.vertex_count()));
  return walls;
}

// Whatever walls there are: no path gets from the inside to the outside but over the curve.
TEST(WalledSides, OfRandomSimplePolygonsAreInsideAndOutside) {
  int negative = 0, parted = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = test::random_triangulation(random);
    const bool turned = seed % 2 == 1;
    const test::SimplePolygon polygon(mesh, random, turned);
    const Domain domain(mesh, random_walls(mesh, random));
    std::vector<double> d;
    try {
      d = signed_distance(domain, std::vector{source_along(polygon.curve)});
    } catch (const Error&) {
      continue;  // all of it behind walls
    }
    const DistanceField field = distance(domain, std::vector{source_along(polygon.curve)}, {.method = Method::Exact});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(std::abs(d[v]), field.distance[v]) << "seed " << seed << ", vertex " << v;
      if (!(std::abs(d[v]) > 1e-9) || d[v] == kInfinity) continue;
      ASSERT_EQ(d[v] < 0, polygon.holds(mesh.positions()[v]) != turned) << "seed " << seed << ", vertex " << v;
      negative += d[v] < 0;
    }
    parted += domain.open().vertex_count() > mesh.vertex_count();
  }
  EXPECT_GT(negative, 1000);
  EXPECT_GT(parted, 100);
}

// The curve stays off the walls, so that it is the same on the mesh that is cut apart.
TEST(WalledSides, AreThoseOfTheCutMesh) {
  int compared = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = shapes::noise_terrain(9, 8, 0.3).mesh();
    CurveSource curve{test::random_walk(mesh, 2 + static_cast<int>(random() % 5), random)};
    // It ends inside faces: no vertex is straight on from there, where the sides are the same.
    const auto inside = [&](const SurfacePoint& beside) {
      const double a = 0.1 + 0.3 * test::uniform(random), b = 0.1 + 0.3 * test::uniform(random);
      return SurfacePoint{beside.face, {a, b, 1 - a - b}};
    };
    curve.places.insert(curve.places.begin(), inside(curve.places.front()));
    curve.places.push_back(inside(curve.places.back()));
    std::vector<char> is_near(mesh.face_count(), 0);
    for (const SurfacePoint& p : curve.places) {
      for (const Index f : faces_at(mesh, locate(mesh, p))) is_near[f] = 1;
    }
    Barriers walls = random_walls(mesh, random);
    walls.vertices.clear();
    std::erase_if(walls.faces, [&](Index f) { return is_near[f] != 0; });
    std::erase_if(walls.edges, [&](const auto& e) {
      const auto corners = mesh.corners(e[0]);
      return std::any_of(corners.begin(), corners.end(), [&](Index h) { return is_near[Mesh::face_of(h)] != 0; });
    });
    const CutMesh cut = brushfire::cut(mesh, walls);
    CurveSource on_cut = curve;
    for (SurfacePoint& p : on_cut.places) p.face = cut.cut_face[p.face];
    const std::vector<double> there = signed_distance(cut.mesh, std::vector{source_along(on_cut)});
    const std::vector<double> here = signed_distance(Domain(mesh, walls), std::vector{source_along(curve)});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      double expected = kInfinity;
      for (Index w = 0; w < there.size(); ++w) {
        if (cut.original_vertex[w] == v && std::abs(there[w]) < std::abs(expected)) expected = there[w];
      }
      if (expected == kInfinity) {
        ASSERT_EQ(here[v], kInfinity) << "seed " << seed << ", vertex " << v;
        continue;
      }
      ASSERT_NEAR(std::abs(here[v]), std::abs(expected), 1e-12) << "seed " << seed << ", vertex " << v;
      ASSERT_TRUE(here[v] == expected || std::abs(expected) < 1e-9 || std::signbit(here[v]) == std::signbit(expected))
          << "seed " << seed << ", vertex " << v << ": " << here[v] << " " << expected;
      ++compared;
    }
  }
  EXPECT_GT(compared, 3000);
}

// The wall and the curve are the same edges: from (2, 2) to (6, 2), of 8 x 4 squares.
TEST(WalledSides, OfACurveAlongAWallAreAboveAndBelowIt) {
  const Mesh mesh = shapes::plane(8, 4, 8, 4).mesh();
  const auto vertex = [](Index x, Index y) { return y * 9 + x; };
  std::vector<Index> chain;
  Barriers wall;
  for (Index x = 2; x <= 6; ++x) chain.push_back(vertex(x, 2));
  for (Index x = 2; x < 6; ++x) wall.edges.push_back({vertex(x, 2), vertex(x + 1, 2)});
  for (const Barriers& walls : {wall, Barriers{.edges = {wall.edges[1]}}, Barriers{.edges = {wall.edges[3]}}}) {
    const Source curve = source_along({curve_along(mesh, chain).points});
    const std::vector<double> d = signed_distance(Domain(mesh, walls), std::vector{curve});
    for (Index y = 0; y <= 4; ++y) {
      for (Index x = 0; x <= 8; ++x) {
        const double beside = x < 2 ? 2.0 - x : x > 6 ? x - 6.0 : 0, away = y < 2 ? 2.0 - y : y - 2.0;
        EXPECT_NEAR(std::abs(d[vertex(x, y)]), std::hypot(beside, away), 1e-12) << x << ", " << y;
        if (y == 2) continue;
        EXPECT_EQ(d[vertex(x, y)] < 0, y > 2) << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace brushfire
