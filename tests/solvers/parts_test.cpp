// Marching in parts: the same bits for any number of threads, and about the errors of marching in one.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/compare.h>
#include <brushfire/solvers/partition/vertex_partition.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "support/part_solver.h"
#include "support/same_field.h"
#include "support/shared_meshes.h"

namespace brushfire {
namespace {

using test::expect_equal_bits;
using test::PartSolver;

struct Way {
  Method method;
  Precision precision;
};
constexpr Way kWays[] = {{Method::NovotniKlein, Precision::Float},
                         {Method::NovotniKlein, Precision::Double},
                         {Method::KimmelSethian, Precision::Float},
                         {Method::KimmelSethian, Precision::Double},
                         {Method::NovotniKlein2002, Precision::Double}};

DistanceOptions options_of(const Way& way, unsigned threads) {
  DistanceOptions options;
  options.method = way.method;
  options.precision = way.precision;
  options.threads = threads;
  return options;
}

std::string name_of(const Way& way) {
  return std::string(name_of(way.method)) + (way.precision == Precision::Float ? " in float" : " in double");
}

std::vector<Source> some_sources(const Mesh& mesh) {
  return {{vertex_point(mesh, 100)}, {{400, {0, 0.5, 0.5}}, 0.1}, {{7, {0.25, 0.25, 0.5}}}};
}

constexpr unsigned kThreadCounts[] = {2, 3, 8, 32};

TEST(Parts, GiveTheSameBitsToAnyNumberOfThreads) {
  const Mesh mesh = shapes::folded_sphere(5).mesh();
  const std::vector<Source> sources = some_sources(mesh);
  for (const Way& way : kWays) {
    for (const Index part_size : {256u, 16u}) {
      PartSolver solver(mesh, part_size), alone(mesh, part_size);
      for (const std::size_t count : {1u, 3u}) {
        const std::span<const Source> from(sources.data(), count);
        const DistanceField one = alone.distance(from, options_of(way, 1));
        for (const unsigned threads : kThreadCounts) {
          expect_equal_bits(one, solver.distance(from, options_of(way, threads)), name_of(way));
        }
      }
    }
  }
}

TEST(Parts, GiveTheSameBitsWhereARadiusOrTargetsStopTheFront) {
  const Mesh mesh = shapes::folded_sphere(5).mesh();
  const std::vector<Source> sources = some_sources(mesh);
  for (const Way& way : kWays) {
    PartSolver solver(mesh, 64), alone(mesh, 64);
    DistanceOptions options = options_of(way, 1);
    for (int stop = 0; stop < 3; ++stop) {
      options.max_distance = stop == 0 ? 0.7 : kInfinity;
      options.targets.clear();
      if (stop == 1) options.targets = {vertex_point(mesh, 300), {900, {0.2, 0.3, 0.5}}};
      std::vector<Index> touched;
      options.threads = 1;
      const DistanceField one = alone.distance(sources, options);
      options.threads = 2;
      expect_equal_bits(one, solver.distance(sources, options), name_of(way));
      const DistanceField listed = solver.distance(sources, options, &touched);
      expect_equal_bits(one, listed, name_of(way));
      std::sort(touched.begin(), touched.end());
      EXPECT_EQ(std::adjacent_find(touched.begin(), touched.end()), touched.end());
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_EQ(listed.distance[v] < kInfinity, std::binary_search(touched.begin(), touched.end(), v));
      }
    }
  }
}

// The usual parts, of a mesh that is large enough to have some.
TEST(Parts, OfALargeMeshAreThoseOfItsSolver) {
  const Mesh mesh = shapes::torus(700, 300).mesh();
  ASSERT_GT(mesh.vertex_count(), fast_marching::usual_part_size(mesh));
  const Source source{vertex_point(mesh, 5)};
  DistanceOptions options = options_of({Method::NovotniKlein, Precision::Float}, 1);
  DistanceSolver solver(mesh);
  const DistanceField one = solver.distance({&source, 1}, options);
  for (const unsigned threads : {2u, 3u, 0u}) {
    options.threads = threads;
    expect_equal_bits(one, solver.distance({&source, 1}, options), std::to_string(threads) + " threads");
  }
  options.method = Method::Exact;
  const std::vector<double> truth = solver.distance({&source, 1}, options).distance;
  options.method = Method::NovotniKlein;
  const DistanceField whole = PartSolver(mesh, kNoIndex).distance({&source, 1}, options);
  EXPECT_LT(compare_fields(one.distance, truth).relative.mean,
            1.01 * compare_fields(whole.distance, truth).relative.mean);
}

// The borders of small parts are everywhere.
TEST(Parts, HardlyChangeTheErrors) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  double whole_sum = 0, parts_sum = 0;
  for (const auto& [name, from] : test::shared_truths()) {
    // On stretched meshes values chase each other, and any change of order changes the errors by some ten percent.
    if (name.ends_with("-x10")) continue;
    const Mesh mesh = test::shared_mesh(name);
    const std::vector<double> truth = test::shared_truth(name, from);
    const Source source{vertex_point(mesh, from)};
    const DistanceOptions options = options_of({Method::NovotniKlein, Precision::Float}, 1);
    const auto mean_error = [&](Index part_size) {
      return compare_fields(PartSolver(mesh, part_size).distance({&source, 1}, options).distance, truth).relative.mean;
    };
    whole_sum += mean_error(kNoIndex);
    parts_sum += mean_error(256);
  }
  EXPECT_LT(parts_sum, 1.01 * whole_sum);
}

TEST(Parts, AreLeftAndTakenUpAgainAfterACancelledRun) {
  const Mesh mesh = shapes::folded_sphere(6).mesh();
  const Source source{vertex_point(mesh, 3)};
  DistanceOptions options = options_of({Method::NovotniKlein, Precision::Float}, 2);
  PartSolver solver(mesh, 256);
  const DistanceField whole = solver.distance({&source, 1}, options);
  CancelToken cancel;
  int reports = 0;
  double last = 0;
  const std::thread::id caller = std::this_thread::get_id();
  options.cancel = &cancel;
  options.progress = [&](double done) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
    if (++reports == 20) cancel.cancel();
  };
  EXPECT_THROW(solver.distance({&source, 1}, options), Error);
  EXPECT_EQ(reports, 20);
  options.cancel = nullptr;
  last = 0;
  expect_equal_bits(whole, solver.distance({&source, 1}, options), "after a cancelled run");
}

// What a part names of others: each ghost once, told of by its owner, and telling it.
TEST(Parts, KnowEachOther) {
  partition::VertexPartitionBuilder builder(8, partition::part_shift(4));
  builder.add(2, 5);
  builder.add(3, 5);
  builder.add(3, 4);
  EXPECT_EQ(std::vector<Index>(3, 0).size(), builder.finish_part(0).size());
  builder.add(4, 3);
  builder.add(5, 3);
  builder.finish_part(1);
  const partition::VertexPartition parts = builder.take();
  ASSERT_EQ(parts.count(), 2u);
  EXPECT_EQ(parts.places(), 12u);
  EXPECT_EQ(parts.owner, (std::vector<Index>{4, 5, 3}));
  EXPECT_EQ(parts.channels.size(), 2u);
  const auto around = [&](Index ghost) {
    return std::vector<Index>(parts.around(ghost).begin(), parts.around(ghost).end());
  };
  EXPECT_EQ(around(9), (std::vector<Index>{3}));
  EXPECT_EQ(around(10), (std::vector<Index>{2, 3}));
  EXPECT_EQ(around(11), (std::vector<Index>{4, 5}));
  EXPECT_EQ(parts.links_of(3)[0].place, 11u);
  EXPECT_EQ(parts.links_of(11)[0].place, 3u);
  EXPECT_EQ(parts.channels[parts.links_of(11)[0].channel].receiver, 0u);
}

}  // namespace
}  // namespace brushfire
