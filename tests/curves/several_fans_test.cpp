// Sides at vertices whose faces form several fans: pinches, and edges of three faces.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/curve_sides.h>
#include <brushfire/queries/surface_curves.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace brushfire {
namespace {

constexpr Index kCells = 8;  // a side of the square
Index vertex(Index x, Index y) { return y * (kCells + 1) + x; }

// The square with an upright fin on the edges from (from, 4) to (to, 4), the vertices between which then have several
// fans.
Mesh with_fin(Index from, Index to) {
  const Mesh flat = shapes::plane(kCells, kCells, kCells, kCells).mesh();
  std::vector<Vec3> positions(flat.positions().begin(), flat.positions().end());
  std::vector<Face> faces(flat.faces().begin(), flat.faces().end());
  for (Index x = from; x < to; ++x) {
    const auto top = static_cast<Index>(positions.size());
    positions.push_back({x + 0.5, 4, 1});
    faces.push_back({vertex(x, 4), vertex(x + 1, 4), top});
  }
  return {positions, faces};
}

bool is_inside(const Vec3& p) { return p.x > 2 && p.x < 6 && p.y > 2 && p.y < 6; }

std::vector<double> signed_to_square(const Mesh& mesh, bool turned) {
  std::vector<Index> chain;
  for (Index i = 2; i < 6; ++i) chain.push_back(vertex(i, 2));
  for (Index i = 2; i < 6; ++i) chain.push_back(vertex(6, i));
  for (Index i = 6; i > 2; --i) chain.push_back(vertex(i, 6));
  for (Index i = 6; i > 2; --i) chain.push_back(vertex(2, i));
  if (turned) std::reverse(chain.begin(), chain.end());
  return signed_distance(mesh, std::vector{source_along({curve_along(mesh, chain, true).points, true})});
}

TEST(SidesAtSeveralFans, OfASquareThatAFinCrossesAreThoseOfTheSquare) {
  for (const bool turned : {false, true}) {
    for (const Mesh& mesh : {with_fin(1, 3), with_fin(1, 2), with_fin(2, 3)}) {
      const std::vector<double> d = signed_to_square(mesh, turned);
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!(std::abs(d[v]) > 1e-9)) continue;
        EXPECT_EQ(d[v] < 0, is_inside(mesh.positions()[v]) != turned) << v;
      }
    }
  }
}

TEST(SidesAtSeveralFans, OfASquareWhoseFacesAreThereTwiceAreThoseOfTheSquare) {
  const Mesh flat = shapes::plane(kCells, kCells, kCells, kCells).mesh();
  std::vector<Face> faces(flat.faces().begin(), flat.faces().end());
  faces.insert(faces.end(), flat.faces().begin(), flat.faces().end());
  const Mesh mesh(flat.positions(), faces);
  for (const bool turned : {false, true}) EXPECT_EQ(signed_to_square(mesh, turned), signed_to_square(flat, turned));
}

// Two squares that have one vertex in common, and a triangle of each.
TEST(SidesAtSeveralFans, OfACurveThroughAPinchAreThoseOfItsPartOnEitherSheet) {
  const Mesh flat = shapes::plane(4, 4, 4, 4).mesh();
  const Index n = flat.vertex_count();
  std::vector<Vec3> positions(flat.positions().begin(), flat.positions().end());
  std::vector<Face> faces(flat.faces().begin(), flat.faces().end());
  const Index shared = 12;  // the middle
  const auto other = [&](Index v) { return v == shared ? shared : v < shared ? n + v : n + v - 1; };
  for (Index v = 0; v < n; ++v) {
    if (v != shared) positions.push_back({flat.positions()[v].x, flat.positions()[v].y, 0});
  }
  for (const Face& f : flat.faces()) faces.push_back({other(f[0]), other(f[1]), other(f[2])});
  const Mesh mesh(positions, faces);
  // From the middle to the right and up, on one sheet and then on the other.
  const std::vector<Index> chain{shared, 13, 18, 17, shared, other(13), other(18), other(17)};
  const std::vector<double> d =
      signed_distance(mesh, std::vector{source_along({curve_along(mesh, chain, true).points, true})});
  for (Index v = 0; v < n; ++v) {
    EXPECT_GE(d[v], 0) << v;
    EXPECT_EQ(d[v], d[other(v)]) << v;
  }
  std::vector<Index> around{6, 7, 8, 13, 18, 17, 16, 11};  // of the middle, on the first sheet
  const std::vector<double> inside =
      signed_distance(mesh, std::vector{source_along({curve_along(mesh, around, true).points, true})});
  EXPECT_LT(inside[shared], 0);
  EXPECT_LT(inside[other(0)], 0);  // behind the pinch
  EXPECT_GT(inside[0], 0);
  // Behind a pinch that the curve passes on one sheet only there is no side.
  const std::vector<Index> past{shared, 13, 18, 17};
  EXPECT_THROW(signed_distance(mesh, std::vector{source_along({curve_along(mesh, past, true).points, true})}), Error);
}

}  // namespace
}  // namespace brushfire
