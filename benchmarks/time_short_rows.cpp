// Rows of a matrix within a radius: those of novotni-klein, one source at a time, and of carried-source, alone and in
// groups (as distances_within() has them); interleaved, in processor time, set-up apart.
//
//   time_short_rows MESH RADIUS [GROUPS [ROUNDS]]
//
// RADIUS in mean edges. GROUPS (64) groups are taken from all over the mesh, and run ROUNDS (7) times; medians are
// told. Prints one row of a table in Markdown: entries a row, microseconds a row, the ratio of novotni-klein's to those
// in groups, relative differences (in percent, mean / largest) of both methods from exact rows, turns and updates a
// group.
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "measure.h"

namespace brushfire::benchmark {
namespace {

using carried_source::GroupedRows;
using carried_source::GroupRunner;

struct Rows {
  std::vector<Index> column;
  std::vector<double> value;
  std::vector<std::size_t> start{0};
};

double seconds_alone(DistanceSolver& solver, Method method, std::span<const Index> sources, double radius, Rows& rows) {
  DistanceOptions options;
  options.method = method;
  options.max_distance = radius;
  static SparseField field;
  rows = {};
  const double begin = cpu_seconds();
  for (const Index s : sources) {
    const Source source{vertex_point(solver.mesh(), s)};
    solver.distance_sparse({&source, 1}, options, field);
    rows.column.insert(rows.column.end(), field.vertex.begin(), field.vertex.end());
    rows.value.insert(rows.value.end(), field.distance.begin(), field.distance.end());
    rows.start.push_back(rows.column.size());
  }
  return cpu_seconds() - begin;
}

double seconds_grouped(GroupRunner& runner, std::span<const GroupedRows::Group> groups, double radius, Rows& rows,
                       double& turns, double& updates) {
  rows = {};
  turns = updates = 0;
  const double begin = cpu_seconds();
  for (const GroupedRows::Group& g : groups) {
    runner.run_within(g, radius, [&](int, std::span<const Index> vertices, std::span<const float> distances) {
      rows.column.insert(rows.column.end(), vertices.begin(), vertices.end());
      for (const float d : distances) rows.value.push_back(static_cast<double>(d) * runner.unit());
      rows.start.push_back(rows.column.size());
    });
    turns += static_cast<double>(runner.march().turns()), updates += static_cast<double>(runner.march().updates());
  }
  return cpu_seconds() - begin;
}

std::string errors(const Rows& rows, const Rows& truth) {
  double sum = 0, largest = 0, count = 0;
  std::size_t missing = 0;
  for (std::size_t i = 0; i + 1 < truth.start.size(); ++i) {
    const auto first = rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[i]);
    const auto last = rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[i + 1]);
    for (std::size_t k = truth.start[i]; k < truth.start[i + 1]; ++k) {
      const auto at = std::lower_bound(first, last, truth.column[k]);
      if (at == last || *at != truth.column[k]) {
        ++missing;
      } else if (truth.value[k] > 0) {
        const double d = rows.value[static_cast<std::size_t>(at - rows.column.begin())];
        const double error = 100 * std::abs(d / truth.value[k] - 1);
        sum += error, largest = std::max(largest, error), ++count;
      }
    }
  }
  char text[100];
  std::snprintf(text, sizeof text, "%.4f / %.1f (%zu out)", sum / count, largest, missing);
  return text;
}

int run(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "usage: time_short_rows MESH RADIUS [GROUPS [ROUNDS]]\n");
    return 2;
  }
  const Mesh mesh = read_mesh(arguments[1]).mesh;
  double sum = 0;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) sum += mesh.length(h);
  const double radius = std::stod(arguments[2]) * sum / mesh.halfedge_count() * mesh.unit();
  const std::size_t group_count = count > 3 ? std::stoul(arguments[3]) : 64;
  const int rounds = count > 4 ? std::stoi(arguments[4]) : 7;
  std::vector<Index> all(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) all[v] = v;
  const GroupedRows grouped(mesh, all);
  GroupRunner runner(grouped);
  std::vector<GroupedRows::Group> groups;
  std::vector<Index> sources;
  // Runs of eight neighbouring groups, as a whole matrix has them: the next one finds the caches filled.
  constexpr std::size_t kRun = 8;
  for (std::size_t k = 0; k < group_count; ++k) {
    const std::size_t runs = (group_count + kRun - 1) / kRun;
    const std::size_t at = grouped.groups().size() * (k / kRun) / runs + k % kRun;
    groups.push_back(grouped.groups()[std::min(at, grouped.groups().size() - 1)]);
  }
  for (const auto& g : groups) sources.insert(sources.end(), g.vertices.begin(), g.vertices.end());
  DistanceSolver solver(mesh);
  std::vector<double> nk, alone, in_groups, ratio;
  Rows nk_rows, alone_rows, group_rows, truth;
  double turns = 0, updates = 0;
  for (int round = 0; round < rounds + 1; ++round) {
    const double a = seconds_alone(solver, Method::NovotniKlein, sources, radius, nk_rows);
    const double b = seconds_grouped(runner, groups, radius, group_rows, turns, updates);
    const double c = seconds_alone(solver, Method::CarriedSource, sources, radius, alone_rows);
    if (round == 0) continue;  // warms up
    nk.push_back(a), in_groups.push_back(b), alone.push_back(c), ratio.push_back(a / b);
  }
  seconds_alone(solver, Method::Exact, sources, radius, truth);
  const double rows = 1e-6 * static_cast<double>(sources.size()), all_groups = static_cast<double>(groups.size());
  std::string name = arguments[1];
  name = name.substr(name.find_last_of('/') + 1);
  std::printf("| %s | %s | %.0f | %.1f | %.1f | %.2f | x%.2f | %s | %s | %.0f, %.0f |\n", name.c_str(), arguments[2],
              static_cast<double>(truth.column.size()) / static_cast<double>(sources.size()), median(nk) / rows,
              median(alone) / rows, median(in_groups) / rows, median(ratio), errors(nk_rows, truth).c_str(),
              errors(group_rows, truth).c_str(), turns / all_groups, updates / all_groups);
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("time_short_rows", brushfire::benchmark::run, count, arguments);
}
