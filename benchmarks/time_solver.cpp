// Times one method on one mesh, from the arrays to the field: one round, and one line of JSON, per line of input.
//
//   time_solver VERTICES FACES SOURCE METHOD [DISTANCES]
//
// VERTICES holds float64 x y z, FACES int32 triples (raw, little endian). METHOD may be followed by :float32, :float64
// or a tolerance (windows:1e-3). A round builds the mesh from the arrays and everything that the method derives from
// it, solves, and solves again. In seconds of processor time:
//   set_up_s  what is built before the first solve;   first_s  arrays to first field;   solve_s  the second solve
// (into a field that is there already; the first one where that took more than five seconds). memory_mib is the peak
// above the arrays when the first round has its first field, which is written to DISTANCES (raw float64). Rounds begin
// when a line comes, so that a driver can interleave programs.
#include <brushfire/core/error.h>
#include <brushfire/solvers/distance.h>

#include <cstdio>
#include <iostream>
#include <string>

#include "measure.h"

namespace brushfire::benchmark {
namespace {

// One round: what the header of this file says.
struct Round {
  std::string times;
  double memory_mib;
};
Round round(std::span<const Vec3> positions, std::span<const Face> faces, Index vertex, const DistanceOptions& options,
            DistanceField& field) {
  constexpr double kSlow = 5;
  const double begin = cpu_seconds();
  DistanceSolver solver{Mesh(positions, faces)};
  const Source source{vertex_point(solver.mesh(), vertex)};
  DistanceOptions nowhere = options;
  nowhere.max_distance = 0;  // builds everything, reaches the source
  solver.distance({&source, 1}, nowhere);
  const double built = cpu_seconds();
  field = solver.distance({&source, 1}, options);
  const double first = cpu_seconds();
  const double memory = peak_memory_mib();
  double solve_s = first - built;
  if (solve_s < kSlow) {
    DistanceField again = field;
    const double ready = cpu_seconds();
    solver.distance({&source, 1}, options, again);
    solve_s = cpu_seconds() - ready;
    if (again.distance != field.distance) throw Error(ErrorCode::InvalidArgument, "two solves gave different fields");
  }
  char line[200];
  std::snprintf(line, sizeof line, "\"first_s\": %.9f, \"set_up_s\": %.9f, \"solve_s\": %.9f, \"updates\": %.0f",
                first - begin, built - begin, solve_s, static_cast<double>(field.updates));
  return {line, memory};
}

int run(int count, char** arguments) {
  if (count < 5) {
    std::fprintf(stderr, "usage: time_solver VERTICES FACES SOURCE METHOD [DISTANCES]\n");
    return 2;
  }
  const std::vector<Vec3> positions = read_positions(arguments[1]);
  const std::vector<Face> faces = read_faces(arguments[2]);
  const auto vertex = static_cast<Index>(std::stoul(arguments[3]));
  const DistanceOptions options = options_named(arguments[4]);
  const double arrays_mib = memory_mib();
  double memory = -1;
  for (std::string request; std::getline(std::cin, request);) {
    DistanceField field;
    const Round r = round(positions, faces, vertex, options, field);
    if (memory < 0) {
      memory = r.memory_mib - arrays_mib;
      if (count > 5) write_doubles(arguments[5], field.distance);
    }
    std::printf("{%s, \"memory_mib\": %.2f}\n", r.times.c_str(), memory);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("time_solver", brushfire::benchmark::run, count, arguments);
}
