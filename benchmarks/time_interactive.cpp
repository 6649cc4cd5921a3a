// What a program waits for whose user drags a source over a mesh: one solver, used again and again.
//
//   time_interactive VERTICES FACES THREADS DISC METHOD...
//
// VERTICES holds float64 x y z, FACES int32 triples (raw, little endian), as make_arrays writes them. METHOD is as for
// time_solver. The source moves to 41 places inside faces, spread over the mesh; each time the whole field is updated,
// on one thread and on THREADS (0: not at all); and then a disc is read that holds some DISC vertices. Medians:
// processor time in milliseconds, and by the wall clock where several threads are compared with one. Allocations are
// those of the second round of places.
#include <brushfire/core/error.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/distance.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "io/counting_allocator.h"
#include "measure.h"

namespace brushfire::benchmark {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<Source> places(const Mesh& mesh) {
  constexpr Index kPlaces = 41;
  std::vector<Source> all;
  for (Index i = 0; i < kPlaces; ++i) {
    const auto face = static_cast<Index>(std::uint64_t{i} * mesh.face_count() / kPlaces);
    all.push_back({{face, {0.2, 0.3, 0.5}}});
  }
  return all;
}

// So large that a disc in the plane with as many vertices for its area holds `vertices` of them.
double radius_of(const Mesh& mesh, double vertices) {
  const std::span<const double> areas = mesh.double_areas();
  const double area = 0.5 * std::accumulate(areas.begin(), areas.end(), 0.0);
  return mesh.unit() * std::sqrt(vertices * area / mesh.vertex_count() / kPi);
}

struct Median {
  double cpu_ms, wall_ms;
};
template <class Run>
Median median_of(std::span<const Source> sources, const Run& run) {
  std::vector<double> cpu, wall;
  for (const Source& s : sources) {
    const double began = wall_seconds(), began_cpu = cpu_seconds();
    run(s);
    cpu.push_back(1e3 * (cpu_seconds() - began_cpu)), wall.push_back(1e3 * (wall_seconds() - began));
  }
  return {median(cpu), median(wall)};
}

template <class Run>
std::size_t allocations_of(std::span<const Source> sources, const Run& run) {
  const std::size_t before = test::allocation_count();
  for (const Source& s : sources) run(s);
  return test::allocation_count() - before;
}

void measure_fields(DistanceSolver& solver, const std::string& name, unsigned threads) {
  DistanceOptions options = options_named(name);
  DistanceField field;
  const auto update = [&](const Source& s) { solver.distance({&s, 1}, options, field); };
  const std::vector<Source> all = places(solver.mesh());
  allocations_of(all, update);
  const std::size_t allocations = allocations_of(all, update);
  const Median alone = median_of(all, update);
  options.threads = threads;
  allocations_of(all, update);
  const Median together = median_of(all, update);
  std::printf("%-22s field %8.2f ms (%zu allocations); by the clock %.2f, on %u threads %.2f: x %.2f\n", name.c_str(),
              alone.cpu_ms, allocations, alone.wall_ms, threads, together.wall_ms, alone.wall_ms / together.wall_ms);
}

void measure_discs(DistanceSolver& solver, const std::string& name, double vertices) {
  DistanceOptions options = options_named(name);
  options.max_distance = radius_of(solver.mesh(), vertices);
  SparseField field;
  std::vector<double> reached;
  const auto read = [&](const Source& s) { solver.distance_sparse({&s, 1}, options, field); };
  const std::vector<Source> all = places(solver.mesh());
  for (const Source& s : all) read(s), reached.push_back(static_cast<double>(field.vertex.size()));
  const std::size_t allocations = allocations_of(all, read);
  const Median disc = median_of(all, read);
  options.max_distance = 0;
  const Median nothing = median_of(all, read);
  std::printf("%-22s disc %9.3f ms (%zu allocations), %.0f vertices; of radius 0 %.3f ms\n", name.c_str(), disc.cpu_ms,
              allocations, median(reached), nothing.cpu_ms);
}

int run(int count, char** arguments) {
  if (count < 6) {
    std::fprintf(stderr, "usage: time_interactive VERTICES FACES THREADS DISC METHOD...\n");
    return 2;
  }
  DistanceSolver solver{Mesh(read_positions(arguments[1]), read_faces(arguments[2]))};
  for (int i = 5; i < count; ++i) {
    const std::string method = arguments[i];
    const double began = cpu_seconds();
    solver.set_up(options_named(method));
    std::printf("%-22s set-up %7.1f ms\n", method.c_str(), 1e3 * (cpu_seconds() - began));
    const auto threads = static_cast<unsigned>(std::stoul(arguments[3]));
    if (threads > 0) measure_fields(solver, method, threads);
    measure_discs(solver, method, std::stod(arguments[4]));
  }
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("time_interactive", brushfire::benchmark::run, count, arguments);
}
