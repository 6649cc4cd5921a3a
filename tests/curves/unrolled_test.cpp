// Curves on surfaces whose distances are known: cylinders and cones laid flat, great circles; and on meshes with other
// numbers, and on real ones.
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/surface_curves.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "curves/random_curves.h"
#include "curves/samples.h"
#include "curves/surfaces.h"
#include "support/shared_meshes.h"

namespace brushfire {
namespace {

CurveSource along(const Mesh& mesh, const std::vector<Index>& vertices, bool closed = false) {
  return {curve_along(mesh, vertices, closed).points, closed};
}

std::vector<double> exact(const Mesh& mesh, const CurveSource& curve) {
  return distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact}).distance;
}

TEST(CurvesUnrolled, RingsAndLinesOnACylinder) {
  constexpr Index kRings = 12, kSegments = 9;
  const Mesh mesh = shapes::cylinder(kRings, kSegments, 1, 3).mesh();
  std::vector<Index> ring(kSegments), line(kRings + 1);
  for (Index j = 0; j < kSegments; ++j) ring[j] = 5 * kSegments + j;
  for (Index i = 0; i <= kRings; ++i) line[i] = i * kSegments;
  const std::vector<double> from_ring = exact(mesh, along(mesh, ring, true)),
                            from_line = exact(mesh, along(mesh, line));
  const double chord = 2 * std::sin(kPi / kSegments);
  for (Index i = 0; i <= kRings; ++i) {
    for (Index j = 0; j < kSegments; ++j) {
      const double up = std::abs(static_cast<double>(i) - 5) * 3 / kRings;
      EXPECT_NEAR(from_ring[i * kSegments + j], up, 1e-12 * up + 1e-15);
      const double around = chord * std::min(j, kSegments - j);
      EXPECT_NEAR(from_line[i * kSegments + j], around, 1e-12 * around + 1e-15);
    }
  }
}

TEST(CurvesUnrolled, ALineFromTheApexOfACone) {
  constexpr Index kRings = 6, kSegments = 14;
  const Mesh mesh = shapes::cone(kRings, kSegments, 1, 0.8).mesh();
  std::vector<Index> line{0};
  for (Index i = 0; i < kRings; ++i) line.push_back(1 + i * kSegments);
  const std::vector<double> d = exact(mesh, along(mesh, line));
  const double slant = std::sqrt(1 + 0.8 * 0.8), step = 2 * std::asin(std::sin(kPi / kSegments) / slant);
  for (Index i = 0; i < kRings; ++i) {
    for (Index j = 0; j < kSegments; ++j) {
      const double r = slant * (i + 1) / kRings, angle = step * std::min(j, kSegments - j);
      const double truth = angle < 0.5 * kPi ? r * std::sin(angle) : r;
      EXPECT_NEAR(d[1 + i * kSegments + j], truth, 1e-12 * truth + 1e-15) << "ring " << i << ", segment " << j;
    }
  }
}

// The largest difference from the latitude.
double error_of_equator(Index stacks) {
  const Index slices = 2 * stacks;
  const Mesh mesh = shapes::latlong_sphere(stacks, slices).mesh();
  std::vector<Index> equator(slices);
  std::iota(equator.begin(), equator.end(), 1 + (stacks / 2 - 1) * slices);
  const std::vector<double> d = exact(mesh, along(mesh, equator, true));
  double worst = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    worst = std::max(worst, std::abs(d[v] - std::abs(std::asin(std::clamp(mesh.positions()[v].z, -1.0, 1.0)))));
  }
  return worst;
}

TEST(CurvesUnrolled, AGreatCircleIsAsFarAsTheLatitudeInSecondOrder) {
  const double coarse = error_of_equator(16), fine = error_of_equator(32);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, coarse / 3.5);
}

TEST(Curves, DoNotDependOnTheNumbersOfVerticesAndFaces) {
  std::mt19937 random(77);
  for (const auto& [name, mesh] : test::small_surfaces()) {
    std::vector<Index> vertices(mesh.vertex_count()), face_rank(mesh.face_count()), vertex_rank(mesh.vertex_count());
    std::iota(vertices.begin(), vertices.end(), 0U);
    std::iota(face_rank.begin(), face_rank.end(), 0U);
    std::shuffle(vertices.begin(), vertices.end(), random);
    std::shuffle(face_rank.begin(), face_rank.end(), random);
    for (Index i = 0; i < vertices.size(); ++i) vertex_rank[vertices[i]] = i;
    const Mesh other = mesh.renumbered(vertices, vertex_rank, face_rank);
    CurveSource curve, there;
    curve.places = there.places = test::random_walk(mesh, 9, random);
    for (SurfacePoint& p : there.places) p.face = face_rank[p.face];
    const DistanceField a = distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact});
    const std::vector<double> b = exact(other, there);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (a.distance[v] == kInfinity && b[vertex_rank[v]] == kInfinity) continue;
      EXPECT_NEAR(a.distance[v], b[vertex_rank[v]], a.error_bound[v]) << name << ", vertex " << v;
    }
  }
}

// On real meshes: dense samples are no nearer, and no farther than half their spacing.
TEST(CurvesOnScans, AreNeverFartherThanSamples) {
  for (const char* name : {"cow.ply", "fandisk.ply", "nm-fin.ply", "camelhead.ply", "3holes.ply"}) {
    const std::filesystem::path file = std::filesystem::path(BRUSHFIRE_SHARED_DIR) / "meshes" / name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    const Mesh mesh = read_mesh(file.string()).mesh;
    std::mt19937 random(4);
    CurveSource curve;
    curve.places = test::random_walk(mesh, 30, random);
    const DistanceField field =
        distance(mesh, std::vector{source_along(curve)}, {.method = Method::Exact, .max_distance = mesh.unit() * 12});
    constexpr int kPieces = 20;
    const double spacing = test::longest_segment(mesh, curve) / kPieces;
    const DistanceField sampled = distance(mesh, test::samples(mesh, curve, kPieces),
                                           {.method = Method::Exact, .max_distance = mesh.unit() * 12 + spacing});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (field.distance[v] == kInfinity) continue;
      EXPECT_LE(field.distance[v], sampled.distance[v] + field.error_bound[v] + sampled.error_bound[v]) << name << v;
      EXPECT_GE(field.distance[v], sampled.distance[v] - 0.5 * spacing - field.error_bound[v]) << name << v;
    }
  }
}

}  // namespace
}  // namespace brushfire
