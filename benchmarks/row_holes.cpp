// Whether rows of carried-source, sixteen at a time, reach what there is to reach, on any mesh, and are as near to the
// truth as rows that run alone.
//
//   row_holes [--limit VERTICES] MESH|FOLDER...
//
// One line per mesh: values of its matrix (all rows up to 20000 vertices; of larger meshes groups from all over, as
// many values), holes (a vertex that edges reach from the source has no distance), ghosts (the other way round),
// vertices farther than along edges from some sources, and relative errors of eight rows, mean / largest in percent, in
// groups and alone. The exit code says whether there was a hole, a ghost or something longer. Meshes of more than
// VERTICES (200000) are left out, and so are files of a folder that cannot be read.
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/queries/detail/rows.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "measure.h"
#include "mesh_files.h"

namespace brushfire::benchmark {
namespace {

constexpr std::uint64_t kValues = 400'000'000;
constexpr std::size_t kCompared = 8;

std::vector<double> from(DistanceSolver& solver, Index source, Method method) {
  DistanceOptions options;
  options.method = method;
  const Source place{vertex_point(solver.mesh(), source)};
  return solver.distance({&place, 1}, options).distance;
}

// The component of every vertex, by what edges reach; kNoIndex: in no face.
std::vector<Index> components_of(DistanceSolver& solver) {
  const Mesh& mesh = solver.mesh();
  std::vector<Index> component(mesh.vertex_count(), kNoIndex);
  Index count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (component[v] != kNoIndex || mesh.corners(v).empty()) continue;
    const std::vector<double> reach = from(solver, v, Method::Dijkstra);
    for (Index u = 0; u < mesh.vertex_count(); ++u) {
      if (std::isfinite(reach[u])) component[u] = count;
    }
    ++count;
  }
  return component;
}

// All rows, or those of units from all over the mesh.
std::vector<std::size_t> chosen_rows(detail::Rows& rows) {
  const detail::Rows::ByUnits units = rows.by_units();
  const std::size_t count = units.unit_start.size() - 1, most = std::max<std::size_t>(1, kValues / rows.columns());
  if (rows.count() <= most) return units.numbers;
  const double step = static_cast<double>(rows.count()) / static_cast<double>(most);
  std::vector<std::size_t> numbers;
  for (double at = 0; at < static_cast<double>(count); at += step) {
    const auto unit = static_cast<std::size_t>(at);
    for (std::size_t k = units.unit_start[unit]; k < units.unit_start[unit + 1]; ++k) {
      numbers.push_back(units.numbers[k]);
    }
  }
  return numbers;
}

struct Total {
  std::uint64_t values = 0, holes = 0, ghosts = 0, longer = 0;
  int meshes = 0;
};

void row_of(const std::string& name, const Mesh& mesh, Total& total) {
  DistanceSolver solver(mesh);
  const std::vector<Index> component = components_of(solver);
  MatrixOptions options;
  options.distance.method = Method::CarriedSource;
  detail::Rows rows(mesh, {}, {}, options);
  const std::vector<std::size_t> numbers = chosen_rows(rows);
  std::map<std::size_t, std::vector<float>> kept;
  for (std::size_t k = 0; k < kCompared; ++k) kept[numbers[numbers.size() * k / kCompared]];
  std::atomic<std::uint64_t> holes{0}, ghosts{0};
  rows.run_dense<float>(numbers, nullptr, [&](unsigned, std::size_t i, std::span<const float> values) {
    std::uint64_t missing = 0, wrong = 0;
    for (std::size_t v = 0; v < values.size(); ++v) {
      const bool there = component[i] != kNoIndex && component[i] == component[v];
      missing += there && !std::isfinite(values[v]) ? 1 : 0;
      wrong += !there && values[v] != std::numeric_limits<float>::infinity() ? 1 : 0;
    }
    holes += missing, ghosts += wrong;
    if (const auto at = kept.find(i); at != kept.end()) at->second.assign(values.begin(), values.end());
  });
  double sum[2] = {0, 0}, largest[2] = {0, 0}, count = 0;
  std::uint64_t longer = 0;
  for (const auto& [i, row] : kept) {
    const auto v = static_cast<Index>(i);
    if (component[v] == kNoIndex) continue;
    const std::vector<double> truth = from(solver, v, Method::Exact), single = from(solver, v, Method::CarriedSource),
                              edges = from(solver, v, Method::Dijkstra);
    for (Index u = 0; u < mesh.vertex_count(); ++u) {
      longer += static_cast<double>(row[u]) > edges[u] * (1 + 1e-4) ? 1 : 0;
      if (!(truth[u] > 0) || !std::isfinite(truth[u]) || !std::isfinite(row[u])) continue;
      const double error[2] = {std::abs(static_cast<double>(row[u]) / truth[u] - 1),
                               std::abs(single[u] / truth[u] - 1)};
      for (int k = 0; k < 2; ++k) sum[k] += error[k], largest[k] = std::max(largest[k], error[k]);
      ++count;
    }
  }
  const std::uint64_t values = std::uint64_t{numbers.size()} * mesh.vertex_count();
  const double percent = 100 / std::max(1.0, count);
  std::printf("| %s | %u | %llu | %llu | %llu | %llu | %.4f / %.2f | %.4f / %.2f |\n", name.c_str(),
              mesh.vertex_count(), static_cast<unsigned long long>(values),
              static_cast<unsigned long long>(holes.load()), static_cast<unsigned long long>(ghosts.load()),
              static_cast<unsigned long long>(longer), percent * sum[0], 100 * largest[0], percent * sum[1],
              100 * largest[1]);
  std::fflush(stdout);
  total.values += values, total.holes += holes, total.ghosts += ghosts, total.longer += longer, ++total.meshes;
}

int run(int count, char** arguments) {
  const auto [limit, files] = MeshArguments(count, arguments, 200'000);
  std::printf(
      "| mesh | vertices | values | holes | ghosts | longer | error in groups | alone |\n"
      "|---|--:|--:|--:|--:|--:|---|---|\n");
  Total total;
  for (const std::filesystem::path& file : files) {
    try {
      const Mesh mesh = read_mesh(file.string()).mesh;
      if (mesh.face_count() == 0 || mesh.vertex_count() > limit) continue;
      row_of(file.stem().string(), mesh, total);
    } catch (const Error& e) {
      std::fprintf(stderr, "%s: %s\n", file.c_str(), e.what());
    }
  }
  std::printf("\n%d meshes, %llu values: %llu holes, %llu ghosts, %llu longer than along edges\n", total.meshes,
              static_cast<unsigned long long>(total.values), static_cast<unsigned long long>(total.holes),
              static_cast<unsigned long long>(total.ghosts), static_cast<unsigned long long>(total.longer));
  return total.holes + total.ghosts + total.longer == 0 ? 0 : 1;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("row_holes", brushfire::benchmark::run, count, arguments);
}
