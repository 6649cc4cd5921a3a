// Rows of a distance matrix by windows: exact and with a tolerance; neighbours one after the other, or in between; to
// every vertex, or to few. Interleaved, in processor time, set-up apart.
//
//   time_window_rows MESH [CLUSTERS [ROUNDS]]
//
// CLUSTERS (3) clusters of eight neighbouring vertices are taken from all over the mesh, and their rows are run ROUNDS
// (5) times; medians are told. Prints one row of a table in Markdown: nanoseconds a value of exact, 1e-3, 1e-2, and
// what the latter two take beside exact (cluster by cluster); what each takes in an order in which neighbours are never
// one after the other, beside that; what exact rows take to the vertices of the cluster alone, and to all clusters',
// beside whole rows.
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/detail/locality_order.h>
#include <brushfire/solvers/distance.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "measure.h"

namespace brushfire::benchmark {
namespace {

constexpr std::size_t kNeighbours = 8;

struct Row {
  Index source;
  std::vector<SurfacePoint> targets;  // none: to every vertex
};

std::vector<SurfacePoint> points(const Mesh& mesh, std::span<const Index> vertices) {
  std::vector<SurfacePoint> result;
  for (const Index v : vertices) result.push_back(vertex_point(mesh, v));
  return result;
}

double seconds(DistanceSolver& solver, const DistanceOptions& options, std::span<const Row> rows) {
  static SparseField field;
  const double begin = cpu_seconds();
  for (const Row& row : rows) {
    DistanceOptions own = options;
    own.targets = row.targets;
    const Source source{vertex_point(solver.mesh(), row.source)};
    solver.distance_sparse({&source, 1}, own, field);
  }
  return cpu_seconds() - begin;
}

int run(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: time_window_rows MESH [CLUSTERS [ROUNDS]]\n");
    return 2;
  }
  const Mesh mesh = read_mesh(arguments[1]).mesh;
  const std::size_t clusters = count > 2 ? std::stoul(arguments[2]) : 3;
  const int rounds = count > 3 ? std::stoi(arguments[3]) : 5;
  const LocalityOrder order = locality_order(mesh);
  std::vector<Index> sources;
  for (std::size_t c = 0; c < clusters; ++c) {
    const std::size_t first = (mesh.vertex_count() - kNeighbours) * c / clusters;
    for (std::size_t k = 0; k < kNeighbours; ++k) sources.push_back(order.vertices[first + k]);
  }
  std::vector<Row> together, apart, to_cluster, to_all;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    together.push_back({sources[i], {}});
    apart.push_back({sources[i % clusters * kNeighbours + i / clusters], {}});
    to_cluster.push_back(
        {sources[i], points(mesh, std::span(sources).subspan(i / kNeighbours * kNeighbours, kNeighbours))});
    to_all.push_back({sources[i], points(mesh, sources)});
  }

  DistanceSolver solver(mesh);
  const std::array<DistanceOptions, 3> methods{options_named("exact"), options_named("windows:1e-3"),
                                               options_named("windows:1e-2")};
  std::array<std::vector<double>, 3> times, to_exact, scattered;
  std::vector<double> near, all;
  for (int round = 0; round < rounds + 1; ++round) {
    std::array<double, 3> now{}, then{};
    for (std::size_t m = 0; m < methods.size(); ++m) {
      now[m] = seconds(solver, methods[m], together);
      then[m] = seconds(solver, methods[m], apart);
    }
    const double to_near = seconds(solver, methods[0], to_cluster), to_far = seconds(solver, methods[0], to_all);
    if (round == 0) continue;  // warms up
    for (std::size_t m = 0; m < methods.size(); ++m) {
      times[m].push_back(now[m]);
      to_exact[m].push_back(now[m] / now[0]);
      scattered[m].push_back(then[m] / now[m]);
    }
    near.push_back(to_near / now[0]), all.push_back(to_far / now[0]);
  }
  const double values = static_cast<double>(sources.size()) * mesh.vertex_count();
  std::string name = arguments[1];
  name = name.substr(name.find_last_of('/') + 1);
  std::printf("| %s | %u | %.0f | %.0f | %.0f | %.2f | %.2f | %.3f | %.3f | %.3f | %.3f | %.3f |\n", name.c_str(),
              mesh.vertex_count(), 1e9 * median(times[0]) / values, 1e9 * median(times[1]) / values,
              1e9 * median(times[2]) / values, median(to_exact[1]), median(to_exact[2]), median(scattered[0]),
              median(scattered[1]), median(scattered[2]), median(near), median(all));
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("time_window_rows", brushfire::benchmark::run, count, arguments);
}
