// A process that forks takes copies of its solvers with it, but not their threads.
#include "support/forked.h"

#include <brushfire/core/parallel.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/fast_marching/detail/fast_marching.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "support/engine_run.h"

namespace brushfire {
namespace {

#if BRUSHFIRE_CAN_FORK

#if defined(__SANITIZE_THREAD__)
constexpr bool kChildMayHaveThreads = false;  // ThreadSanitizer ends a child that starts some
#else
constexpr bool kChildMayHaveThreads = true;
#endif

// Long enough for spinning threads to have gone to sleep: a fork finds them there, or in the middle of their search.
void let_threads_fall_asleep() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

TEST(Fork, LeavesAChildATeamOfOneThatWorksAndCanBeDissolved) {
  for (const auto idle : {ThreadTeam::Idle::Sleeps, ThreadTeam::Idle::Spins}) {
    for (const bool asleep : {false, true}) {
      auto team = std::make_unique<ThreadTeam>(3, idle);
      std::vector<int> calls(100, 0);
      const auto count = [&](unsigned, std::size_t i) { ++calls[i]; };
      team->run(calls.size(), count);
      if (asleep) let_threads_fall_asleep();
      EXPECT_EQ(test::in_forked_child([&] {
                  const bool alone = team->size() == 1;
                  team->run(calls.size(), count);
                  team.reset();
                  return alone && calls == std::vector<int>(100, 2);
                }),
                "yes");
      team->run(calls.size(), count);  // the parent's is as it was
      EXPECT_EQ(calls, std::vector<int>(100, 2));
    }
  }
}

TEST(Fork, LeavesAChildSolversThatSolve) {
  if (!kChildMayHaveThreads) GTEST_SKIP() << "a solver starts new threads in a child";
  const Mesh mesh = shapes::torus(60, 40).mesh();
  const std::vector<Source> sources{{vertex_point(mesh, 7)}};
  for (const Method method : {Method::Exact, Method::Windows, Method::NovotniKlein}) {
    const bool marches = method == Method::NovotniKlein;
    auto engine = marches ? fast_marching::make_engine(mesh, 32) : windows::make_windows(mesh, 5);
    DistanceOptions options;
    options.method = method;
    options.threads = 2;
    const std::vector<double> field = test::run(*engine, mesh, sources, options).distance;
    for (const unsigned threads : {1u, 2u, 3u}) {
      EXPECT_EQ(test::in_forked_child([&] {
                  options.threads = threads;
                  const bool same = test::run(*engine, mesh, sources, options).distance == field;
                  engine.reset();
                  return same;
                }),
                "yes")
          << threads << " threads";
    }
    EXPECT_EQ(test::run(*engine, mesh, sources, options).distance, field);
  }
}

#endif

}  // namespace
}  // namespace brushfire
