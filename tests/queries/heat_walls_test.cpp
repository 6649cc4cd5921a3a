// Heat within walls: what its solvers give on a mesh that was cut apart by hand; nothing passes.
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/heat.h>
#include <brushfire/solvers/heat/cholesky.h>
#include <brushfire/solvers/laplacian.h>
#include <brushfire/solvers/signed_heat.h>
#include <brushfire/solvers/vector_heat.h>

#include "random_walls.h"

#include <gtest/gtest.h>

#include <complex>
#include <random>
#include <set>

namespace brushfire {
namespace {

using test::ByHand;
using test::difference;
using test::kRounding;
using Complex = std::complex<double>;

class HeatWalls : public testing::Test {
 protected:
  void SetUp() override {
    if (!heat::can_factor()) GTEST_SKIP() << "this build has no Eigen";
  }
};

// A case, its domain, and the same cut apart by hand.
struct Walled {
  explicit Walled(unsigned seed)
      : random(seed),
        given(test::random_walls(random)),
        domain(given.mesh, given.barriers),
        hand(ByHand(given.mesh, given.barriers).numbered_as(domain.open())) {}

  std::mt19937 random;
  test::WalledCase given;
  Domain domain;
  ByHand hand;

  Index vertices() const { return given.mesh.vertex_count(); }
  // The vertices by hand that lie at one of the original.
  std::vector<Index> sides(Index v) const {
    std::vector<Index> found;
    for (Index u = 0; u < hand.vertex.size(); ++u) {
      if (hand.vertex[u] == v) found.push_back(u);
    }
    return found;
  }
  Index any_vertex(bool of_one_side) {
    while (true) {
      const Index v = static_cast<Index>(random() % vertices());
      const std::size_t count = sides(v).size();
      if (count == 1 || (count > 1 && !of_one_side)) return v;
    }
  }
};

double difference_of(std::span<const Complex> a, std::span<const Complex> b) {
  double worst = a.size() == b.size() ? 0 : kInfinity;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isnan(a[i].real()) != std::isnan(b[i].real())) return kInfinity;
    if (!std::isnan(a[i].real())) worst = std::max(worst, std::abs(a[i] - b[i]));
  }
  return worst;
}

TEST_F(HeatWalls, DistancesAndLaplaciansAreThoseOfTheMeshCutByHand) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Walled w(seed);
    std::vector<std::vector<Source>> sets(11), by_hand(11);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      for (std::size_t j = 0; j <= i % 3; ++j) {
        const SurfacePoint p = test::open_point(w.domain, w.random);
        sets[i].push_back({p, 0.05 * static_cast<double>(j)});
        for (const SurfacePoint& side : w.domain.on_open(p)) by_hand[i].push_back({side, sets[i].back().offset});
      }
    }
    const HeatSolver solver(w.domain), cut(w.hand.mesh);
    const std::vector<double> rows = solver.distances(sets), truth = cut.distances(by_hand);
    const std::size_t n = w.vertices(), m = w.hand.mesh.vertex_count();
    ASSERT_EQ(rows.size(), n * sets.size());
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const std::vector<double> least =
          test::least_by_hand(w.hand, std::span(truth).subspan(i * m, m), static_cast<Index>(n));
      EXPECT_LE(difference(std::span(rows).subspan(i * n, n), least), kRounding) << i;
    }
    EXPECT_EQ(solver.time(), cut.time());
    for (const bool delaunay : {true, false}) {
      const Laplacian here = laplacian_of(w.domain, delaunay), there = laplacian_of(w.hand.mesh, delaunay);
      EXPECT_EQ(here.row, there.row);
      EXPECT_EQ(here.column, there.column);
      EXPECT_LE(difference(here.value, there.value), kRounding);
      EXPECT_LE(difference(here.mass, there.mass), kRounding);
    }
  }
}

TEST_F(HeatWalls, ValuesVectorsAndLogarithmsAreThoseOfTheMeshCutByHand) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Walled w(seed);
    VectorHeatSolver solver(w.domain), cut(w.hand.mesh);
    std::vector<Index> vertices, by_hand, single, single_by_hand;
    std::vector<double> values, values_by_hand;
    std::vector<Complex> vectors;
    for (int i = 0; i < 3; ++i) {
      vertices.push_back(w.any_vertex(false));
      values.push_back(i - 0.5);
      for (const Index side : w.sides(vertices.back())) {
        by_hand.push_back(side);
        values_by_hand.push_back(i - 0.5);
      }
      single.push_back(w.any_vertex(true));
      single_by_hand.push_back(w.sides(single.back()).front());
      vectors.emplace_back(i + 0.25, 1 - i);
    }
    const std::vector<double> x = solver.extend(vertices, values), y = cut.extend(by_hand, values_by_hand);
    ASSERT_EQ(x.size(), w.vertices());
    for (Index v = 0; v < w.vertices(); ++v) {
      bool same = std::isnan(x[v]) && w.sides(v).empty();
      for (const Index side : w.sides(v)) {
        same = same || std::abs(x[v] - y[side]) <= kRounding || (std::isnan(x[v]) && std::isnan(y[side]));
      }
      EXPECT_TRUE(same) << v;
    }
    EXPECT_LE(difference_of(solver.transport(single, vectors), cut.transport(single_by_hand, vectors)), kRounding);
    const VectorHeatSolver::Frames f = solver.tangent_frames(), g = cut.tangent_frames();
    EXPECT_EQ(f.x, g.x);
    EXPECT_EQ(f.normal, g.normal);
    EXPECT_LE(difference_of(solver.connection_laplacian().value, cut.connection_laplacian().value), kRounding);
    for (const LogMapStrategy how :
         {LogMapStrategy::VectorHeat, LogMapStrategy::AffineLocal, LogMapStrategy::AffineAdaptive}) {
      const std::vector<Complex> here = solver.log_map(single[0], how), there = cut.log_map(single_by_hand[0], how);
      std::vector<Complex> nearest(w.vertices(), Complex(NAN, NAN));
      for (Index u = 0; u < there.size(); ++u) {
        Complex& z = nearest[w.domain.vertex(u)];
        if (std::isnan(z.real()) || std::abs(there[u]) < std::abs(z)) z = there[u];
      }
      EXPECT_LE(difference_of(here, nearest), kRounding * 10);  // of radii up to 10
    }
  }
}

// A walk over edges as curves by hand: its pieces on every side, joined where they go on. Empty where one branches at
// the end of a wall: it has more points than the walk then.
std::vector<SignedCurve> pieces_by_hand(const Walled& w, const std::vector<SurfacePoint>& walk) {
  std::vector<SignedCurve> curves;
  std::vector<Index> last;  // of each
  std::set<Index> ended;
  for (std::size_t i = 0; i + 1 < walk.size(); ++i) {
    for (const Index a : w.sides(locate(w.given.mesh, walk[i]).vertex)) {
      for (const Index b : w.sides(locate(w.given.mesh, walk[i + 1]).vertex)) {
        const SurfacePoint from = vertex_point(w.hand.mesh, a), to = vertex_point(w.hand.mesh, b);
        if (common_face(w.hand.mesh, locate(w.hand.mesh, from), locate(w.hand.mesh, to)) == kNoIndex) continue;
        if (ended.contains(a)) return {};
        const auto k = std::find(last.begin(), last.end(), a) - last.begin();
        if (k == static_cast<std::ptrdiff_t>(last.size())) {
          curves.push_back({{from}});
          last.push_back(a);
        }
        curves[k].points.push_back(to);
        ended.insert(a);
        last[k] = b;
      }
    }
  }
  return curves;
}

TEST_F(HeatWalls, SignedDistancesAreThoseOfTheMeshCutByHand) {
  int compared = 0, parted = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Walled w(seed);
    const Mesh& mesh = w.given.mesh;
    std::vector<SurfacePoint> walk;
    std::set<Index> visited;
    for (Index v = w.any_vertex(true); walk.size() < 7 && visited.insert(v).second;) {
      walk.push_back(vertex_point(mesh, v));
      const auto around = mesh.corners(v);
      v = mesh.to(around[w.random() % around.size()]);
    }
    const std::vector<SignedCurve> by_hand = pieces_by_hand(w, walk);
    if (by_hand.empty()) continue;
    SignedHeatSolver solver(w.domain), cut(w.hand.mesh);
    const SignedCurve curve{walk};
    const SurfacePoint point = test::open_point(w.domain, w.random);
    const std::vector<SurfacePoint> points = w.domain.on_open(point);
    SignedHeatOptions options;
    options.constraint = LevelSetConstraint::None;
    const std::vector<double> here = solver.distance({&curve, 1}, {&point, 1}, options),
                              there = cut.distance(by_hand, points, options);
    std::vector<double> nearest(w.vertices(), kInfinity);
    for (Index u = 0; u < there.size(); ++u) {
      double& d = nearest[w.domain.vertex(u)];
      if (std::abs(there[u]) < std::abs(d)) d = there[u];
    }
    for (Index v = 0; v < w.vertices(); ++v) {
      if (here[v] == nearest[v]) continue;
      // Two sides may be as far from 0 to rounding.
      const std::vector<Index> sides = w.sides(v);
      EXPECT_TRUE(std::any_of(sides.begin(), sides.end(),
                              [&](Index s) {
                                return std::abs(here[v] - there[s]) <= 10 * kRounding &&
                                       std::abs(nearest[v]) > std::abs(there[s]) - kRounding;
                              }))
          << v << ": " << here[v] << " and " << nearest[v];
    }
    ++compared;
    parted += by_hand.size() > 1;
  }
  EXPECT_GE(compared, 30);
  EXPECT_GE(parted, 3);
}

// Unit squares over [0, 10] x [0, 6], parted along x = 4.
struct Parted {
  Parted() {
    for (Index y = 0; y < 6; ++y) walls.edges.push_back({at(4, y), at(4, y + 1)});
  }
  static Index at(Index x, Index y) { return 11 * y + x; }
  Mesh mesh = shapes::plane(10, 6, 10, 6).mesh();
  Barriers walls;
};

TEST_F(HeatWalls, NothingIsCarriedThroughAndTheNearerSideIsRead) {
  const Parted p;
  VectorHeatSolver solver(Domain(p.mesh, p.walls));
  const std::vector<Index> vertices{Parted::at(3, 3), Parted::at(9, 3)};
  const std::vector<double> values{1, 3};
  const std::vector<double> x = solver.extend(vertices, values);
  for (Index v = 0; v < p.mesh.vertex_count(); ++v) EXPECT_NEAR(x[v], v % 11 <= 4 ? 1 : 3, 1e-12) << v;
  const std::vector<double> one = solver.extend({vertices.data() + 1, 1}, {values.data() + 1, 1});
  for (Index v = 0; v < p.mesh.vertex_count(); ++v) EXPECT_EQ(std::isnan(one[v]), v % 11 < 4) << v;
  // On both sides of a vertex of the wall.
  const Index both = Parted::at(4, 2);
  for (const double value : solver.extend({&both, 1}, {values.data(), 1})) EXPECT_NEAR(value, 1, 1e-12);
  const Complex up(0, 1);
  EXPECT_THROW(solver.transport({&both, 1}, {&up, 1}), Error);
  EXPECT_THROW(solver.log_map(both), Error);
  EXPECT_EQ(solver.tangent_frames().x.size(), p.mesh.vertex_count() + 7);
}

TEST_F(HeatWalls, ACurveAlongAWallIsOneOnEachOfItsSides) {
  const Parted p;
  SignedCurve line;
  for (Index y = 0; y <= 6; ++y) line.points.push_back(vertex_point(p.mesh, Parted::at(4, y)));
  SignedHeatSolver solver(Domain(p.mesh, p.walls));
  const std::vector<double> d = solver.distance({&line, 1});
  for (Index v = 0; v < p.mesh.vertex_count(); ++v) {
    EXPECT_NEAR(d[v], p.mesh.positions()[v].x - 4, 0.5) << v;  // near a border vectors tend to run along it
    if (v % 11 == 4) {
      EXPECT_NEAR(d[v], 0, 1e-6) << v;
    }
  }
}

TEST_F(HeatWalls, WhatLiesBehindAWallIsAnErrorAsASource) {
  const Mesh mesh = shapes::plane(4, 4).mesh();
  const Domain domain(mesh, {.vertices = {0}});
  const Source source{vertex_point(mesh, 0)};
  EXPECT_THROW(HeatSolver(domain).distance({&source, 1}), Error);
  VectorHeatSolver vectors(domain);
  const Index corner = 0;
  const double value = 1;
  EXPECT_THROW(vectors.extend({&corner, 1}, {&value, 1}), Error);
  EXPECT_THROW(SignedHeatSolver(domain).distance({}, {&source.point, 1}), Error);
}

}  // namespace
}  // namespace brushfire
