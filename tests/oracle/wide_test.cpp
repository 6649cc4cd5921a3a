// The oracle in wide arithmetic where lengths differ by 1e12: planes and folded planes, whose distances are straight
// lines, and twice the digits.
#include "oracle/polyhedral.h"
#include "oracle/zoo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace brushfire::oracle {
namespace {

std::vector<Real> from(const Mesh& mesh, const SurfacePoint& p, Arithmetic arithmetic = Arithmetic::Quad) {
  const Source source{p, 0};
  return polyhedral_distance(mesh, std::span(&source, 1), kFar, {}, arithmetic).distance;
}

Real relative_error(Real a, Real b) { return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b)); }

// Rings around the origin, each `growth` times the one before, joined to a plane with a convex hull; every vertex a
// little off its place.
Mesh growing_rings(std::uint32_t seed, Index rings, Index sectors, double growth) {
  std::mt19937 random(seed);
  const auto wobble = [&] { return 0.1 * (static_cast<double>(random() % 1000) / 1000 - 0.5); };
  std::vector<Vec3> p{{0, 0, 0}};
  std::vector<Face> t;
  for (Index r = 0; r < rings; ++r) {
    for (Index k = 0; k < sectors; ++k) {
      const bool outermost = r + 1 == rings;
      const double angle = 2 * kPi * (k + (outermost ? 0 : wobble())) / sectors;
      const double radius = std::pow(growth, r) * (outermost ? 1 : 1 + wobble());
      p.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
      const Index here = 1 + r * sectors + k, next = 1 + r * sectors + (k + 1) % sectors;
      if (r == 0) {
        t.push_back({0, here, next});
      } else {
        t.push_back({here - sectors, here, next});
        t.push_back({here - sectors, next, next - sectors});
      }
    }
  }
  return Mesh(p, t);
}

TEST(WideOracle, PlanesOfAnyRatioAreCrossedStraight) {
  for (const double ratio : {1e3, 1e6, 1e9, 1e12, 1e15}) {
    constexpr Index kRings = 5, kSectors = 7;
    const Mesh mesh = growing_rings(3, kRings, kSectors, std::pow(ratio, 1.0 / (kRings - 1)));
    for (const Index source : {Index{0}, Index{2}, Index{11}, Index{33}}) {
      const auto d = from(mesh, vertex_point(mesh, source));
      const Vec3 a = mesh.positions()[source];
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 b = mesh.positions()[v];
        const Real expected = std::hypot(Real{a.x} - b.x, Real{a.y} - b.y);
        EXPECT_LT(relative_error(d[v], expected), 1e-17L) << ratio << ": " << source << " - " << v;
      }
    }
  }
}

// A carpet on stairs whose steps shrink by half: along the axes, so that laid flat its coordinates are exact.
TEST(WideOracle, CarpetsOnShrinkingStairsAreRolledOut) {
  constexpr int kSteps = 40;  // from 1 down to 1e-12
  std::vector<Vec3> p;
  std::vector<Face> t;
  std::vector<double> along;
  Vec3 at;
  double length = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const auto v = static_cast<Index>(p.size());
    p.push_back(at);
    p.push_back({at.x, 0.75, at.z});
    along.push_back(length);
    along.push_back(length);
    if (k > 0) {
      t.push_back({v - 2, v, v + 1});
      t.push_back({v - 2, v + 1, v - 1});
    }
    const double step = std::ldexp(1.0, -k);
    (k % 2 ? at.z : at.x) += step;
    length += step;
  }
  const Mesh mesh(p, t);
  for (const Index source : {Index{0}, Index{1}, Index{30}, Index{2 * kSteps}}) {
    const auto d = from(mesh, vertex_point(mesh, source));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Real expected = std::hypot(Real{along[v]} - along[source], Real{p[v].y} - p[source].y);
      EXPECT_LT(relative_error(d[v], expected), 1e-17L) << source << " - " << v;
    }
  }
}

TEST(WideOracle, PointsVeryNearAVertexKeepTheirDigits) {
  const Mesh mesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                  std::vector<Face>{{0, 1, 2}, {0, 2, 3}});
  for (const double near : {1e-3, 1e-7, 1e-11}) {
    const std::array<double, 3> w{near, 2 * near, 1 - 3 * near};  // near vertex 2
    const auto d = from(mesh, {0, w});
    const Real sum = Real{w[0]} + w[1] + w[2];
    const Real x = (Real{w[0]} + 0) / sum, y = (Real{w[0]} + w[1]) / sum;  // from (1, 1) to the left and down
    EXPECT_LT(relative_error(d[2], std::hypot(x, y)), 1e-17L) << near;
    EXPECT_LT(relative_error(d[3], std::hypot(1 - x, y)), 1e-17L) << near;
  }
}

TEST(WideOracle, LongDoubleQuadAndOctupleAgreeOnOrdinaryMeshes) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Mesh mesh = random_soup(seed, 6 + seed % 6, 6 + seed % 12, 1000);
    const SurfacePoint source = vertex_point(mesh, mesh.faces()[0][0]);
    const auto narrow = from(mesh, source, Arithmetic::LongDouble), wide = from(mesh, source, Arithmetic::Quad),
               widest = from(mesh, source, Arithmetic::Octuple);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_LT(relative_error(narrow[v], wide[v]), 1e-15L) << seed << ", vertex " << v;
      EXPECT_LT(relative_error(wide[v], widest[v]), 1e-18L) << seed << ", vertex " << v;
    }
  }
}

}  // namespace
}  // namespace brushfire::oracle
