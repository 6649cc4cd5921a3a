// Threads on one field of windows, over many small parts. Built by the preset `thread`, ThreadSanitizer watches.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/windows/engine.h>

#include <gtest/gtest.h>

#include "support/engine_run.h"

namespace brushfire {
namespace {

TEST(WindowThreads, OfOneRunWriteNothingThatOthersReadAndGiveTheSameBits) {
  constexpr unsigned kSmallParts = 5;
  for (const Mesh& mesh : {shapes::folded_sphere(3).mesh(), shapes::book(5, 9, 7).mesh()}) {
    const auto engine = windows::make_windows(mesh, kSmallParts, windows::Merging::Always);
    const std::vector<Source> one{{vertex_point(mesh, 0)}};
    const std::vector<Source> several{{vertex_point(mesh, 1)}, {{mesh.face_count() / 2, {0.5, 0.5, 0}}, 0.1}};
    for (const Method method : {Method::Exact, Method::Windows}) {
      DistanceOptions options;
      options.method = method;
      options.keep_paths = true;
      options.targets = {{3, {0.2, 0.3, 0.5}}, {mesh.face_count() - 1, {0.5, 0, 0.5}}};
      for (const std::vector<Source>& sources : {one, several}) {
        options.threads = 1;
        const DistanceField alone = test::run(*engine, mesh, sources, options);
        for (const unsigned threads : {2u, 4u}) {
          options.threads = threads;
          const DistanceField together = test::run(*engine, mesh, sources, options);
          EXPECT_EQ(together.distance, alone.distance);
          EXPECT_EQ(together.source, alone.source);
          EXPECT_EQ(together.target_distance, alone.target_distance);
        }
      }
    }
  }
}

}  // namespace
}  // namespace brushfire
