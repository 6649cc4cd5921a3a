// Distances of parcels against the dense matrix; smoothing by its laws.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/parcels.h>
#include <brushfire/queries/smoothing.h>
#include <brushfire/queries/vertex_measures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>

namespace brushfire {
namespace {

MatrixOptions exactly() {
  MatrixOptions options;
  options.distance.method = Method::Exact;
  return options;
}

TEST(Parcels, EqualWhatTheDenseMatrixGives) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Mesh mesh = seed % 2 ? shapes::folded_sphere(2, 4, 0.2, seed).mesh() : shapes::torus(14, 8).mesh();
    Barriers barriers;
    for (int i = 0; i < 30 && seed > 2; ++i) barriers.faces.push_back(static_cast<Index>(random() % mesh.face_count()));
    const Domain domain(mesh, barriers);
    const Index n = mesh.vertex_count();
    std::vector<std::int64_t> label(n);
    for (Index v = 0; v < n; ++v)
      label[v] = static_cast<std::int64_t>(mesh.positions()[v].z * 3 + static_cast<double>(random() % 2));
    const std::vector<double> all = distance_matrix<double>(domain, std::nullopt, std::nullopt, exactly());
    std::map<std::int64_t, std::vector<Index>> members;
    for (Index v = 0; v < n; ++v) {
      if (label[v] >= 0 && domain.is_open(v)) members[label[v]].push_back(v);
    }
    const std::vector<double> area = vertex_areas(domain);
    const auto centroid = [&](const std::vector<Index>& own) {
      return *std::min_element(own.begin(), own.end(), [&](Index a, Index b) {
        double sum_a = 0, sum_b = 0;
        for (const Index w : own) sum_a += area[w] * all[a * n + w], sum_b += area[w] * all[b * n + w];
        return sum_a < sum_b - 1e-12;
      });
    };
    for (const char* name : {"min", "hausdorff", "centroid", "mean", "max"}) {
      SCOPED_TRACE(name);
      const ParcelDistance kind = parcel_distance_named(name);
      const ParcelMatrix m = parcel_distances(domain, label, kind, 0, exactly());
      ASSERT_EQ(m.label.size(), members.size());
      std::size_t i = 0;
      for (const auto& [a, rows] : members) {
        EXPECT_EQ(m.label[i], a);
        EXPECT_EQ(m.vertices[i], rows.size());
        std::size_t j = 0;
        for (const auto& [b, columns] : members) {
          double least = kInfinity, greatest = 0, sum = 0, hausdorff = 0;
          for (const auto& [one, other] : {std::pair{&rows, &columns}, std::pair{&columns, &rows}}) {
            for (const Index v : *one) {
              double nearest = kInfinity;
              for (const Index w : *other) {
                nearest = std::min(nearest, all[v * n + w]);
                greatest = std::max(greatest, all[v * n + w]);
                sum += all[v * n + w];
              }
              least = std::min(least, nearest);
              hausdorff = std::max(hausdorff, nearest);
            }
          }
          const double pairs = 2.0 * static_cast<double>(rows.size() * columns.size());
          const double expected = kind == ParcelDistance::Min         ? least
                                  : kind == ParcelDistance::Hausdorff ? hausdorff
                                  : kind == ParcelDistance::Mean      ? sum / pairs
                                  : kind == ParcelDistance::Max       ? greatest
                                                                      : all[centroid(rows) * n + centroid(columns)];
          const double found = m.distance[i * m.label.size() + j];
          if (expected == kInfinity) {
            EXPECT_EQ(found, kInfinity);
          } else {
            EXPECT_NEAR(found, expected, 1e-11);
          }
          ++j;
        }
        ++i;
      }
    }
  }
  EXPECT_THROW(parcel_distance_named("median"), Error);
  EXPECT_THROW(parcel_distances(shapes::plane(2, 2).mesh(), std::vector<std::int64_t>(3), ParcelDistance::Min), Error);
  EXPECT_TRUE(parcel_distances(shapes::plane(1, 1).mesh(), std::vector<std::int64_t>(4, -1), ParcelDistance::Min)
                  .label.empty());
}

TEST(Smoothing, KeepsConstantsMeansNothingAcrossWallsAndLeavesNaNOut) {
  const Mesh mesh = shapes::plane(20, 20).mesh();
  Barriers wall;
  for (Index y = 0; y < 20; ++y) wall.edges.push_back({y * 21 + 10, (y + 1) * 21 + 10});
  const Domain domain(mesh, wall);
  const SparseMatrix<double> kernel = smoothing_kernel(domain, 0.08, exactly());
  for (std::size_t row = 0; row + 1 < kernel.row_start.size(); ++row) {
    EXPECT_NEAR(std::accumulate(kernel.value.begin() + static_cast<std::ptrdiff_t>(kernel.row_start[row]),
                                kernel.value.begin() + static_cast<std::ptrdiff_t>(kernel.row_start[row + 1]), 0.0),
                1, 1e-12);
  }
  std::vector<double> values;
  for (const Vec3& p : mesh.positions()) values.push_back(p.x < 0.5 ? 1 : p.x > 0.5 ? 3 : 2);
  values[5] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> smooth = smoothed(kernel, values);
  EXPECT_TRUE(std::isnan(smooth[5]));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (v == 5) continue;
    const double x = mesh.positions()[v].x;
    // Only the wall's own vertices are on both sides.
    EXPECT_LE(smooth[v], (x < 0.5 ? 2 : 3) + 1e-12);
    EXPECT_GE(smooth[v], (x > 0.5 ? 2 : 1) - 1e-12);
    if (x < 0.1) {
      EXPECT_NEAR(smooth[v], 1, 1e-3);
    }
  }
  EXPECT_THROW(smoothing_kernel(mesh, 0), Error);
  EXPECT_THROW(smoothed(kernel, std::vector<double>(3)), Error);
}

TEST(Smoothing, SpreadsAPeakByTheGaussianThatWasAskedFor) {
  const Mesh mesh = shapes::plane(60, 60).mesh();
  constexpr double kSigma = 0.05;
  const SparseMatrix<double> kernel = smoothing_kernel(mesh, kSigma, exactly());
  std::vector<double> peak(mesh.vertex_count(), 0);
  const Index middle = 30 * 61 + 30;
  peak[middle] = 1;
  const std::vector<double> smooth = smoothed(kernel, peak);
  for (const Index off : {0u, 2u, 4u, 6u}) {
    const double d = off / 60.0;
    const double expected = std::exp(-d * d / (2 * kSigma * kSigma)) / (2 * kPi * kSigma * kSigma) / 3600;
    EXPECT_NEAR(smooth[middle + off], expected, 2e-3 * expected) << off;
  }
}

}  // namespace
}  // namespace brushfire
