// One mesh for 32 threads at once. Built by the preset `thread`, ThreadSanitizer watches.
#include <brushfire/core/parallel.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/compare.h>
#include <brushfire/queries/curved_isolines.h>
#include <brushfire/queries/distance_matrix.h>
#include <brushfire/queries/gradient.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/shorten.h>
#include <brushfire/queries/straightest.h>
#include <brushfire/queries/voronoi.h>

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <latch>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "support/part_solver.h"

namespace brushfire {
namespace {

constexpr unsigned kThreads = 32;
constexpr int kRounds = 4;

Mesh fresh_mesh() { return shapes::torus(24, 12).mesh(); }

double sum(std::span<const double> values) {
  double total = 0;
  for (const double v : values) total += v < kInfinity ? v : 0;
  return total;
}

std::vector<double> field_of(const Mesh& mesh, Method method = Method::Exact) {
  const Source source{vertex_point(mesh, 0)};
  DistanceOptions options;
  options.method = method;
  return distance(mesh, std::span(&source, 1), options).distance;
}

// Everything that can be asked of a mesh, each as one number.
using Question = std::function<double(const Mesh&)>;

std::vector<Question> questions() {
  std::vector<Question> all;
  for (const Method method : all_methods()) {
    all.emplace_back([=](const Mesh& m) { return sum(field_of(m, method)); });
  }
  all.emplace_back([](const Mesh& m) { return m.report().mean_edge_length; });
  all.emplace_back([](const Mesh& m) { return sum(m.lengths()) * m.unit() + sum(m.double_areas()); });
  all.emplace_back([](const Mesh& m) { return NearestPointFinder(m)({3, 1, 2}).distance; });
  all.emplace_back([](const Mesh& m) {
    const std::array points{vertex_point(m, 1), vertex_point(m, 50), vertex_point(m, 200)};
    return shorten(m, PathFinder(m).through(points).points).length;
  });
  all.emplace_back([](const Mesh& m) {
    const std::vector<double> values = field_of(m);
    double total = sum(vertex_areas(m));
    for (const Isoline& line : isolines(m, values, levels_between(values, 3))) total += line.line.length;
    for (const Vec3& g : face_gradients(m, values)) total += norm(g);
    return total;
  });
  all.emplace_back([](const Mesh& m) {
    const Source source{vertex_point(m, 7)};
    DistanceOptions options;
    options.keep_windows = true;
    const DistanceField field = distance(m, std::span(&source, 1), options);
    const std::array level{0.5};
    return curved_isolines(*field.windows, level, 0.01).front().line.length;
  });
  all.emplace_back([](const Mesh& m) {
    const std::array sources{Source{vertex_point(m, 7)}, Source{vertex_point(m, 100)}};
    return sum(voronoi(m, sources).area) + farthest_points(m, 4).covering_radius;
  });
  all.emplace_back([](const Mesh& m) {
    return straightest(m, vertex_point(m, 9), 0.3, 2).path.length + sum(log_map(m, vertex_point(m, 9), 1).radius);
  });
  all.emplace_back([](const Mesh& m) { return sum(field_of(cut(m, {{20, 21, 22}, {}, {}}).mesh)); });
  all.emplace_back([](const Mesh& m) {
    MatrixOptions options;
    options.threads = 2;
    return sum(distances_within<double>(m, 0.7, {}, options).value);
  });
  return all;
}

TEST(OneMesh, AnswersThirtyTwoThreadsAtOnceAsItAnswersOne) {
  const std::vector<Question> all = questions();
  const Mesh alone = fresh_mesh();
  std::vector<double> expected;
  for (const Question& question : all) expected.push_back(question(alone));

  for (int round = 0; round < kRounds; ++round) {
    const Mesh mesh = fresh_mesh();  // nothing derived yet: the threads meet in its lazy parts
    std::vector<double> answer(kThreads), wanted(kThreads);
    std::latch start(kThreads);
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        const std::size_t q = (t + static_cast<unsigned>(round)) % all.size();
        wanted[t] = expected[q];
        start.arrive_and_wait();
        const Mesh copy = mesh;  // copies share
        answer[t] = all[q](t % 2 == 0 ? mesh : copy);
      });
    }
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(answer, wanted) << "round " << round;
  }
}

TEST(OneMesh, GivesTheSameMatrixToAnyNumberOfThreads) {
  const Mesh mesh = fresh_mesh();
  MatrixOptions options;
  std::vector<double> one;
  for (const unsigned threads : {1u, 2u, 7u, kThreads}) {
    options.threads = threads;
    const std::vector<double> matrix = distance_matrix<double>(mesh, {}, {}, options);
    if (one.empty()) one = matrix;
    EXPECT_EQ(matrix, one) << threads << " threads";
  }
}

TEST(OneField, IsMarchedByAnyNumberOfThreads) {
  const Mesh mesh = shapes::torus(60, 40).mesh();
  const std::array sources{Source{vertex_point(mesh, 7)}, Source{vertex_point(mesh, 1000)}};
  for (const std::size_t count : {1u, 2u}) {
    std::vector<double> one;
    for (const unsigned threads : {1u, 2u, 8u}) {
      test::PartSolver solver(mesh, 32);
      DistanceOptions options;
      options.method = Method::NovotniKlein;
      options.threads = threads;
      for (int run = 0; run < 3; ++run) {
        const std::vector<double> field = solver.distance({sources.data(), count}, options).distance;
        if (one.empty()) one = field;
        EXPECT_EQ(field, one) << threads << " threads";
      }
    }
  }
}

TEST(OneFinder, AnswersThirtyTwoThreadsAtOnce) {
  const Mesh mesh = fresh_mesh();
  const NearestPointFinder finder(mesh);
  std::vector<double> found(kThreads);
  parallel_for(kThreads, kThreads,
               [&](unsigned, std::size_t i) { found[i] = finder({0.1 * static_cast<double>(i), 1, 0}).distance; });
  for (std::size_t i = 0; i < kThreads; ++i) EXPECT_EQ(found[i], finder({0.1 * static_cast<double>(i), 1, 0}).distance);
}

}  // namespace
}  // namespace brushfire
