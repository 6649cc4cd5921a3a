// Shortest paths to curves.
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "curves/random_curves.h"
#include "curves/surfaces.h"

namespace brushfire {
namespace {

// Where a path begins, at the curve: how far from the curve that is, the curve's offset there, and by how much the path
// misses the right angle (or what the slope of the offsets makes of it), in radians; 0 at places.
struct Ending {
  double away = kInfinity, offset = 0, miss = kInfinity;
};

Ending ending(const Mesh& mesh, const CurveSource& curve, const SurfacePath& path) {
  constexpr double kThere = 1e-9;
  const Vec3 end = position(mesh, path.points.front());
  const Vec3 before = path.points.size() > 1 ? position(mesh, path.points[1]) : end;
  Ending best;
  for (const CurveSegment& s : locate(mesh, curve).segments) {
    const Vec3 a = position(mesh, {s.face, s.from}), b = position(mesh, {s.face, s.to});
    const Vec3 along = (1 / norm(b - a)) * (b - a);
    const double t = std::clamp(dot(end - a, along), 0.0, s.length), away = norm(end - (a + t * along));
    const double slope = (s.to_offset - s.from_offset) / s.length, way = norm(before - end);
    const bool at_place = std::min(t, s.length - t) < kThere;
    const double miss =
        at_place || !(way > kThere)
            ? 0
            : std::abs(std::asin(std::clamp(dot(before - end, along) / way, -1.0, 1.0)) - std::asin(slope));
    if (away > kThere || (best.away <= kThere && miss >= best.miss)) continue;
    best = {away, s.from_offset + slope * t, miss};
  }
  if (curve.places.size() == 1) best = {norm(end - position(mesh, curve.places[0])), 0, 0};
  return best;
}

void expect_good_paths(const Mesh& mesh, const CurveSource& curve, const std::string& what) {
  const DistanceField field =
      distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact, .keep_paths = true});
  const double least = locate(mesh, curve).least_offset;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (field.distance[v] == kInfinity) continue;
    SCOPED_TRACE(what + ", vertex " + std::to_string(v));
    const SurfacePath path = path_to(*field.windows, vertex_point(mesh, v));
    ASSERT_FALSE(path.points.empty());
    const Ending end = ending(mesh, curve, path);
    ASSERT_LE(end.away, 1e-9);
    EXPECT_NEAR(length_of(mesh, path.points) + end.offset, field.distance[v],
                1e-10 * (field.distance[v] - least) + field.error_bound[v]);
    EXPECT_LE(end.miss, 1e-5);
  }
}

TEST(PathsToCurves, AreAsLongAsTheFieldAndMeetCurvesAtRightAnglesOrAtPlaces) {
  for (const auto& [name, mesh] : test::small_surfaces()) {
    for (unsigned seed = 0; seed < 8; ++seed) {
      std::mt19937 random(seed);
      CurveSource curve;
      curve.places = test::random_walk(mesh, 1 + static_cast<int>(random() % 8), random);
      if (locate(mesh, curve).segments.empty()) continue;
      expect_good_paths(mesh, curve, name + ", seed " + std::to_string(seed));
      test::give_offsets(mesh, curve, random);
      expect_good_paths(mesh, curve, name + " with offsets, seed " + std::to_string(seed));
    }
  }
}

}  // namespace
}  // namespace brushfire
