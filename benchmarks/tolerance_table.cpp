// tolerance_table MESH...: |value - distance| <= error_bound <= t * distance at every vertex, counted, for three
// sources and four tolerances per mesh, against exact; one line each, and the number of violations as the exit code.
#include "measure.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace brushfire::benchmark {
namespace {

struct Row {
  double median_error = 0, largest_error = 0, median_bound = 0, largest_bound = 0, microseconds = 0;
  std::size_t vertices = 0, violations = 0;
};

Row measure(DistanceSolver& solver, const Source& source, const DistanceField& exact, double tolerance) {
  DistanceOptions options;
  options.method = Method::Windows;
  options.tolerance = tolerance;
  const double start = cpu_seconds();
  const DistanceField field = solver.distance({&source, 1}, options);
  Row row;
  row.microseconds = 1e6 * (cpu_seconds() - start) / std::max<Index>(1, solver.mesh().vertex_count());
  std::vector<double> errors, bounds;
  for (std::size_t v = 0; v < exact.distance.size(); ++v) {
    const double d = exact.distance[v], got = field.distance[v];
    if (d == kInfinity || got == kInfinity) {
      if (d != got) ++row.violations;
      continue;
    }
    const double error = std::abs(got - d), bound = field.error_bound[v];
    if (!(error <= bound) || !(bound <= tolerance * d)) ++row.violations;
    if (d == 0) continue;
    errors.push_back(error / d);
    bounds.push_back(bound / d);
  }
  row.vertices = errors.size();
  if (errors.empty()) return row;
  row.largest_error = *std::max_element(errors.begin(), errors.end());
  row.largest_bound = *std::max_element(bounds.begin(), bounds.end());
  row.median_error = median(std::move(errors));
  row.median_bound = median(std::move(bounds));
  return row;
}

// Three vertices that are in faces: the first, one in the middle, the last.
std::vector<Source> three_sources(const Mesh& mesh) {
  std::vector<Index> candidates;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.corners(v).empty()) candidates.push_back(v);
  }
  std::vector<Source> sources;
  if (candidates.empty()) return sources;
  for (const std::size_t i : {std::size_t{0}, candidates.size() / 2, candidates.size() - 1}) {
    sources.push_back({vertex_point(mesh, candidates[i])});
  }
  return sources;
}

std::size_t table_of(const std::string& path) {
  const Mesh mesh = read_mesh(path).mesh;
  DistanceSolver solver(mesh);
  std::size_t violations = 0;
  int number = 0;
  for (const Source& source : three_sources(mesh)) {
    DistanceOptions exact;
    exact.method = Method::Exact;
    const DistanceField truth = solver.distance({&source, 1}, exact);
    ++number;
    for (const double t : {1e-2, 1e-3, 1e-4, 1e-5}) {
      const Row row = measure(solver, source, truth, t);
      std::printf("| %s | %d | %.0e | %zu | %.1e | %.1e | %.1e | %.1e | %.2f | %zu |\n",
                  std::filesystem::path(path).stem().string().c_str(), number, t, row.vertices, row.median_error,
                  row.largest_error, row.median_bound, row.largest_bound, row.microseconds, row.violations);
      violations += row.violations;
    }
  }
  return violations;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  using namespace brushfire;
  std::size_t violations = 0;
  std::printf(
      "| mesh | source | t | vertices | median error | largest | median bound | largest | us/vertex | violations |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 1; i < count; ++i) {
    try {
      violations += benchmark::table_of(arguments[i]);
    } catch (const Error& e) {
      std::fprintf(stderr, "%s: %s\n", arguments[i], e.what());
    }
  }
  std::printf("\n%zu violations\n", violations);
  return violations == 0 ? 0 : 1;
}
