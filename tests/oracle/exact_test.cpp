// Method::Exact against every truth there is: the oracle, visibility graphs, closed forms, its own metric laws.
#include "oracle/closed_forms.h"
#include "oracle/deviation.h"
#include "oracle/planar_domain.h"
#include "oracle/zoo.h"
#include "support/shared_meshes.h"

#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace brushfire::oracle {
namespace {

constexpr double kPromise = 1e-12;  // relative, of the exact method

std::vector<double> exact(const Mesh& mesh, std::span<const Source> sources, double radius = kInfinity) {
  return distance(mesh, sources, exact_options(radius)).distance;
}

std::vector<double> exact_from(const Mesh& mesh, const SurfacePoint& p) {
  const Source source{p, 0};
  return exact(mesh, std::span(&source, 1));
}

std::vector<Source> one_of_each(const Mesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  return {{random_vertex(mesh, random), 0}, {random_edge_point(mesh, random), 0}, {random_face_point(mesh, random), 0}};
}

// From a vertex, an edge point and a face point, and from all three with offsets; targets of every kind.
Deviation from_all_kinds(const Mesh& mesh, std::uint32_t seed) {
  std::vector<Source> sources = one_of_each(mesh, seed);
  std::mt19937 random(seed + 1000);
  const std::vector<SurfacePoint> targets{random_vertex(mesh, random), random_edge_point(mesh, random),
                                          random_face_point(mesh, random), random_face_point(mesh, random)};
  Deviation worst;
  for (const Source& s : sources) worst.add(exact_against_oracle(mesh, std::span(&s, 1), kInfinity, targets));
  const double size = mesh.unit();
  sources[0].offset = 0.25 * size;
  sources[1].offset = -0.5 * size;
  worst.add(exact_against_oracle(mesh, sources, kInfinity, targets));
  return worst;
}

TEST(Exact, EqualsTheOracleOnAwkwardMeshes) {
  for (const Specimen& s : awkward_meshes()) {
    if (s.mesh.report().zero_area_faces > 0) continue;  // flat_faces_test.cpp
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      const Deviation d = from_all_kinds(s.mesh, seed);
      EXPECT_TRUE(d.within(kPromise)) << s.name << ", seed " << seed << ": " << d.text();
    }
  }
}

TEST(Exact, EqualsTheOracleOnRandomSoups) {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    const Mesh mesh = random_soup(seed, 5 + seed % 9, 4 + seed % 21, 100'000);
    const Deviation d = from_all_kinds(mesh, seed);
    EXPECT_TRUE(d.within(kPromise)) << "seed " << seed << ": " << d.text();
  }
}

TEST(Exact, EqualsTheOracleOnRandomIntrinsicComplexes) {
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    const Mesh mesh = random_intrinsic(seed, 5 + seed % 13, 6 + seed % 40);
    const Deviation d = from_all_kinds(mesh, seed);
    EXPECT_TRUE(d.within(kPromise)) << "seed " << seed << ": " << d.text();
  }
}

TEST(Exact, EqualsTheVisibilityGraphInDomainsWithHoles) {
  for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
    std::mt19937 random(seed);
    const PlanarDomain domain = random_domain(random, 5 + static_cast<int>(seed % 4), 9, seed % 3 == 0);
    const DomainPoint source = random_point(domain, random);
    const Deviation d = deviation(exact_from(domain.mesh(), source.on), visibility_distances(domain, source.at));
    EXPECT_TRUE(d.within(kPromise)) << "seed " << seed << ": " << d.text();
  }
}

TEST(Exact, RightTriangleAndRhombusHaveTheirSides) {
  const Mesh triangle(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<Face>{{0, 1, 2}});
  EXPECT_EQ(exact_from(triangle, vertex_point(triangle, 0)), (std::vector<double>{0, 1, 1}));
  const Mesh rhombus(std::vector<Vec3>{{0, 0, 0}, {1.5, 0.5, 0}, {3, 0, 0}, {1.5, -0.5, 0}},
                     std::vector<Face>{{0, 3, 1}, {1, 3, 2}});
  EXPECT_EQ(exact_from(rhombus, vertex_point(rhombus, 0))[2], 3.0);
}

TEST(Exact, ConesAreRolledOut) {
  for (const double height : {0.0, 0.3, 1.0, 5.0}) {
    constexpr Index kRings = 5, kSegments = 12;
    const Mesh mesh = shapes::cone(kRings, kSegments, 1, height).mesh();
    const Real slant = std::hypot(Real{1}, Real{height});
    const Real sector = 2 * std::asin(std::sin(kHalfTurn / kSegments) / slant);
    const auto radius = [&](Index v) { return v == 0 ? 0 : slant * ((v - 1) / kSegments + 1) / kRings; };
    for (const Index source : {Index{0}, Index{1}, Index{30}, Index{60}}) {
      const auto d = exact_from(mesh, vertex_point(mesh, source));
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Index slot = v == 0 || source == 0 ? 0 : (v + 6 * kSegments - source) % kSegments;
        const Real expected = cone_distance(radius(source), radius(v), slot * sector, kSegments * sector);
        EXPECT_LE(std::abs(d[v] - expected), kPromise * expected) << height << ": " << source << " - " << v;
      }
    }
  }
}

// Apex angles of 2 pi exactly, just below and above, 3 pi and 5 pi.
TEST(Exact, SaddleConesSendPathsThroughTheirApex) {
  for (const Real total : {2 * kHalfTurn, 2 * kHalfTurn - 1e-9L, 2 * kHalfTurn + 1e-9L, 3 * kHalfTurn, 5 * kHalfTurn}) {
    constexpr Index kCount = 18;
    const Real sector = total / kCount;
    const auto chord = static_cast<double>(2 * std::sin(sector / 2));
    std::vector<Face> faces;
    for (Index k = 0; k < kCount; ++k) faces.push_back({0, 1 + k, 1 + (k + 1) % kCount});
    const std::vector<std::array<double, 3>> lengths(kCount, {1.0, chord, 1.0});
    const Mesh mesh = Mesh::from_lengths(kCount + 1, faces, lengths);
    const Real real_sector = 2 * std::asin(Real{chord} / 2);
    const auto d = exact_from(mesh, vertex_point(mesh, 1));
    for (Index v = 1; v <= kCount; ++v) {
      const Real expected = cone_distance(1, 1, (v - 1) * real_sector, kCount * real_sector);
      EXPECT_LE(std::abs(d[v] - expected), kPromise * expected) << static_cast<double>(total) << " vertex " << v;
    }
  }
}

TEST(Exact, CylindersAreRolledOut) {
  constexpr Index kRings = 6, kSegments = 14;
  const Mesh mesh = shapes::cylinder(kRings, kSegments, 1, 3).mesh();
  const Real side = 2 * std::sin(kHalfTurn / kSegments);
  for (const Index source : {Index{0}, Index{45}}) {
    const auto d = exact_from(mesh, vertex_point(mesh, source));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Index slot = (v + kSegments - source % kSegments) % kSegments;
      const Real rise = 3.0L * (Real{1} * (v / kSegments) - source / kSegments) / kRings;
      const Real expected = cylinder_distance(std::min(slot, kSegments - slot) * side, rise);
      EXPECT_LE(std::abs(d[v] - expected), kPromise * expected) << source << " - " << v;
    }
  }
}

TEST(Exact, CubeIsTheLeastOfItsUnfoldings) {
  for (const Index cells : {1u, 2u, 4u, 5u}) {
    const Shape cube = shapes::cube(cells);
    const Mesh mesh = cube.mesh();
    std::mt19937 random(cells);
    for (int k = 0; k < 12; ++k) {
      const SurfacePoint p = k % 3 == 0 ? random_vertex(mesh, random)
                             : k % 3 == 1
                                 ? random_edge_point(mesh, random)
                                 : SurfacePoint{static_cast<Index>(random() % mesh.face_count()), {0.25, 0.5, 0.25}};
      const Vec3 from = position(mesh, p);
      const auto d = exact_from(mesh, p);
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Real expected = cube_distance(from, cube.positions[v]);
        EXPECT_LE(std::abs(d[v] - expected), kPromise * expected)
            << cells << " cells, source " << k << ", vertex " << v;
      }
    }
  }
}

TEST(Exact, FlatTorusFromLengthsHasTheDistancesOfTheLattice) {
  for (const Index n : {3u, 4u, 8u, 11u}) {
    const Index rows = n + 2;
    const Real width = 3, height = 2;
    const Mesh mesh = flat_torus(n, rows, 3, 2);
    const auto d = exact_from(mesh, vertex_point(mesh, 0));
    for (Index v = 1; v < mesh.vertex_count(); ++v) {
      const Real x = width / n * (v % n), y = height / rows * (v / n);
      const Real expected = std::hypot(std::min(x, width - x), std::min(y, height - y));
      EXPECT_LE(std::abs(d[v] - expected), kPromise * expected) << n << " vertex " << v;
    }
  }
}

// The nearest-point map of a convex body does not stretch, so no polyhedral distance exceeds the great circle; the
// central projection stretches by no more than 1 / (least distance of a face plane from the centre).
TEST(Exact, InscribedSphereIsBoundedByGreatCircles) {
  const Shape sphere = shapes::icosphere(4);
  const Mesh mesh = sphere.mesh();
  double inner = 1;
  for (const Face& t : sphere.faces) {
    const Vec3 a = sphere.positions[t[0]];
    const Vec3 n = cross(sphere.positions[t[1]] - a, sphere.positions[t[2]] - a);
    inner = std::min(inner, dot(a, n) / norm(n));
  }
  const auto d = exact_from(mesh, vertex_point(mesh, 5));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 a = sphere.positions[5], b = sphere.positions[v];
    const double great = std::atan2(norm(cross(a, b)), dot(a, b));
    EXPECT_LE(d[v], great * (1 + 1e-12));
    EXPECT_GE(d[v], great * inner * (1 - 1e-12));
  }
}

TEST(Exact, GridsOfTiesEqualThePlane) {
  for (const double shear : {0.0, 0.5, 1.0, 3.0}) {
    Shape grid = shapes::plane(24, 24, 24, 24);
    for (Vec3& p : grid.positions) p.x += shear * p.y;
    const Mesh mesh = grid.mesh();
    for (const Index source : {Index{0}, Index{12 * 25 + 12}, Index{24}}) {
      const auto d = exact_from(mesh, vertex_point(mesh, source));
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 u = grid.positions[v] - grid.positions[source];
        const Real expected = std::hypot(Real{u.x}, Real{u.y});
        EXPECT_LE(std::abs(d[v] - expected), kPromise * expected) << shear << ": " << source << " - " << v;
      }
    }
  }
}

TEST(Exact, NeedlesKeepThePromise) {
  for (const double altitude : {1e-2, 1e-4, 1e-6, 1e-8}) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
      const Mesh mesh = needle_grid(seed, 8, altitude);
      const Deviation d = from_all_kinds(mesh, seed);
      EXPECT_TRUE(d.within(kPromise)) << altitude << ", seed " << seed << ": " << d.text();
    }
  }
}

TEST(Exact, SourcesArbitrarilyNearAnEdgeOrVertexKeepThePromise) {
  const Mesh mesh = awkward_meshes()[16].mesh;  // the spiky sheet
  for (const double near : {1e-3, 1e-6, 1e-9, 1e-11, 1e-13, 1e-16}) {
    for (const Index face : {Index{40}, Index{77}}) {
      for (const auto& w : {std::array{near, 0.4, 0.6 - near}, std::array{1 - 2 * near, near, near}}) {
        const Source source{{face, w}, 0};
        const Deviation d = exact_against_oracle(mesh, std::span(&source, 1));
        EXPECT_TRUE(d.within(kPromise)) << near << " face " << face << ": " << d.text();
      }
    }
  }
}

TEST(Exact, ScaleOfTheCoordinatesDoesNotMatter) {
  const Shape sheet = [] {
    Shape s = shapes::noise_terrain(9, 9, 0.5, 3);
    return s;
  }();
  const auto reference = exact_from(sheet.mesh(), {17, {0.25, 0.5, 0.25}});
  for (const int exponent : {-600, -100, 100, 500}) {
    Shape scaled = sheet;
    for (Vec3& p : scaled.positions) p = std::ldexp(1.0, exponent) * p;
    const auto d = exact_from(scaled.mesh(), {17, {0.25, 0.5, 0.25}});
    for (std::size_t v = 0; v < d.size(); ++v) EXPECT_EQ(d[v], std::ldexp(reference[v], exponent));
  }
}

TEST(Exact, DistancesAreAMetric) {
  std::vector<Specimen> all = awkward_meshes();
  for (std::uint32_t seed = 400; seed < 430; ++seed) {
    all.push_back({"soup " + std::to_string(seed), random_soup(seed, 12, 20, 1000)});
    all.push_back({"intrinsic " + std::to_string(seed), random_intrinsic(seed, 12, 30)});
  }
  for (const Specimen& s : all) {
    if (s.mesh.report().zero_area_faces > 0) continue;  // flat_faces_test.cpp
    std::vector<Index> pick;
    for (Index v = 0; v < s.mesh.vertex_count() && pick.size() < 24; ++v) {
      if (!s.mesh.corners(v).empty()) pick.push_back(v);
    }
    std::vector<std::vector<double>> d;
    for (const Index v : pick) d.push_back(exact_from(s.mesh, vertex_point(s.mesh, v)));
    for (std::size_t a = 0; a < pick.size(); ++a) {
      for (std::size_t b = 0; b < pick.size(); ++b) {
        const double ab = d[a][pick[b]], ba = d[b][pick[a]];
        ASSERT_TRUE(ab == ba || std::abs(ab - ba) <= kPromise * ab) << s.name << ": " << pick[a] << " - " << pick[b];
        for (std::size_t c = 0; c < pick.size(); ++c) {
          const double detour = d[a][pick[c]] + d[c][pick[b]];
          ASSERT_TRUE(ab <= detour * (1 + kPromise)) << s.name << ": " << pick[a] << ' ' << pick[b] << ' ' << pick[c];
        }
      }
    }
  }
}

TEST(Exact, SeveralSourcesGiveTheLeastOfTheirSingleFields) {
  for (const Specimen& s : awkward_meshes()) {
    std::mt19937 random(9);
    std::vector<Source> sources;
    for (int k = 0; k < 5; ++k) {
      sources.push_back({k % 3 == 0   ? random_vertex(s.mesh, random)
                         : k % 3 == 1 ? random_edge_point(s.mesh, random)
                                      : random_face_point(s.mesh, random),
                         0.1 * (k % 4) * s.mesh.unit()});
    }
    const DistanceField together = distance(s.mesh, sources, exact_options());
    std::vector<std::vector<double>> single;
    for (const Source& source : sources) single.push_back(exact(s.mesh, std::span(&source, 1)));
    for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
      double least = kInfinity;
      for (const auto& d : single) least = std::min(least, d[v]);
      const double got = together.distance[v];
      ASSERT_TRUE(got == least || std::abs(got - least) <= kPromise * std::max(least, 0.1 * s.mesh.unit()))
          << s.name << " vertex " << v;
      if (least == kInfinity) {
        EXPECT_EQ(together.source[v], kNoIndex);
      } else {
        const double named = single[together.source[v]][v];
        EXPECT_LE(named, least + kPromise * std::max(least, 0.1 * s.mesh.unit())) << s.name << " vertex " << v;
      }
    }
  }
}

TEST(Exact, InfinityIsExactlyWhereNothingLeads) {
  std::vector<Specimen> all = awkward_meshes();
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    all.push_back({"sparse soup " + std::to_string(seed), random_soup(seed, 30, 12, 999)});
  }
  if (test::has_shared_data()) {
    for (const std::string name : {"nm-bowtie", "nm-fin", "teapot", "beetle", "two-comp", "degen-sliver"}) {
      all.push_back({name, test::shared_mesh(name)});
    }
  }
  for (const Specimen& s : all) {
    for (const Source& source : one_of_each(s.mesh, 3)) {
      const auto expected = reachable(s.mesh, std::span(&source, 1));
      const auto d = exact(s.mesh, std::span(&source, 1));
      for (Index v = 0; v < s.mesh.vertex_count(); ++v) {
        ASSERT_FALSE(std::isnan(d[v])) << s.name << " vertex " << v;
        ASSERT_EQ(d[v] < kInfinity, expected[v]) << s.name << " vertex " << v;
      }
    }
  }
}

double seconds_of(const Mesh& mesh, const SurfacePoint& source) {
  const std::clock_t begin = std::clock();
  const auto d = exact_from(mesh, source);
  for (const double x : d) EXPECT_TRUE(x >= 0 && x < kInfinity);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// Bounds in seconds of processor time, ten times what a release build takes, so that a sanitizer passes.
TEST(Exact, FansOfTenThousandTrianglesTakeSeconds) {
  for (const bool closed : {true, false}) {
    const Mesh mesh = closed ? fan(10'000, true, 0.3, 3) : fan(10'000, false);
    EXPECT_LT(seconds_of(mesh, vertex_point(mesh, 0)), 10) << closed;
    EXPECT_LT(seconds_of(mesh, vertex_point(mesh, 1)), 10) << closed;
    EXPECT_LT(seconds_of(mesh, {5000, {0.25, 0.25, 0.5}}), 10) << closed;
  }
}

TEST(Exact, StripsOfAHundredThousandTrianglesTakeSeconds) {
  for (const double step : {1.0, 1e-3}) {
    const Mesh mesh = strip(100'000, step);
    EXPECT_LT(seconds_of(mesh, vertex_point(mesh, 0)), 20) << step;
    EXPECT_LT(seconds_of(mesh, {50'000, {0.25, 0.25, 0.5}}), 20) << step;
  }
}

TEST(Exact, EqualsTheKnownDistancesOfSmallRealMeshes) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const test::SharedTruth& t : test::shared_truths()) {
    const Mesh mesh = test::shared_mesh(t.name);
    if (mesh.vertex_count() > 11'000) continue;
    const auto known = test::shared_truth(t.name, t.source);
    const std::vector<Real> truth(known.begin(), known.end());
    const Deviation d = deviation(exact_from(mesh, vertex_point(mesh, t.source)), truth);
    EXPECT_TRUE(d.within(kPromise)) << t.name << " from " << t.source << ": " << d.text();
  }
}

}  // namespace
}  // namespace brushfire::oracle
