// Shortest paths between random points of meshes, judged by coordinates and against the distance field.
//
//   check_paths PAIRS MESH ...     one row per mesh; exit code 1 where a path is judged bad
#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/queries/path.h>

#include "support/path_checker.h"
#include "support/random_points.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>

namespace {

using namespace brushfire;

struct Row {
  int reached = 0, bad = 0;
  double off_field = 0, off_reverse = 0;  // largest relative difference
  std::string first_complaint;
};

void check_pair(const Mesh& mesh, PathFinder& finder, DistanceSolver& solver, std::mt19937& random, Row& row) {
  const SurfacePoint from = test::any_point(mesh, random), to = test::any_point(mesh, random);
  DistanceOptions options;
  options.method = Method::Exact;
  options.targets = {to};
  const Source source{from};
  const double d = solver.distance(std::span(&source, 1), options).target_distance[0];
  const SurfacePath path = finder.between(from, to);
  std::string complaint = test::judge(mesh, path);
  if (complaint.empty() && (d == kInfinity) != path.points.empty()) complaint = "reached by one, not by the other";
  if (!complaint.empty() && row.bad++ == 0) row.first_complaint = complaint;
  if (d == kInfinity || !(d > 0)) return;
  ++row.reached;
  row.off_field = std::max(row.off_field, std::abs(path.length - d) / d);
  row.off_reverse = std::max(row.off_reverse, std::abs(finder.between(to, from).length - d) / d);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: check_paths PAIRS MESH ...\n");
    return 2;
  }
  const int pairs = std::atoi(argv[1]);
  int bad = 0;
  std::printf("%-24s %8s %8s %8s %14s %14s\n", "mesh", "vertices", "reached", "bad", "|path-field|", "|reverse|");
  for (int i = 2; i < argc; ++i) {
    const Mesh mesh = read_mesh(argv[i]).mesh;
    PathFinder finder(mesh);
    DistanceSolver solver(mesh);
    std::mt19937 random(1);
    Row row;
    for (int k = 0; k < pairs; ++k) check_pair(mesh, finder, solver, random, row);
    std::printf("%-24s %8u %8d %8d %14.1e %14.1e %s\n", std::filesystem::path(argv[i]).stem().c_str(),
                mesh.vertex_count(), row.reached, row.bad, row.off_field, row.off_reverse, row.first_complaint.c_str());
    std::fflush(stdout);
    bad += row.bad;
  }
  return bad == 0 ? 0 : 1;
}
