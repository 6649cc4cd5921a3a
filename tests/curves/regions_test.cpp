// Regions as sources: 0 everywhere inside, and outside as far as the border.
#include <brushfire/core/error.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/curve_sources.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace brushfire {
namespace {

constexpr Index kColumns = 8, kRows = 5;

// Squares of side 1, two faces each; the region is the three columns on the left.
struct Strip {
  Mesh mesh = shapes::plane(kColumns, kRows, kColumns, kRows).mesh();
  CurveSource region;
  std::vector<SurfacePoint> middles;  // of all faces, and of all their edges

  Strip() {
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      middles.push_back({f, {0.2, 0.3, 0.5}});
      for (const auto& edge : {std::array{0.5, 0.5, 0.0}, std::array{0.0, 0.5, 0.5}, std::array{0.5, 0.0, 0.5}}) {
        middles.push_back({f, edge});
      }
      if (position(mesh, {f, {1.0 / 3, 1.0 / 3, 1.0 / 3}}).x < 3) faces.push_back(f);
    }
    region = region_of_faces(mesh, faces);
  }
  double truth(const SurfacePoint& p) const { return std::max(0.0, position(mesh, p).x - 3); }
};

TEST(Regions, AreZeroEverywhereInsideWithEveryMethod) {
  const Strip strip;
  for (const Method method : all_methods()) {
    if (method == Method::Heat) continue;
    DistanceOptions options{.method = method, .precision = Precision::Double};
    options.targets = strip.middles;
    const DistanceField field = distance(strip.mesh, std::vector{source_along(strip.region)}, options);
    const bool exact = method == Method::Exact || method == Method::Windows;
    for (std::size_t i = 0; i < strip.middles.size(); ++i) {
      const double truth = strip.truth(strip.middles[i]);
      if (truth == 0) {
        EXPECT_EQ(field.target_distance[i], 0) << name_of(method) << ", target " << i;
      }
      if (exact) {
        EXPECT_NEAR(field.target_distance[i], truth, 1e-12) << name_of(method) << ", target " << i;
      }
      EXPECT_EQ(field.target_source[i], 0u);
    }
  }
}

TEST(Regions, AreZeroWhereverAFieldIsAskedAndPathsEndThere) {
  const Strip strip;
  const DistanceField field =
      distance(strip.mesh, std::vector{source_along(strip.region)}, {.method = Method::Exact, .keep_windows = true});
  for (const SurfacePoint& p : strip.middles) {
    EXPECT_NEAR(field.windows->value(p).distance, strip.truth(p), 1e-12);
    const SurfacePath path = path_to(*field.windows, p);
    EXPECT_NEAR(path.length, strip.truth(p), 1e-12);
    ASSERT_FALSE(path.points.empty());
    if (strip.truth(p) == 0) {
      EXPECT_EQ(path.points.size(), 1u);
    }
  }
  // No offset of the border is drawn inside.
  for (const Isoline& line : curved_isolines(*field.windows, std::vector{0.1, 0.25, 2.0}, 1e-6)) {
    for (const SurfacePoint& p : line.line.points) EXPECT_NEAR(position(strip.mesh, p).x, 3 + line.level, 1e-9);
  }
}

// Another source, with less to begin with, is nearer in a part of the region.
TEST(Regions, ReadTheLeastOfTheirOffsetAndWhatOthersCome) {
  const Strip strip;
  const std::vector<Source> sources{source_along(strip.region, 1.5), {vertex_point(strip.mesh, 0)}};
  DistanceOptions options{.method = Method::Exact, .keep_windows = true};
  options.targets = strip.middles;
  const DistanceField field = distance(strip.mesh, sources, options);
  for (std::size_t i = 0; i < strip.middles.size(); ++i) {
    const Vec3 p = position(strip.mesh, strip.middles[i]);
    const double truth = std::min(1.5 + strip.truth(strip.middles[i]), norm(p - strip.mesh.positions()[0]));
    EXPECT_NEAR(field.target_distance[i], truth, 1e-12) << i;
    EXPECT_NEAR(field.windows->value(strip.middles[i]).distance, truth, 1e-12) << i;
  }
}

TEST(Regions, BehindWallsAreWhatIsOpenOfThem) {
  const Strip strip;
  std::vector<Index> walls;  // the leftmost column
  for (Index f = 0; f < strip.mesh.face_count(); ++f) {
    if (position(strip.mesh, {f, {1.0 / 3, 1.0 / 3, 1.0 / 3}}).x < 1) walls.push_back(f);
  }
  const Domain domain(strip.mesh, {.faces = walls});
  DistanceOptions options{.method = Method::Exact};
  options.targets = strip.middles;
  const DistanceField field = distance(domain, std::vector{source_along(strip.region)}, options);
  for (std::size_t i = 0; i < strip.middles.size(); ++i) {
    const double x = position(strip.mesh, strip.middles[i]).x;
    if (x < 1) {
      EXPECT_EQ(field.target_distance[i], kInfinity) << i;
    }
    if (x > 1) {
      EXPECT_NEAR(field.target_distance[i], strip.truth(strip.middles[i]), 1e-12) << i;
    }
  }
}

TEST(Regions, AreReadOnEverySheetOfCopies) {
  const Strip strip;
  std::vector<Face> faces(strip.mesh.faces().begin(), strip.mesh.faces().end());
  const std::size_t count = faces.size();
  for (std::size_t f = 0; f < count; ++f) faces.push_back({faces[f][1], faces[f][0], faces[f][2]});
  const Mesh twice(std::vector<Vec3>(strip.mesh.positions().begin(), strip.mesh.positions().end()), faces);
  CurveSource region = strip.region;
  DistanceOptions options{.method = Method::Exact, .keep_windows = true};
  options.targets = strip.middles;
  const DistanceField field = distance(twice, std::vector{source_along(region)}, options);
  for (std::size_t i = 0; i < strip.middles.size(); ++i) {
    EXPECT_NEAR(field.target_distance[i], strip.truth(strip.middles[i]), 1e-12) << i;
    EXPECT_NEAR(field.windows->value(strip.middles[i]).distance, strip.truth(strip.middles[i]), 1e-12) << i;
  }
}

TEST(Regions, RefuseFacesThatAreNotThereAndOffsetsThatChange) {
  Strip strip;
  CurveSource beyond = strip.region;
  beyond.inside.push_back(strip.mesh.face_count());
  EXPECT_THROW(locate(strip.mesh, beyond), Error);
  strip.region.offsets.assign(strip.region.places.size(), 0);
  EXPECT_NO_THROW(locate(strip.mesh, strip.region));
  strip.region.offsets[0] = 0.5;
  EXPECT_THROW(locate(strip.mesh, strip.region), Error);
}

}  // namespace
}  // namespace brushfire
