// Sixteen sources at a time: who marches with whom, and that it is seen in nothing but the clock.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>
#include <brushfire/solvers/distance.h>
#include <support/shared_meshes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace brushfire::carried_source {
namespace {

std::vector<Index> all_vertices(const Mesh& mesh) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

using RowsByVertex = std::map<Index, std::vector<double>>;

RowsByVertex rows_of(GroupRunner& runner, const GroupedRows::Group& group, double radius = kInfinity) {
  RowsByVertex rows;
  runner.run(group, radius, [&](int lane, std::span<const float> row) {
    std::vector<double>& to = rows[group.vertices[static_cast<std::size_t>(lane)]];
    for (const float value : row) {
      const double d = static_cast<double>(value) * runner.unit();
      to.push_back(d > radius ? kInfinity : d);
    }
  });
  return rows;
}

std::vector<double> alone(DistanceSolver& solver, Index source, Method method = Method::CarriedSource) {
  DistanceOptions options;
  options.method = method;
  const Source from{vertex_point(solver.mesh(), source)};
  return solver.distance({&from, 1}, options).distance;
}

Mesh sphere() { return shapes::folded_sphere(4).mesh(); }

TEST(SourceGroups, AreThoseOfTheMeshWhateverIsAskedFor) {
  const Mesh mesh = sphere();
  const GroupedRows all(mesh, all_vertices(mesh));
  std::map<Index, std::vector<Index>> group_of;
  for (const auto& g : all.groups()) {
    EXPECT_LE(g.vertices.size(), 16u);
    EXPECT_GT(g.spread, 0);
    for (const Index v : g.vertices) EXPECT_TRUE(group_of.emplace(v, g.vertices).second) << "vertex " << v << " twice";
  }
  EXPECT_GE(group_of.size(), mesh.vertex_count() * 9 / 10) << "hardly any runs alone";
  for (const Index v : {Index{0}, Index{700}, mesh.vertex_count() - 1}) {
    const GroupedRows one(mesh, std::span(&v, 1));
    ASSERT_EQ(one.groups().size(), group_of.count(v));
    if (one.groups().empty()) continue;
    EXPECT_EQ(one.groups()[0].vertices, group_of[v]);
  }
}

TEST(SourceGroups, AreNotMadeAcrossComponents) {
  Shape two = shapes::plane(20, 15);
  const auto vertices = static_cast<Index>(two.positions.size());
  const Shape one = two;
  for (const Vec3 p : one.positions) two.positions.push_back(p + Vec3{100, 0, 0});
  for (const Face& f : one.faces) two.faces.push_back({f[0] + vertices, f[1] + vertices, f[2] + vertices});
  const Mesh mesh = two.mesh();
  const GroupedRows rows(mesh, all_vertices(mesh));
  std::size_t grouped = 0;
  for (const auto& g : rows.groups()) {
    grouped += g.vertices.size();
    for (const Index v : g.vertices) EXPECT_EQ(v < vertices, g.vertices[0] < vertices);
  }
  EXPECT_GE(grouped, 2u * vertices * 9 / 10);
}

TEST(GroupMarch, EveryProcessorGivesTheSameBits) {
  for (const Mesh& mesh : {sphere(), shapes::book(3, 9, 9).mesh(), shapes::bow_tie(5, 12).mesh()}) {
    const GroupedRows rows(mesh, all_vertices(mesh));
    GroupRunner best(rows), avx2(rows, Variant::Avx2), portable(rows, Variant::Portable);
    for (std::size_t g = 0; g < rows.groups().size(); g += 7) {
      const RowsByVertex expected = rows_of(best, rows.groups()[g]);
      EXPECT_EQ(expected, rows_of(avx2, rows.groups()[g]));
      EXPECT_EQ(expected, rows_of(portable, rows.groups()[g]));
    }
  }
}

using EntriesByVertex = std::map<Index, std::vector<std::pair<Index, float>>>;

EntriesByVertex entries_of(GroupRunner& runner, const GroupedRows::Group& group, double radius) {
  EntriesByVertex rows;
  runner.run_within(group, radius, [&](int lane, std::span<const Index> vertices, std::span<const float> distances) {
    auto& row = rows[group.vertices[static_cast<std::size_t>(lane)]];
    for (std::size_t k = 0; k < vertices.size(); ++k) row.emplace_back(vertices[k], distances[k]);
  });
  return rows;
}

TEST(GroupMarch, WithinARadiusEveryProcessorGivesTheSameBits) {
  for (const Mesh& mesh : {sphere(), shapes::book(3, 9, 9).mesh()}) {
    const GroupedRows rows(mesh, all_vertices(mesh));
    GroupRunner best(rows), avx2(rows, Variant::Avx2), portable(rows, Variant::Portable);
    for (std::size_t g = 0; g < rows.groups().size(); g += 3) {
      const EntriesByVertex expected = entries_of(best, rows.groups()[g], 0.2);
      EXPECT_EQ(expected, entries_of(avx2, rows.groups()[g], 0.2));
      EXPECT_EQ(expected, entries_of(portable, rows.groups()[g], 0.2));
    }
  }
}

TEST(GroupMarch, ForgetsWhatItDidBefore) {
  const Mesh mesh = sphere();
  const GroupedRows rows(mesh, all_vertices(mesh));
  GroupRunner used(rows);
  for (std::size_t g = 0; g < 12; ++g) rows_of(used, rows.groups()[g], g % 2 == 0 ? 0.3 : kInfinity);
  for (std::size_t g = 12; g-- > 0;) {
    GroupRunner fresh(rows);
    EXPECT_EQ(rows_of(used, rows.groups()[g]), rows_of(fresh, rows.groups()[g]));
  }
}

TEST(GroupMarch, UpToARadiusItReadsWhatTheWholeRunReads) {
  const Mesh mesh = sphere();
  const GroupedRows rows(mesh, all_vertices(mesh));
  GroupRunner runner(rows);
  for (std::size_t g = 0; g < rows.groups().size(); g += 9) {
    const RowsByVertex whole = rows_of(runner, rows.groups()[g]);
    for (const double radius : {0.0, 0.1, 0.7}) {
      for (const auto& [v, row] : rows_of(runner, rows.groups()[g], radius)) {
        for (Index u = 0; u < mesh.vertex_count(); ++u) {
          const double d = whole.at(v)[u];
          ASSERT_EQ(row[u], d <= radius ? d : kInfinity) << v << " to " << u << " within " << radius;
        }
      }
    }
  }
}

// Where a vertex uses up its turns, lanes march by halves, and those that are left alone are given back.
TEST(GroupMarch, ThatIsGivenUpLeavesNoHole) {
  const Mesh mesh = sphere();
  const GroupedRows rows(mesh, all_vertices(mesh));
  std::size_t refused = 0, by_halves = 0;
  for (const int most_turns : {2, 3, 4}) {
    GroupRunner runner(rows, Variant::Best, most_turns);
    for (std::size_t g = 0; g < 8; ++g) {
      std::set<int> missing;
      for (int lane = 0; lane < static_cast<int>(rows.groups()[g].vertices.size()); ++lane) missing.insert(lane);
      const std::vector<int> alone = runner.run(rows.groups()[g], kInfinity, [&](int lane, std::span<const float> row) {
        EXPECT_EQ(missing.erase(lane), 1u);
        for (const float d : row) ASSERT_TRUE(std::isfinite(d));
      });
      EXPECT_EQ(std::set<int>(alone.begin(), alone.end()), missing);
      refused += alone.size();
      by_halves += !alone.empty() && alone.size() < rows.groups()[g].vertices.size() ? 1 : 0;
    }
  }
  EXPECT_GT(refused, 0u);
  EXPECT_GT(by_halves, 0u);
}

TEST(GroupMarch, IsAsNearToTheTruthAsSingleRuns) {
  const Mesh mesh = sphere();
  const GroupedRows rows(mesh, all_vertices(mesh));
  GroupRunner runner(rows);
  DistanceSolver solver(mesh);
  double own = 0, single = 0, apart = 0, largest = 0, largest_single = 0, count = 0;
  for (std::size_t g = 0; g < rows.groups().size(); g += 50) {
    for (const auto& [v, row] : rows_of(runner, rows.groups()[g])) {
      const std::vector<double> by_itself = alone(solver, v), truth = alone(solver, v, Method::Exact);
      for (Index u = 0; u < mesh.vertex_count(); ++u) {
        if (u == v) continue;
        const double error = std::abs(row[u] / truth[u] - 1), error_single = std::abs(by_itself[u] / truth[u] - 1);
        own += error, single += error_single, apart += std::abs(row[u] - by_itself[u]) / truth[u], ++count;
        largest = std::max(largest, error), largest_single = std::max(largest_single, error_single);
      }
    }
  }
  EXPECT_LT(own, 1.05 * single);
  EXPECT_LT(largest, 1.5 * largest_single);
  EXPECT_LT(apart, 0.5 * single) << "rows and single runs differ by less than their errors";
  EXPECT_LT(own / count, 5e-3);
}

TEST(GroupMarch, FlatMeshesAreExactFromEveryVertex) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const char* name : {"square604", "square604-x10"}) {
    const Mesh mesh = test::shared_mesh(name);
    const GroupedRows rows(mesh, all_vertices(mesh));
    GroupRunner runner(rows);
    std::size_t count = 0;
    for (const auto& g : rows.groups()) {
      for (const auto& [v, row] : rows_of(runner, g)) {
        ++count;
        for (Index u = 0; u < mesh.vertex_count(); ++u) {
          const double euclid = norm(mesh.positions()[v] - mesh.positions()[u]);
          EXPECT_NEAR(row[u], euclid, 1e-4 * euclid) << name << ", from " << v << " to " << u;
        }
      }
    }
    EXPECT_GT(count, 550u);
  }
}

}  // namespace
}  // namespace brushfire::carried_source
