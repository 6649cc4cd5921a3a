// Whether `windows` keeps its tolerance: value, bound and reach at every vertex against exact, for three vertices, two
// curves and four tolerances per mesh.
//
//   tolerance_table [--limit VERTICES] MESH|FOLDER...
//
// One line per mesh, source and tolerance; a summary per tolerance; the exit code says whether anything was violated.
// Windows are merged in all of these runs, also where an exact run would be quicker and is what a user gets.
// Meshes of more than VERTICES (200000) are left out, and so are files of a folder that cannot be read.
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/windows/engine.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>

#include "curves/random_curves.h"
#include "measure.h"
#include "mesh_files.h"
#include "support/engine_run.h"

namespace brushfire::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr std::array kTolerances{1e-2, 1e-3, 1e-4, 1e-5};
// Errors below this are rounding: their ratio to a bound says nothing.
constexpr double kRounding = 1e-13;

// Of one run, relative to the distance.
struct Row {
  double mean_error = 0, largest_error = 0, largest_near = 0;  // near: within two edges of the source
  double median_bound = 0, largest_bound = 0;
  double median_ratio = 0;  // bound / error, where the error is more than rounding
  double microseconds = 0;  // per vertex
  std::size_t vertices = 0, violations = 0, wrong_reach = 0;
};

// A source, where it is, and what lengths are counted from, in mesh.unit().
struct Start {
  std::string name;
  Source source;
  std::vector<Index> vertices;  // those of its faces
  double least = 0;
};

// The vertices at most two edges away.
std::vector<bool> near(const Mesh& mesh, const Start& start) {
  std::vector<bool> is_near(mesh.vertex_count(), false);
  for (const Index v : start.vertices) is_near[v] = true;
  for (int round = 0; round < 2; ++round) {
    const std::vector<bool> inner = is_near;
    for (const Face& t : mesh.faces()) {
      if (!inner[t[0]] && !inner[t[1]] && !inner[t[2]]) continue;
      for (const Index v : t) is_near[v] = true;
    }
  }
  return is_near;
}

Row measure(const Mesh& mesh, detail::Engine& engine, const Start& from, const DistanceField& exact, double tolerance) {
  DistanceOptions options;
  options.method = Method::Windows;
  options.tolerance = tolerance;
  const double start = cpu_seconds();
  const DistanceField field = test::run(engine, mesh, {from.source}, options);
  Row row;
  row.microseconds = 1e6 * (cpu_seconds() - start) / std::max<Index>(1, mesh.vertex_count());
  const std::vector<bool> is_near = near(mesh, from);
  std::vector<double> bounds, ratios;
  double sum = 0;
  for (std::size_t v = 0; v < exact.distance.size(); ++v) {
    const double d = exact.distance[v], got = field.distance[v];
    if ((d == kInfinity) != (got == kInfinity)) ++row.wrong_reach;
    if (d == kInfinity || got == kInfinity) continue;
    const double error = std::abs(got - d), bound = field.error_bound[v], length = d - from.least;
    // Beside a curve no vertex is known better than rounding: docs/tolerance.md.
    const double rounding = from.source.curve ? 2 * exact.error_bound[v] : 0;
    if (!(error <= bound) || !(bound <= tolerance * length + rounding)) ++row.violations;
    if (length <= rounding / tolerance) continue;
    ++row.vertices;
    sum += error / length;
    row.largest_error = std::max(row.largest_error, error / length);
    if (is_near[v]) row.largest_near = std::max(row.largest_near, error / length);
    bounds.push_back(bound / length);
    if (error > kRounding * length) ratios.push_back(bound / error);
  }
  if (row.vertices == 0) return row;
  row.mean_error = sum / static_cast<double>(row.vertices);
  row.largest_bound = *std::max_element(bounds.begin(), bounds.end());
  row.median_bound = median(std::move(bounds));
  row.median_ratio = ratios.empty() ? 0 : median(std::move(ratios));
  return row;
}

// All rows of one tolerance.
struct Summary {
  std::size_t rows = 0, vertices = 0, violations = 0, wrong_reach = 0;
  double largest_mean = 0, largest_error = 0, largest_near = 0, largest_bound = 0;
  std::vector<double> ratios;
  void add(const Row& r) {
    ++rows;
    vertices += r.vertices;
    violations += r.violations;
    wrong_reach += r.wrong_reach;
    largest_mean = std::max(largest_mean, r.mean_error);
    largest_error = std::max(largest_error, r.largest_error);
    largest_near = std::max(largest_near, r.largest_near);
    largest_bound = std::max(largest_bound, r.largest_bound);
    if (r.median_ratio > 0) ratios.push_back(r.median_ratio);
  }
};
using Summaries = std::array<Summary, kTolerances.size()>;

// A walk from face to face, 200 places long, and as long as the mesh has room for it; with offsets or without.
Start curve_on(const Mesh& mesh, bool offsets) {
  constexpr int kPlaces = 200;
  std::mt19937 random(offsets ? 2 : 1);
  CurveSource curve{test::random_walk(mesh, kPlaces, random)};
  if (offsets) test::give_offsets(mesh, curve, random);
  Start start;
  start.name = offsets ? "curve with offsets" : "curve";
  start.source = source_along(curve);
  const LocatedCurve located = locate(mesh, curve);
  start.least = located.least_offset / mesh.unit();
  for (const CurvePlace& p : located.places) {
    for (const Index v : mesh.faces()[p.at.face]) start.vertices.push_back(v);
  }
  return start;
}

// Three vertices that are in faces: the first, one in the middle, the last; and two curves.
std::vector<Start> starts_on(const Mesh& mesh) {
  std::vector<Index> candidates;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.corners(v).empty()) candidates.push_back(v);
  }
  std::vector<Start> starts;
  if (candidates.empty()) return starts;
  for (const Index v : {candidates.front(), candidates[candidates.size() / 2], candidates.back()}) {
    Start start;
    start.name = std::to_string(starts.size() + 1);
    start.source.point = vertex_point(mesh, v);
    start.vertices = {v};
    starts.push_back(std::move(start));
  }
  bool usable = false;
  for (Index f = 0; f < mesh.face_count(); ++f) usable = usable || mesh.is_face_usable(f);
  if (!usable || !mesh.has_positions()) return starts;
  for (const bool offsets : {false, true}) starts.push_back(curve_on(mesh, offsets));
  return starts;
}

void rows_of(const std::string& name, const Mesh& mesh, Summaries& points, Summaries& curves) {
  const auto engine = windows::make_windows(mesh, windows::kPartBits, windows::Merging::Always);
  for (const Start& start : starts_on(mesh)) {
    DistanceOptions options;
    options.method = Method::Exact;
    const DistanceField exact = test::run(*engine, mesh, {start.source}, options);
    Summaries& summaries = start.source.curve ? curves : points;
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
      const Row r = measure(mesh, *engine, start, exact, kTolerances[i]);
      std::printf("| %s | %s | %.0e | %zu | %.1e | %.1e | %.1e | %.1e | %.1e | %.1f | %.2f | %zu | %zu |\n",
                  name.c_str(), start.name.c_str(), kTolerances[i], r.vertices, r.mean_error, r.largest_error,
                  r.largest_near, r.median_bound, r.largest_bound, r.median_ratio, r.microseconds, r.violations,
                  r.wrong_reach);
      summaries[i].add(r);
    }
  }
  std::fflush(stdout);
}

std::size_t print(const char* title, Summaries& summaries) {
  std::printf(
      "\n%s\n\n| t | runs | vertices | largest mean error | largest error | near the source | largest bound |"
      " median bound / error | violations | wrong reach |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
      title);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < kTolerances.size(); ++i) {
    Summary& s = summaries[i];
    std::printf("| %.0e | %zu | %zu | %.1e | %.1e | %.1e | %.1e | %.1f | %zu | %zu |\n", kTolerances[i], s.rows,
                s.vertices, s.largest_mean, s.largest_error, s.largest_near, s.largest_bound,
                s.ratios.empty() ? 0 : median(s.ratios), s.violations, s.wrong_reach);
    wrong += s.violations + s.wrong_reach;
  }
  return wrong;
}

int run(int count, char** arguments) {
  const auto [limit, files] = MeshArguments(count, arguments, 200'000);
  std::printf(
      "| mesh | source | t | vertices | mean error | largest error | near the source | median bound | largest bound |"
      " median bound / error | us/vertex | violations | wrong reach |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  Summaries planes, meshes, curves;
  rows_of("plane 100 x 100 (made)", shapes::plane(100, 100).mesh(), planes, curves);
  rows_of("plane 200 x 20 (made)", shapes::plane(200, 20, 3, 1).mesh(), planes, curves);
  std::size_t mesh_count = 0;
  for (const fs::path& file : files) {
    try {
      const Mesh mesh = read_mesh(file.string()).mesh;
      if (mesh.face_count() == 0 || mesh.vertex_count() > limit) continue;
      rows_of(file.stem().string(), mesh, meshes, curves);
      ++mesh_count;
    } catch (const Error& e) {
      std::fprintf(stderr, "%s: %s\n", file.c_str(), e.what());
    }
  }
  std::size_t wrong = print("Planes, where one source explains everything:", planes);
  wrong += print((std::to_string(mesh_count) + " meshes, three sources each:").c_str(), meshes);
  wrong += print("All of these from two curves each, one with offsets that change along it:", curves);
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("tolerance_table", brushfire::benchmark::run, count, arguments);
}
