// curve_sources [FILE | LEVELS of a folded sphere] [METHOD | all] [ROUNDS]: processor time and error of every method,
// or one, from a curve of 1000 segments, beside those from one of its points. Times are medians of runs in turn,
// quotients those of neighbouring runs. Of the ROUNDS each splits every triangle into four, as make_arrays does.
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/mesh/subdivide.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "measure.h"

namespace {

using namespace brushfire;

constexpr int kRuns = 7;
constexpr std::size_t kSegments = 1000;

// In microseconds for each vertex that is reached.
double time_of(DistanceSolver& solver, const std::vector<Source>& sources, const DistanceOptions& how,
               DistanceField& field) {
  const double start = benchmark::cpu_seconds();
  solver.distance(sources, how, field);
  return 1e6 * (benchmark::cpu_seconds() - start) / field.reached;
}

// Relative, on average.
double error_of(const DistanceField& field, const DistanceField& truth) {
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < truth.distance.size(); ++v) {
    const double d = truth.distance[v];
    if (!(d > 1e-9) || d == kInfinity) continue;  // on the curve, but for rounding
    sum += std::abs(field.distance[v] - d) / d;
    ++count;
  }
  return sum / count;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Shortest paths between vertices far apart, one after the other, until it has all its segments.
CurveSource long_curve(DistanceSolver& solver) {
  const Mesh& mesh = solver.mesh();
  const std::vector<Index> quarters{0, 2, 1, 3};
  CurveSource curve;
  for (std::size_t i = 0; curve.places.size() <= kSegments && i < 100; ++i) {
    const auto at = [&](std::size_t k) {
      return vertex_point(
          mesh, static_cast<Index>((quarters[k % 4] * (mesh.vertex_count() / 4) + k / 4) % mesh.vertex_count()));
    };
    const SurfacePath path = path_between(solver, at(i), at(i + 1), {});
    if (!curve.places.empty()) curve.places.pop_back();  // where the next one begins
    curve.places.insert(curve.places.end(), path.points.begin(), path.points.end());
  }
  curve.places.resize(std::min(curve.places.size(), kSegments + 1));
  return curve;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "6";
  const bool is_sphere = what.find_first_not_of("0123456789") == std::string::npos;
  Mesh mesh = is_sphere ? shapes::folded_sphere(static_cast<Index>(std::stoul(what))).mesh() : read_mesh(what).mesh;
  const int rounds = count > 3 ? std::stoi(arguments[3]) : 0;
  for (int round = 0; round < rounds; ++round) {
    mesh = subdivided(mesh, {SubdivisionRule::LoopOdd, 0.02, static_cast<std::uint64_t>(round) + 1}).mesh();
  }
  DistanceSolver solver(mesh);
  const CurveSource curve = long_curve(solver);
  const std::vector<Source> line{source_along(curve)}, point{{curve.places[curve.places.size() / 2]}};
  std::printf("%u vertices, a curve of %zu segments\n", mesh.vertex_count(), curve.places.size() - 1);
  std::printf("%-20s %12s %12s %7s %12s %12s\n", "", "point us/v", "curve us/v", "ratio", "point error", "curve error");
  DistanceField from_point, from_line;
  const DistanceField point_truth = solver.distance(point, {.method = Method::Exact});
  const DistanceField line_truth = solver.distance(line, {.method = Method::Exact});
  for (const Method method : all_methods()) {
    if (method == Method::Heat) continue;  // starts at points
    if (count > 2 && arguments[2] != std::string("all") && name_of(method) != arguments[2]) continue;
    const DistanceOptions how{.method = method};
    std::vector<double> point_times, line_times, quotients;
    for (int run = 0; run < kRuns; ++run) {  // in turn: what else the machine does hits both
      point_times.push_back(time_of(solver, point, how, from_point));
      line_times.push_back(time_of(solver, line, how, from_line));
      quotients.push_back(line_times.back() / point_times.back());
    }
    std::printf("%-20s %12.3f %12.3f %7.2f %11.4f%% %11.4f%%\n", std::string(name_of(method)).c_str(),
                median(point_times), median(line_times), median(quotients), 100 * error_of(from_point, point_truth),
                100 * error_of(from_line, line_truth));
  }
}
