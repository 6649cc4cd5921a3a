// On a Delaunay triangulation of a convex region novotni-klein and carried-source are the Euclidean distance, wherever
// the source is.
#include <brushfire/mesh/delaunay.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/part_solver.h"

namespace brushfire {
namespace {

constexpr int kTriangulations = 1000;
constexpr double kRelative = 1e-11;
// Positions of sources are rounded to this where they are turned into coordinates (the region has size 2).
constexpr double kCoordinateRounding = 8 * std::numeric_limits<double>::epsilon();

Index below(Index n, std::mt19937& random) { return std::uniform_int_distribution<Index>(0, n - 1)(random); }

// Random points in an ellipse, sometimes with a ring of vertices around it, sometimes clustered.
Mesh random_convex_triangulation(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Index count = 5 + below(120, random);
  const double height = std::pow(10.0, -0.7 * unit(random));
  const double clustering = 0.3 + unit(random);
  std::vector<Vec2> points;
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * kPi * unit(random), radius = std::pow(unit(random), clustering);
    points.push_back({radius * std::cos(angle), height * radius * std::sin(angle)});
  }
  const Index ring = below(3, random) == 0 ? 4 + below(40, random) : 0;
  for (Index i = 0; i < ring; ++i) {
    points.push_back({std::cos(2 * kPi * i / ring), height * std::sin(2 * kPi * i / ring)});
  }
  return delaunay(points).mesh();
}

// A vertex, a point of an edge, a point of a face, or a point 1e-3 .. 1e-16 away from an edge or a vertex.
SurfacePoint random_source(const Mesh& mesh, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Index f = below(mesh.face_count(), random), k = below(3, random);
  const double tiny = std::pow(10.0, -3 - 13 * unit(random));
  SurfacePoint p{f, {0, 0, 0}};
  const double t = unit(random), s = unit(random);
  switch (below(5, random)) {
    case 0:
      p.weights[k] = 1;
      break;
    case 1:
      p.weights[k] = t, p.weights[(k + 1) % 3] = 1 - t;
      break;
    case 2:
      p.weights = {t * s, t * (1 - s), 1 - t};
      break;
    case 3:
      p.weights[k] = tiny, p.weights[(k + 1) % 3] = (1 - tiny) * t, p.weights[(k + 2) % 3] = (1 - tiny) * (1 - t);
      break;
    default:
      p.weights[k] = 1 - tiny, p.weights[(k + 1) % 3] = tiny * t, p.weights[(k + 2) % 3] = tiny * (1 - t);
  }
  return p;
}

double worst_excess(const Mesh& mesh, const SurfacePoint& source, const DistanceField& field) {
  const Vec3 from = position(mesh, source);
  double worst = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.corners(v).empty()) continue;
    const double euclid = norm(mesh.positions()[v] - from);
    worst = std::max(worst, std::abs(field.distance[v] - euclid) / (kRelative * euclid + kCoordinateRounding));
  }
  return worst;
}

TEST(PlanarExactness, DelaunayTriangulationsOfConvexRegionsAreExactFromSourcesAnywhere) {
  for (unsigned seed = 0; seed < kTriangulations; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = random_convex_triangulation(random);
    if (mesh.face_count() == 0) continue;
    DistanceSolver solver(mesh);
    DistanceOptions fast;
    fast.precision = Precision::Double;
    for (int run = 0; run < 3; ++run) {
      const Source source{random_source(mesh, random)};
      for (const Method method : {Method::NovotniKlein, Method::CarriedSource}) {
        fast.method = method;
        const DistanceField field = solver.distance({&source, 1}, fast);
        ASSERT_LE(worst_excess(mesh, source.point, field), 1)
            << name_of(method) << ", seed " << seed << ", run " << run;
        ASSERT_LE(field.updates, 3u * mesh.vertex_count()) << name_of(method) << ", seed " << seed;
      }
    }
  }
}

DistanceOptions in_double() {
  DistanceOptions options;
  options.method = Method::NovotniKlein;
  options.precision = Precision::Double;
  return options;
}

// Parts learn of each other by messages, and late.
TEST(PlanarExactness, PartsAreExactToo) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<Vec2> points;
    while (points.size() < 3000) {
      const Vec2 p{unit(random), unit(random)};
      if (dot(p, p) <= 1) points.push_back({p.x, seed % 2 == 0 ? p.y : 0.1 * p.y});
    }
    const Mesh mesh = delaunay(points).mesh();
    for (const Index part_size : {32u, 128u, 1024u}) {
      test::PartSolver solver(mesh, part_size);
      const Source source{random_source(mesh, random)};
      const DistanceField field = solver.distance({&source, 1}, in_double());
      EXPECT_LE(worst_excess(mesh, source.point, field), 1) << "seed " << seed << ", parts of " << part_size;
      EXPECT_LE(field.updates, 3u * mesh.vertex_count()) << "seed " << seed << ", parts of " << part_size;
    }
  }
}

// Parts of one vertex and some: what a vertex learns of its neighbours it learns by messages, and the number of its
// turns is limited.
TEST(PlanarExactness, TinyPartsAreHardlyEverInexact) {
  int inexact = 0, runs = 0;
  for (unsigned seed = 0; seed < kTriangulations; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = random_convex_triangulation(random);
    if (mesh.face_count() == 0) continue;
    for (const Index part_size : {1u, 4u, 16u}) {
      test::PartSolver solver(mesh, part_size);
      const Source source{random_source(mesh, random)};
      const DistanceField field = solver.distance({&source, 1}, in_double());
      ++runs;
      if (worst_excess(mesh, source.point, field) > 1) ++inexact;
    }
  }
  EXPECT_LE(inexact, runs / 500);
}

TEST(PlanarExactness, FloatLanesAreExactToFloatPrecision) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = random_convex_triangulation(random);
    if (mesh.face_count() == 0) continue;
    for (const Method method : {Method::NovotniKlein, Method::CarriedSource}) {
      DistanceOptions options;
      options.method = method;
      options.precision = Precision::Float;
      const Source source{vertex_point(mesh, mesh.faces()[0][0])};
      const DistanceField field = distance(mesh, {&source, 1}, options);
      EXPECT_LE(worst_excess(mesh, source.point, field) * kRelative, 1e-4) << name_of(method) << ", seed " << seed;
    }
  }
}

TEST(PlanarExactness, TargetsInsideFacesAndOnEdgesAreExactToo) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const Mesh mesh = random_convex_triangulation(random);
    if (mesh.face_count() == 0) continue;
    DistanceOptions options;
    options.method = Method::NovotniKlein;
    options.precision = Precision::Double;
    for (int i = 0; i < 20; ++i) options.targets.push_back(random_source(mesh, random));
    const Source source{random_source(mesh, random)};
    for (const Method method : {Method::NovotniKlein, Method::CarriedSource}) {
      options.method = method;
      const DistanceField field = distance(mesh, {&source, 1}, options);
      for (std::size_t i = 0; i < options.targets.size(); ++i) {
        const double euclid = norm(position(mesh, options.targets[i]) - position(mesh, source.point));
        EXPECT_NEAR(field.target_distance[i], euclid, 1e-9 * euclid + kCoordinateRounding)
            << name_of(method) << ", seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace brushfire
