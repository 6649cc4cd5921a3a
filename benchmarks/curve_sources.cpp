// curve_sources [FILE]: time and error of every method from a curve, beside those from one of its points.
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace brushfire;

constexpr int kRuns = 3;

// The quickest of a few runs, in microseconds for each vertex that is reached.
double time_of(DistanceSolver& solver, const std::vector<Source>& sources, const DistanceOptions& how,
               DistanceField& field) {
  double best = kInfinity;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    solver.distance(sources, how, field);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 1e6 * best / field.reached;
}

struct Error {
  double mean = 0, largest = 0;
};
Error error_of(const DistanceField& field, const DistanceField& truth) {
  Error e;
  double count = 0;
  for (std::size_t v = 0; v < truth.distance.size(); ++v) {
    const double d = truth.distance[v];
    if (!(d > 1e-9) || d == kInfinity) continue;  // on the curve, but for rounding
    const double relative = std::abs(field.distance[v] - d) / d;
    e.mean += relative;
    e.largest = std::max(e.largest, relative);
    ++count;
  }
  e.mean /= count;
  return e;
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
  const Mesh mesh = count > 1 ? read_mesh(arguments[1]).mesh : shapes::folded_sphere(6).mesh();
  DistanceSolver solver(mesh);
  const CurveSource curve = long_curve(solver);
  const std::vector<Source> line{source_along(curve)}, point{{curve.places[curve.places.size() / 2]}};
  std::printf("%u vertices, a curve of %zu segments\n", mesh.vertex_count(), curve.places.size() - 1);
  std::printf("%-20s %12s %12s %7s %12s %12s\n", "", "point us/v", "curve us/v", "ratio", "point error", "curve error");
  DistanceField field;
  const DistanceField point_truth = solver.distance(point, {.method = Method::Exact});
  const DistanceField line_truth = solver.distance(line, {.method = Method::Exact});
  for (const Method method : all_methods()) {
    const DistanceOptions how{.method = method};
    const double point_time = time_of(solver, point, how, field);
    const Error point_error = error_of(field, point_truth);
    const double line_time = time_of(solver, line, how, field);
    const Error line_error = error_of(field, line_truth);
    std::printf("%-20s %12.3f %12.3f %7.2f %11.4f%% %11.4f%%\n", std::string(name_of(method)).c_str(), point_time,
                line_time, line_time / point_time, 100 * point_error.mean, 100 * line_error.mean);
  }
}
