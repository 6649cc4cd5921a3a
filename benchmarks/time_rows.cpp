// Rows of a distance matrix: those of novotni-klein, one source at a time, and of carried-source, alone and in groups
// of sixteen (as distance_matrix() has them); interleaved, in processor time, set-up apart. And the error of all three.
//
//   time_rows MESH [GROUPS [ROUNDS [VARIANT]]]
//
// GROUPS (3) groups are taken from all over the mesh, and run ROUNDS (5) times; medians are told. VARIANT: best, avx2
// or portable. Prints one row of a table in Markdown; errors in percent, mean / 99th percentile / largest.
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/solvers/carried_source/detail/grouped_rows.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "measure.h"

namespace brushfire::benchmark {
namespace {

using carried_source::GroupedRows;
using carried_source::GroupRunner;
using Row = std::vector<double>;

std::string errors(const std::vector<Row>& rows, const std::vector<Row>& truth) {
  std::vector<double> all;
  std::size_t holes = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t v = 0; v < rows[i].size(); ++v) {
      const double t = truth[i][v], d = rows[i][v];
      if (std::isfinite(t) != std::isfinite(d)) ++holes;
      if (t > 0 && std::isfinite(t) && std::isfinite(d)) all.push_back(100 * std::abs(d - t) / t);
    }
  }
  std::sort(all.begin(), all.end());
  double sum = 0;
  for (const double e : all) sum += e;
  char text[100];
  std::snprintf(text, sizeof text, "%.4f / %.2f / %.1f", sum / static_cast<double>(all.size()),
                all[all.size() * 99 / 100], all.back());
  return text + (holes == 0 ? std::string() : ", " + std::to_string(holes) + " holes");
}

// One after the other; into `rows` where wanted.
double seconds_alone(DistanceSolver& solver, Method method, std::span<const Index> sources, std::vector<Row>* rows) {
  DistanceOptions options;
  options.method = method;
  static SparseField field;
  static std::vector<float> out;
  const double begin = cpu_seconds();
  for (const Index s : sources) {
    const Source source{vertex_point(solver.mesh(), s)};
    solver.distance_sparse({&source, 1}, options, field);
    out.assign(solver.mesh().vertex_count(), std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k < field.vertex.size(); ++k) out[field.vertex[k]] = static_cast<float>(field.distance[k]);
    if (rows == nullptr) continue;
    rows->emplace_back(solver.mesh().vertex_count(), kInfinity);
    for (std::size_t k = 0; k < field.vertex.size(); ++k) rows->back()[field.vertex[k]] = field.distance[k];
  }
  return cpu_seconds() - begin;
}

struct Counts {
  double turns = 0, updates = 0;
  std::size_t alone = 0;
};

double seconds_grouped(GroupRunner& runner, std::span<const GroupedRows::Group> groups, std::vector<Row>* rows,
                       Counts& counts) {
  static std::vector<float> out;
  const auto scale = static_cast<float>(runner.unit());
  const double begin = cpu_seconds();
  counts = {};
  for (const GroupedRows::Group& g : groups) {
    std::vector<Row> of_group(g.vertices.size());
    const auto refused = runner.run(g, kInfinity, [&](int lane, std::span<const float> row) {
      out.resize(row.size());
      std::transform(row.begin(), row.end(), out.begin(), [=](float value) { return value * scale; });
      if (rows != nullptr) of_group[static_cast<std::size_t>(lane)].assign(out.begin(), out.end());
    });
    counts.alone += refused.size();
    counts.turns += static_cast<double>(runner.march().turns());
    counts.updates += static_cast<double>(runner.march().updates());
    if (rows != nullptr) rows->insert(rows->end(), of_group.begin(), of_group.end());
  }
  return cpu_seconds() - begin;
}

int run(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: time_rows MESH [GROUPS [ROUNDS [best|avx2|portable]]]\n");
    return 2;
  }
  const Mesh mesh = read_mesh(arguments[1]).mesh;
  const std::size_t group_count = count > 2 ? std::stoul(arguments[2]) : 3;
  const int rounds = count > 3 ? std::stoi(arguments[3]) : 5;
  const std::string variant = count > 4 ? arguments[4] : "best";
  std::vector<Index> all(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) all[v] = v;
  double begin = cpu_seconds();
  const GroupedRows grouped(mesh, all);
  const double set_up = cpu_seconds() - begin;
  GroupRunner runner(grouped, variant == "avx2"       ? Variant::Avx2
                              : variant == "portable" ? Variant::Portable
                                                      : Variant::Best);
  std::vector<GroupedRows::Group> groups;
  for (std::size_t k = 0; k < group_count; ++k) {
    groups.push_back(grouped.groups()[grouped.groups().size() * k / group_count]);
  }
  std::vector<Index> sources;
  for (const auto& g : groups) sources.insert(sources.end(), g.vertices.begin(), g.vertices.end());

  DistanceSolver solver(mesh);
  std::vector<double> nk, alone, in_groups, to_nk;
  std::vector<Row> nk_rows, alone_rows, group_rows, truth;
  Counts counts;
  for (int round = 0; round < rounds + 1; ++round) {
    const bool first = round == 0;  // warms up, and keeps the rows
    const double a = seconds_alone(solver, Method::NovotniKlein, sources, first ? &nk_rows : nullptr);
    const double b = seconds_grouped(runner, groups, first ? &group_rows : nullptr, counts);
    const double c = seconds_alone(solver, Method::CarriedSource, sources, first ? &alone_rows : nullptr);
    if (first) continue;
    nk.push_back(a), in_groups.push_back(b), alone.push_back(c), to_nk.push_back(a / b);
  }
  seconds_alone(solver, Method::Exact, sources, &truth);
  const double values = static_cast<double>(sources.size()) * mesh.vertex_count();
  const double vertices = static_cast<double>(groups.size()) * mesh.vertex_count();
  std::string name = arguments[1];
  name = name.substr(name.find_last_of('/') + 1);
  std::printf("| %s | %u | %.1f | %.1f | %.1f | x%.1f | %s | %s | %s | %s | %.2f, %.1f | %zu | %.2f |\n", name.c_str(),
              mesh.vertex_count(), 1e9 * median(nk) / values, 1e9 * median(alone) / values,
              1e9 * median(in_groups) / values, median(to_nk), errors(nk_rows, truth).c_str(),
              errors(alone_rows, truth).c_str(), errors(group_rows, truth).c_str(),
              errors(group_rows, alone_rows).c_str(), counts.turns / vertices, counts.updates / vertices, counts.alone,
              1e6 * set_up / mesh.vertex_count());
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("time_rows", brushfire::benchmark::run, count, arguments);
}
