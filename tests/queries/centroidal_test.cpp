// Means, medoids and centroidal cells.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/centroidal.h>
#include <brushfire/queries/compare.h>
#include <brushfire/queries/karcher_mean.h>
#include <brushfire/queries/voronoi.h>

#include "../support/random_points.h"
#include "../support/shared_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

namespace brushfire {
namespace {

TEST(KarcherMean, OnAPlaneIsTheMeanOfTheCoordinates) {
  const Mesh mesh = shapes::plane(7, 5, 3, 2).mesh();
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    std::vector<SurfacePoint> points;
    std::vector<double> weights;
    Vec3 mean;
    double sum = 0;
    for (unsigned i = 0; i < 3 + seed; ++i) {
      points.push_back(test::any_point(mesh, random));
      weights.push_back(test::uniform(random));
      mean = mean + weights.back() * position(mesh, points.back());
      sum += weights.back();
    }
    mean = (1 / sum) * mean;
    const KarcherMean k = karcher_mean(mesh, points, weights);
    EXPECT_TRUE(k.converged);
    EXPECT_LT(norm(position(mesh, k.point) - mean), 1e-6) << seed;
  }
}

TEST(KarcherMean, OfTwoPointsIsTheMiddleOfTheirPath) {
  const Mesh sphere = shapes::icosphere(3).mesh();
  const std::vector<SurfacePoint> two{vertex_point(sphere, 1), vertex_point(sphere, 9)};
  const KarcherMean k = karcher_mean(sphere, two);
  DistanceOptions options;
  options.method = Method::Exact;
  options.targets = two;
  const Source source{k.point};
  const DistanceField field = distance(sphere, std::span(&source, 1), options);
  EXPECT_NEAR(field.target_distance[0], field.target_distance[1], 1e-4);
  EXPECT_NEAR(k.deviation, field.target_distance[0], 1e-4);
  EXPECT_THROW(karcher_mean(sphere, {}), Error);
  EXPECT_THROW(karcher_mean(sphere, two, std::vector<double>{1}), Error);
  EXPECT_THROW(karcher_mean(sphere, two, std::vector<double>{0, 0}), Error);
}

TEST(KarcherMean, NoPointOfTheMeshIsBetterWhereTheMeanIsUnique) {
  const Mesh mesh = shapes::noise_terrain(14, 14, 0.1, 4).mesh();
  std::mt19937 random(3);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 12; ++i) points.push_back(test::any_point(mesh, random));
  const KarcherMean k = karcher_mean(mesh, points);
  DistanceOptions options;
  options.method = Method::Exact;
  options.targets = points;
  const auto deviation = [&](const SurfacePoint& at) {
    const Source source{at};
    double sum = 0;
    for (const double d : distance(mesh, std::span(&source, 1), options).target_distance) sum += d * d;
    return std::sqrt(sum / static_cast<double>(points.size()));
  };
  EXPECT_NEAR(deviation(k.point), k.deviation, 1e-12);
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_GE(deviation(vertex_point(mesh, v)), k.deviation * (1 - 1e-6));
}

TEST(KMedoids, AreTheBestOfAllChoicesOnSmallMatrices) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    constexpr std::size_t n = 12;
    std::vector<std::array<double, 2>> p(n);
    for (auto& [x, y] : p) x = test::uniform(random), y = test::uniform(random);
    std::vector<double> d;
    for (const auto& a : p) {
      for (const auto& b : p) d.push_back(std::hypot(a[0] - b[0], a[1] - b[1]));
    }
    double best = kInfinity;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        double cost = 0;
        for (std::size_t k = 0; k < n; ++k) cost += std::min(d[i * n + k], d[j * n + k]);
        best = std::min(best, cost);
      }
    }
    const Medoids m = k_medoids(d, 2);
    EXPECT_LE(m.cost, best * 1.1) << seed;  // a local optimum, and seldom another one
    double cost = 0;
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_EQ(d[m.places[m.nearest[k]] * n + k], std::min(d[m.places[0] * n + k], d[m.places[1] * n + k]));
      cost += d[m.places[m.nearest[k]] * n + k];
    }
    EXPECT_NEAR(cost, m.cost, 1e-12);
  }
  const std::vector<double> apart{0, 1, kInfinity, 1, 0, kInfinity, kInfinity, kInfinity, 0};
  EXPECT_EQ(k_medoids(apart, 2).cost, 1);
  EXPECT_EQ(k_medoids(apart, 3).cost, 0);
  EXPECT_THROW(k_medoids(apart, 4), Error);
  EXPECT_THROW(k_medoids(std::vector<double>{0, 1}, 1), Error);
}

TEST(CentroidalVoronoi, EnergyFallsAndSitesAreTheMiddlesOfTheirCells) {
  const Mesh mesh = shapes::plane(40, 40).mesh();
  CentroidalOptions options;
  options.max_rounds = 60;
  options.tolerance = 1e-6;
  const CentroidalVoronoi c = centroidal_voronoi(mesh, 9, options);
  EXPECT_TRUE(std::is_sorted(c.energy.rbegin(), c.energy.rend()));
  EXPECT_LT(c.energy.back(), 0.7 * c.energy.front());
  const std::vector<double> area = vertex_areas(mesh);
  for (Index s = 0; s < 9; ++s) {
    Vec3 middle;
    double sum = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (c.nearest[v] != s) continue;
      middle = middle + area[v] * mesh.positions()[v];
      sum += area[v];
    }
    EXPECT_LT(norm((1 / sum) * middle - position(mesh, c.sites[s])), 0.02) << s;
  }
}

TEST(CentroidalVoronoi, CellsOfASphereBecomeOfOneSize) {
  const Mesh mesh = shapes::icosphere(4).mesh();
  const CentroidalVoronoi c = centroidal_voronoi(mesh, 12, {.max_rounds = 40, .tolerance = 1e-5});
  std::vector<Source> sources;
  for (const SurfacePoint& p : c.sites) sources.push_back({p});
  const VoronoiDiagram cells = voronoi(mesh, sources);
  const auto [least, greatest] = std::minmax_element(cells.area.begin(), cells.area.end());
  EXPECT_LT(*greatest / *least, 1.25);
  // Twelve points well spread over a sphere have the triangles of an icosahedron.
  EXPECT_EQ(cells.dual.size(), 20u);
  EXPECT_EQ(cells.borders.size(), 30u);
}

TEST(CentroidalVoronoi, ADensityIsWhatTheSitesSettleFor) {
  const Mesh mesh = shapes::plane(40, 40).mesh();
  std::vector<double> density;
  for (const Vec3& p : mesh.positions()) density.push_back(p.x < 0.5 ? 20 : 1);
  CentroidalOptions options;
  options.max_rounds = 100;
  options.tolerance = 1e-7;
  const CentroidalVoronoi even = centroidal_voronoi(mesh, 20, options);
  options.density = density;
  const CentroidalVoronoi dense = centroidal_voronoi(mesh, 20, options);
  options.max_rounds = 0;
  const double energy_of_even = centroidal_voronoi(mesh, even.sites, options).energy.front();
  EXPECT_LT(dense.energy.back(), energy_of_even);
  // By its definition: the sum over vertices of density, area and squared distance.
  const std::vector<double> area = vertex_areas(mesh);
  double energy = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    energy += density[v] * area[v] * dense.distance[v] * dense.distance[v];
  }
  EXPECT_NEAR(dense.energy.back(), energy, 1e-12);
}

TEST(CentroidalVoronoi, StaysOnItsSideOfAWall) {
  const Mesh mesh = shapes::plane(20, 20).mesh();
  Barriers wall;
  for (Index y = 0; y < 20; ++y) wall.edges.push_back({y * 21 + 10, (y + 1) * 21 + 10});
  const Domain domain(mesh, wall);
  const std::vector<SurfacePoint> first{vertex_point(mesh, 0), vertex_point(mesh, 20)};
  const CentroidalVoronoi c = centroidal_voronoi(domain, first, {.max_rounds = 30, .tolerance = 1e-6});
  EXPECT_LT(norm(position(mesh, c.sites[0]) - Vec3{0.25, 0.5, 0}), 0.01);
  EXPECT_LT(norm(position(mesh, c.sites[1]) - Vec3{0.75, 0.5, 0}), 0.01);
}

TEST(CentroidalVoronoi, TwoHundredCellsOfTheBunny) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  const Mesh mesh = test::shared_mesh("stanford-bunny");
  const auto start = std::chrono::steady_clock::now();
  const CentroidalVoronoi c = centroidal_voronoi(mesh, 200);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%zu rounds, energy %g to %g, %.2f s\n", c.energy.size() - 1, c.energy.front(), c.energy.back(), seconds);
  EXPECT_LT(c.energy.back(), 0.95 * c.energy.front());
}

TEST(Voronoi, BordersOfOffsetSourcesAreHyperbolas) {
  // |p - a| + 0.2 = |p - b| + 0: to second order in the edge length.
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const Index n = i == 0 ? 30 : 120;
    const Mesh mesh = shapes::plane(n, n).mesh();
    const Index u = n / 30;
    std::vector<Source> sources{{vertex_point(mesh, 15 * u * (n + 1) + 5 * u), 0.2},
                                {vertex_point(mesh, 15 * u * (n + 1) + 25 * u), 0}};
    const Vec3 a = position(mesh, sources[0].point), b = position(mesh, sources[1].point);
    DistanceOptions options;
    options.method = Method::Exact;
    const VoronoiDiagram d = voronoi(mesh, sources, options);
    error[i] = 0;
    for (const SurfacePoint& s : d.borders[0].line.points) {
      const Vec3 p = position(mesh, s);
      error[i] = std::max(error[i], std::abs(norm(p - a) + 0.2 - norm(p - b)));
    }
  }
  EXPECT_LT(error[0], 2e-3);
  EXPECT_LT(error[1], error[0] / 8);
}

}  // namespace
}  // namespace brushfire
