// What paths and logarithmic maps cost beside the field: reading a path off it, a near pair without it, a small disc.
//
//   time_paths [LEVEL]     on folded spheres of 10 * 4^LEVEL + 2 vertices (default 8: 655362)
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/straightest.h>

#include "../measure.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace brushfire;

using benchmark::median;

}  // namespace

int main(int argc, char** argv) {
  const Index level = argc > 1 ? static_cast<Index>(std::atoi(argv[1])) : 8;
  const Mesh mesh = shapes::folded_sphere(level).mesh();
  DistanceSolver solver(mesh);
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  const Source source{vertex_point(mesh, 0)};
  solver.distance(std::span(&source, 1), options);  // warm
  double start = benchmark::cpu_seconds();
  const DistanceField field = solver.distance(std::span(&source, 1), options);
  const double field_s = benchmark::cpu_seconds() - start;
  const double far = *std::max_element(field.distance.begin(), field.distance.end());

  std::vector<double> path_s, points;
  for (Index v = 1; v < mesh.vertex_count(); v += mesh.vertex_count() / 200) {
    start = benchmark::cpu_seconds();
    const SurfacePath path = path_to(*field.windows, vertex_point(mesh, v));
    path_s.push_back(benchmark::cpu_seconds() - start);
    points.push_back(static_cast<double>(path.points.size()));
  }
  std::printf("%u vertices, exact field %.3f s\n", mesh.vertex_count(), field_s);
  std::printf("path off the field: median %.3f ms, largest %.3f ms, median %.0f points\n", 1e3 * median(path_s),
              1e3 * *std::max_element(path_s.begin(), path_s.end()), median(points));

  // Pairs at about a twentieth of the largest distance.
  PathFinder finder(mesh);
  finder.between(vertex_point(mesh, 0), vertex_point(mesh, 1));  // warm
  std::vector<double> pair_s;
  for (Index v = 1; v < mesh.vertex_count() && pair_s.size() < 50; v += 37) {
    if (std::abs(field.distance[v] - 0.05 * far) > 0.002 * far) continue;
    start = benchmark::cpu_seconds();
    finder.between(vertex_point(mesh, 0), vertex_point(mesh, v));
    pair_s.push_back(benchmark::cpu_seconds() - start);
  }
  if (!pair_s.empty()) {
    std::printf("pair at 5 %% of the largest distance: median %.3f ms, %.0f times cheaper than the field\n",
                1e3 * median(pair_s), field_s / median(pair_s));
  }

  // Discs of about 3200 vertices, and what the exact distances in them take alone.
  std::vector<double> sorted = field.distance;
  std::sort(sorted.begin(), sorted.end());
  const double radius = sorted[std::min<std::size_t>(sorted.size() - 1, 3200)];
  DistanceOptions disc;
  disc.method = Method::Exact;
  disc.max_distance = radius;
  std::vector<double> map_s, distance_s, reached;
  SparseField near;
  for (Index v = 0; v < mesh.vertex_count(); v += mesh.vertex_count() / 200) {
    const Source centre{vertex_point(mesh, v)};
    start = benchmark::cpu_seconds();
    const SparseLogMap map = log_map(solver, centre.point, radius);
    map_s.push_back(benchmark::cpu_seconds() - start);
    start = benchmark::cpu_seconds();
    solver.distance_sparse(std::span(&centre, 1), disc, near);
    distance_s.push_back(benchmark::cpu_seconds() - start);
    reached.push_back(static_cast<double>(map.vertex.size()));
  }
  std::printf("log map of a disc: median %.3f ms, %.2f times its distances, median %.0f vertices\n",
              1e3 * median(map_s), median(map_s) / median(distance_s), median(reached));
  return 0;
}
