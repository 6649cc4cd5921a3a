// A solver that is used again: nothing is allocated, and short runs cost what they reach.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include "io/counting_allocator.h"
#include "support/part_solver.h"

#include <string>

namespace brushfire {
namespace {

struct Way {
  Method method;
  Precision precision = Precision::Float;
};

std::string name_of(const Way& way) {
  return std::string(name_of(way.method)) + (way.precision == Precision::Float ? " in float" : " in double");
}

std::vector<Source> some_sources(const Mesh& mesh) {
  return {{{7, {0.25, 0.25, 0.5}}}, {{400, {0, 0.5, 0.5}}, 0.1}, {vertex_point(mesh, 100)}};
}

// How often memory is asked for by the fourth of some runs that are alike.
template <class Run>
std::size_t allocations_of(const Run& run) {
  for (int i = 0; i < 3; ++i) run();
  const std::size_t before = test::allocation_count();
  run();
  return test::allocation_count() - before;
}

// At this tolerance windows are merged on meshes as small as these.
constexpr double kMerging = 5e-2;

class Reuse : public testing::TestWithParam<Way> {};

TEST_P(Reuse, AllocatesNothingAfterSomeRuns) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  DistanceSolver solver(mesh);
  DistanceOptions options;
  options.method = GetParam().method;
  options.precision = GetParam().precision;
  options.tolerance = kMerging;
  const std::vector<Source> sources = some_sources(mesh);
  for (const double radius : {kInfinity, 0.4}) {
    for (std::size_t count = 1; count <= sources.size(); ++count) {
      options.max_distance = radius;
      DistanceField field;
      SparseField sparse;
      const std::span<const Source> from(sources.data(), count);
      EXPECT_EQ(allocations_of([&] { solver.distance(from, options, field); }), 0u)
          << name_of(GetParam()) << ", " << count << " sources, radius " << radius;
      EXPECT_EQ(allocations_of([&] { solver.distance_sparse(from, options, sparse); }), 0u)
          << name_of(GetParam()) << ", sparse, " << count << " sources, radius " << radius;
    }
  }
}

// A field that is written again is that of a new solver.
TEST_P(Reuse, GivesTheSameFieldAsANewSolver) {
  const Mesh mesh = shapes::folded_sphere(3).mesh();
  DistanceSolver solver(mesh);
  DistanceOptions options;
  options.method = GetParam().method;
  options.precision = GetParam().precision;
  options.tolerance = kMerging;
  DistanceField field;
  for (const double radius : {kInfinity, 0.4, kInfinity}) {
    options.max_distance = radius;
    for (const Source& source : some_sources(mesh)) {
      solver.distance({&source, 1}, options, field);
      const DistanceField fresh = distance(mesh, {&source, 1}, options);
      EXPECT_EQ(field.distance, fresh.distance);
      EXPECT_EQ(field.source, fresh.source);
      EXPECT_EQ(field.updates, fresh.updates);
      EXPECT_EQ(field.beyond_radius, fresh.beyond_radius);
      EXPECT_EQ(field.max_error_bound, fresh.max_error_bound);
    }
  }
}

// The same disk around the source, on a mesh of 16 times as many vertices: as many updates, and no more memory asked
// for.
TEST(ReuseOfMarching, ShortRunsCostWhatTheyReach) {
  DistanceOptions options;
  options.method = Method::NovotniKlein;
  options.max_distance = 5.01;
  std::vector<std::uint64_t> updates;
  for (const Index n : {40u, 160u}) {
    std::vector<Vec3> positions;
    std::vector<Face> faces;
    for (Index y = 0; y <= n; ++y) {
      for (Index x = 0; x <= n; ++x) positions.push_back({x - n / 2.0, y - n / 2.0, 0});
    }
    for (Index y = 0; y < n; ++y) {
      for (Index x = 0; x < n; ++x) {
        const Index a = y * (n + 1) + x, b = a + n + 1;
        faces.push_back({a, a + 1, b + 1});
        faces.push_back({a, b + 1, b});
      }
    }
    const Mesh mesh(positions, faces);
    DistanceSolver solver(mesh);
    const Source middle{vertex_point(mesh, (n / 2) * (n + 1) + n / 2)};
    updates.push_back(solver.distance({&middle, 1}, options).updates);
    EXPECT_EQ(solver.distance_sparse({&middle, 1}, options).vertex.size(), 81u);  // x^2 + y^2 <= 25
  }
  EXPECT_EQ(updates[0], updates[1]);
  EXPECT_LT(updates[0], 200u);
}

// In parts that send messages to each other, by several threads.
TEST(ReuseOfMarching, AllocatesNothingInParts) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  const std::vector<Source> sources = some_sources(mesh);
  for (const Method method : {Method::NovotniKlein, Method::KimmelSethian}) {
    for (const unsigned threads : {1u, 2u}) {
      test::PartSolver solver(mesh, 128);
      DistanceOptions options;
      options.method = method;
      options.threads = threads;
      DistanceField field;
      std::vector<Index> touched;
      for (std::size_t count = 1; count <= sources.size(); ++count) {
        const std::span<const Source> from(sources.data(), count);
        EXPECT_EQ(allocations_of([&] { solver.distance(from, options, field); }), 0u) << threads << " threads";
        options.max_distance = 0.4;
        EXPECT_EQ(allocations_of([&] {
                    touched.clear();
                    solver.distance(from, options, field, &touched);
                  }),
                  0u)
            << threads << " threads, short";
        options.max_distance = kInfinity;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Reuse,
                         testing::Values(Way{Method::CarriedSource}, Way{Method::CarriedSource, Precision::Double},
                                         Way{Method::NovotniKlein}, Way{Method::NovotniKlein, Precision::Double},
                                         Way{Method::KimmelSethian}, Way{Method::Windows}, Way{Method::Exact},
                                         Way{Method::Dijkstra}),
                         [](const auto& each) {
                           std::string name = name_of(each.param);
                           for (char& c : name) c = c == '-' || c == ' ' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace brushfire
