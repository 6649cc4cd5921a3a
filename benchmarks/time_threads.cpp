// One field by one thread and by several, in turns: seconds by the wall clock, and whether all bits are the same.
//
//   time_threads VERTICES FACES ROUNDS THREADS METHOD...
//
// VERTICES holds float64 x y z, FACES int32 triples (raw, little endian), as make_arrays writes them. METHOD is as for
// time_solver. What several threads gain hangs on how far apart the processors are that they run on; on virtual
// machines that changes from minute to minute. So the time in which a cache line passes from one thread to the other is
// printed before and after each method: some 30 ns within a processor, 150 and more between two.
#include <brushfire/core/error.h>
#include <brushfire/solvers/distance.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "measure.h"

namespace brushfire::benchmark {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Nanoseconds in which a line passes from one thread to another: a number is counted up by both in turns.
double passing_ns() {
  constexpr int kPasses = 20000;
  std::atomic<int> turn{0};
  const auto count_up = [&](int first) {
    for (int i = first; i < kPasses; i += 2) {
      while (turn.load(std::memory_order_acquire) != i) {
      }
      turn.store(i + 1, std::memory_order_release);
    }
  };
  const double begin = wall_seconds();
  std::thread other(count_up, 1);
  count_up(0);
  other.join();
  return 1e9 * (wall_seconds() - begin) / kPasses;
}

void measure(DistanceSolver& solver, const std::string& name, int rounds, unsigned threads) {
  const double near_before = passing_ns();
  DistanceOptions options = options_named(name);
  solver.set_up(options);
  const Source source{vertex_point(solver.mesh(), 0)};
  std::vector<double> alone, together;
  DistanceField first, field;
  solver.distance({&source, 1}, options, first);
  for (int r = 0; r < rounds; ++r) {
    for (const bool several : {false, true}) {
      options.threads = several ? threads : 1;
      const double begin = wall_seconds();
      solver.distance({&source, 1}, options, field);
      (several ? together : alone).push_back(wall_seconds() - begin);
      const bool same = field.distance == first.distance && field.source == first.source &&
                        field.error_bound == first.error_bound && field.updates == first.updates;
      if (!same) throw Error(ErrorCode::Internal, name + ": the field depends on the number of threads");
    }
  }
  const double ns = 1e9 / solver.mesh().vertex_count();
  std::printf(
      "%-22s one thread %6.0f ns/vertex, %u threads %6.0f: %.2f times as fast (a line passes in %.0f, %.0f ns)\n",
      name.c_str(), ns * median(alone), threads, ns * median(together), median(alone) / median(together), near_before,
      passing_ns());
}

int run(int count, char** arguments) {
  if (count < 6) {
    std::fprintf(stderr, "usage: time_threads VERTICES FACES ROUNDS THREADS METHOD...\n");
    return 2;
  }
  DistanceSolver solver{Mesh(read_positions(arguments[1]), read_faces(arguments[2]))};
  for (int i = 5; i < count; ++i) {
    measure(solver, arguments[i], std::stoi(arguments[3]), static_cast<unsigned>(std::stoul(arguments[4])));
  }
  return 0;
}

}  // namespace
}  // namespace brushfire::benchmark

int main(int count, char** arguments) {
  return brushfire::benchmark::guarded("time_threads", brushfire::benchmark::run, count, arguments);
}
