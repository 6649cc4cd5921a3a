// curve_sources [FILE | LEVELS of a folded sphere] [METHOD]: processor time and error of every method, or one, from a
// curve, beside those from one of its points.
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>
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

constexpr int kRuns = 3;

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

// The shortest path between two vertices far apart, as far as it has so many places.
CurveSource long_curve(DistanceSolver& solver) {
  constexpr std::size_t kMost = 1001;
  const Mesh& mesh = solver.mesh();
  const SurfacePath path = path_between(solver, vertex_point(mesh, 0), vertex_point(mesh, mesh.vertex_count() / 2), {});
  CurveSource curve{path.points};
  curve.places.resize(std::min(curve.places.size(), kMost));
  return curve;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "6";
  const bool is_sphere = what.find_first_not_of("0123456789") == std::string::npos;
  const Mesh mesh =
      is_sphere ? shapes::folded_sphere(static_cast<Index>(std::stoul(what))).mesh() : read_mesh(what).mesh;
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
    if (count > 2 && name_of(method) != arguments[2]) continue;
    const DistanceOptions how{.method = method};
    double point_time = kInfinity, line_time = kInfinity;
    for (int run = 0; run < kRuns; ++run) {  // in turn: what else the machine does hits both
      point_time = std::min(point_time, time_of(solver, point, how, from_point));
      line_time = std::min(line_time, time_of(solver, line, how, from_line));
    }
    std::printf("%-20s %12.3f %12.3f %7.2f %11.4f%% %11.4f%%\n", std::string(name_of(method)).c_str(), point_time,
                line_time, line_time / point_time, 100 * error_of(from_point, point_truth),
                100 * error_of(from_line, line_truth));
  }
}
