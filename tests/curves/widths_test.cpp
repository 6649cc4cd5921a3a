// Curves in wider numbers, and on doubled sheets.
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "curves/random_curves.h"
#include "curves/surfaces.h"
#include "support/engine_run.h"

namespace brushfire {
namespace {

CurveSource walk_on(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  CurveSource curve;
  curve.places = test::random_walk(mesh, 3 + static_cast<int>(random() % 8), random);
  if (seed % 2 == 1) test::give_offsets(mesh, curve, random);
  return curve;
}

TEST(CurvesInWideNumbers, ReadWhatTheyReadInDoubles) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    const auto narrow = windows::in_doubles::make_engine(mesh, 31, windows::Merging::Always);
    const auto wide = windows::in_double_doubles::make_engine(mesh, 31, windows::Merging::Always);
    for (unsigned seed = 0; seed < 4; ++seed) {
      const std::vector<Source> sources{source_along(walk_on(mesh, seed))};
      for (const DistanceOptions& how :
           {DistanceOptions{.method = Method::Exact}, DistanceOptions{.tolerance = 1e-3}}) {
        const DistanceField a = test::run(*narrow, mesh, sources, how), b = test::run(*wide, mesh, sources, how);
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          if (a.distance[v] == kInfinity && b.distance[v] == kInfinity) continue;
          ASSERT_NEAR(a.distance[v], b.distance[v], a.error_bound[v] + b.error_bound[v]) << name << ", seed " << seed;
        }
      }
    }
  }
}

// A plane of which some faces are a millionth as high as others are.
TEST(CurvesInWideNumbers, AreExactWhereLengthsDifferMuch) {
  Shape strip = shapes::plane(8, 12);
  for (std::size_t v = 0; v < strip.positions.size(); ++v) {
    const double row = static_cast<double>(v / 9);
    strip.positions[v].y = row < 6 ? 1e-6 * row : row - 5;
  }
  const Mesh mesh = strip.mesh();
  for (unsigned seed = 0; seed < 30; ++seed) {
    const CurveSource curve = walk_on(mesh, seed);
    const DistanceField field =
        distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact, .keep_paths = true});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double truth = test::planar_distance(mesh, curve, mesh.positions()[v]);
      EXPECT_NEAR(field.distance[v], truth, 1e-12 * truth + 1e-14) << "seed " << seed << ", vertex " << v;
      EXPECT_FALSE(path_to(*field.windows, vertex_point(mesh, v)).points.empty());
    }
  }
}

// Every face three times, in any order of its corners: the field is that of the single surface.
TEST(CurvesOnCopiesOfFaces, ReadWhatTheyReadOnOne) {
  for (const auto& [name, single] : test::small_surfaces()) {
    std::vector<Face> faces;
    for (const Face& f : single.faces()) {
      faces.push_back(f);
      faces.push_back({f[1], f[2], f[0]});
      faces.push_back({f[2], f[1], f[0]});
    }
    const Mesh mesh(single.positions(), faces);
    for (unsigned seed = 0; seed < 4; ++seed) {
      CurveSource curve = walk_on(single, seed), copied = curve;
      for (SurfacePoint& p : copied.places) {
        const auto [a, b, c] = p.weights;
        p = seed % 2 == 0 ? SurfacePoint{3 * p.face + 1, {b, c, a}} : SurfacePoint{3 * p.face + 2, {c, b, a}};
      }
      const DistanceField one = distance(single, std::vector{source_along(curve)}, {.method = Method::Exact});
      const DistanceField three =
          distance(mesh, std::vector{source_along(copied)}, {.method = Method::Exact, .keep_paths = true});
      for (Index v = 0; v < single.vertex_count(); ++v) {
        if (one.distance[v] == kInfinity) continue;
        ASSERT_NEAR(three.distance[v], one.distance[v], one.error_bound[v]) << name << ", seed " << seed;
        ASSERT_FALSE(path_to(*three.windows, vertex_point(mesh, v)).points.empty()) << name << ", seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace brushfire
