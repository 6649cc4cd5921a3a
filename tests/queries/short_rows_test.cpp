// Rows within a radius with carried sources: in groups, whoever asks for them.
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/distance_matrix.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

MatrixOptions options_of(Method method, unsigned threads = 1) {
  MatrixOptions options;
  options.distance.method = method;
  options.threads = threads;
  return options;
}

Mesh sphere() { return shapes::folded_sphere(4).mesh(); }

std::vector<Place> every_third(Index count) {
  std::vector<Place> places;
  for (Index v = count - 1; v >= 3; v -= 3) places.emplace_back(v);
  places.emplace_back(places.front());  // one of them twice
  return places;
}

TEST(ShortRows, AreCanonicalAndTheSameWhoeverAsks) {
  const Mesh mesh = sphere();
  for (const double radius : {0.0, 0.05, 0.3}) {
    const auto all = distances_within<float>(mesh, radius, {}, options_of(Method::CarriedSource));
    const auto threaded = distances_within<float>(mesh, radius, {}, options_of(Method::CarriedSource, 2));
    EXPECT_EQ(all.row_start, threaded.row_start);
    EXPECT_EQ(all.column, threaded.column);
    EXPECT_EQ(all.value, threaded.value);
    ASSERT_EQ(all.row_start.size(), mesh.vertex_count() + 1u);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      bool own = false;
      for (std::uint64_t k = all.row_start[v]; k < all.row_start[v + 1]; ++k) {
        EXPECT_TRUE(k == all.row_start[v] || all.column[k - 1] < all.column[k]);
        EXPECT_LE(static_cast<double>(all.value[k]), radius * (1 + 1e-7));
        own |= all.column[k] == v && all.value[k] == 0;
      }
      EXPECT_TRUE(own) << v;
    }
    const std::vector<Place> some = every_third(mesh.vertex_count());
    const auto of_some = distances_within<float>(mesh, radius, some, options_of(Method::CarriedSource));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto v = std::get<Index>(some[i]);
      const auto size = static_cast<std::ptrdiff_t>(all.row_start[v + 1] - all.row_start[v]);
      ASSERT_EQ(of_some.row_start[i + 1] - of_some.row_start[i], static_cast<std::uint64_t>(size));
      const auto at = static_cast<std::ptrdiff_t>(all.row_start[v]),
                 own = static_cast<std::ptrdiff_t>(of_some.row_start[i]);
      EXPECT_TRUE(std::equal(all.value.begin() + at, all.value.begin() + at + size, of_some.value.begin() + own));
      EXPECT_TRUE(std::equal(all.column.begin() + at, all.column.begin() + at + size, of_some.column.begin() + own));
    }
  }
}

// With walls in it, a source on a wall among them, and a second piece: against dense exact rows.
TEST(ShortRows, ReachWhatLiesWithinTheRadiusAndAreNearTheTruth) {
  Shape two = shapes::noise_terrain(20, 18, 0.2, 7);
  const auto vertices = static_cast<Index>(two.positions.size());
  const Shape one = two;
  for (const Vec3 p : one.positions) two.positions.push_back(p + Vec3{100, 0, 0});
  for (const Face& f : one.faces) two.faces.push_back({f[0] + vertices, f[1] + vertices, f[2] + vertices});
  const Mesh mesh = two.mesh();
  Barriers walls;
  for (Index h = 900; h < 960; h += 3) walls.edges.push_back({mesh.from(h), mesh.to(h)});
  const Domain domain(mesh, walls);
  const std::size_t n = mesh.vertex_count();
  const std::vector<double> truth = distance_matrix<double>(domain, {}, {}, options_of(Method::Exact));
  const double radius = 0.25;
  double error[2] = {0, 0}, largest[2] = {0, 0};
  std::size_t entries = 0;
  int kind = 0;
  for (const Precision precision : {Precision::Float, Precision::Double}) {  // in groups, alone
    MatrixOptions options = options_of(Method::CarriedSource);
    options.distance.precision = precision;
    const auto near = distances_within<double>(domain, radius, {}, options);
    entries = 0;
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t certain = 0, found = 0;
      for (std::size_t j = 0; j < n; ++j) certain += truth[i * n + j] < 0.9 * radius ? 1 : 0;
      for (std::uint64_t k = near.row_start[i]; k < near.row_start[i + 1]; ++k) {
        const double t = truth[i * n + near.column[k]];
        ASSERT_TRUE(std::isfinite(t)) << "beyond a wall, or in the other piece";
        found += t < 0.9 * radius ? 1 : 0;
        if (t == 0) continue;
        const double e = std::abs(near.value[k] / t - 1);
        error[kind] += e, largest[kind] = std::max(largest[kind], e), ++entries;
      }
      EXPECT_EQ(found, certain) << "row " << i;
    }
    error[kind] /= static_cast<double>(entries);
    ++kind;
  }
  EXPECT_GT(entries, 10u * n);
  EXPECT_GT(error[0], 0);
  EXPECT_LT(error[0], 1.1 * error[1]);
  EXPECT_LT(largest[0], 1.5 * largest[1]);
}

}  // namespace
}  // namespace brushfire
