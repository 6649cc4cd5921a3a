// The parts of a mesh: that cutting it changes nothing but rounding, and threads nothing at all.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/partition/scheduler.h>
#include <brushfire/solvers/windows/engine.h>
#include <brushfire/solvers/windows/propagation/structure.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>

#include "support/engine_run.h"
#include "support/same_field.h"

namespace brushfire::windows {
namespace {

using test::expect_equal_bits;

constexpr unsigned kOnePart = 31;

struct Case {
  std::string name;
  Mesh mesh;
};

// Curved ones, a boundary, edges of many faces, several components, faces without area and thin ones.
std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"folded sphere", shapes::folded_sphere(4).mesh()});
  all.push_back({"terrain", shapes::noise_terrain(24, 24).mesh()});
  all.push_back({"book", shapes::book(5, 9, 7).mesh()});
  all.push_back({"bow tie", shapes::bow_tie(7, 12).mesh()});
  all.push_back({"thin plane", shapes::plane(30, 20, 1, 1e-4).mesh()});
  Shape two = shapes::torus(20, 10);
  const Shape cube = shapes::cube(4);
  const auto first = static_cast<Index>(two.positions.size());
  two.positions.insert(two.positions.end(), cube.positions.begin(), cube.positions.end());
  two.positions.push_back({9, 9, 9});  // of no face
  for (const Face& f : cube.faces) two.faces.push_back({first + f[0], first + f[1], first + f[2]});
  two.faces.push_back({0, 1, 1});
  all.push_back({"torus and cube", two.mesh()});
  return all;
}

std::vector<std::vector<Source>> source_lists(const Mesh& mesh) {
  const Index f = mesh.face_count() / 3, g = mesh.face_count() / 2;
  return {{{vertex_point(mesh, 0)}},
          {{{f, {0.2, 0.3, 0.5}}}},
          {{{g, {0, 0.5, 0.5}}}},
          {{vertex_point(mesh, mesh.vertex_count() / 2)}, {{f, {0.2, 0.3, 0.5}}, 0.05}, {{g, {0.5, 0, 0.5}}, -0.02}}};
}

std::vector<DistanceOptions> ways() {
  DistanceOptions exact, coarse, fine, upper;
  exact.method = Method::Exact;
  coarse.tolerance = 1e-2;
  fine.tolerance = 1e-4;
  upper.bound = Bound::Upper;
  return {exact, coarse, fine, upper};
}

// Both within their bounds of the distance.
void expect_same_distances(const DistanceField& a, const DistanceField& b, const std::string& where) {
  ASSERT_EQ(a.distance.size(), b.distance.size());
  for (std::size_t v = 0; v < a.distance.size(); ++v) {
    ASSERT_EQ(std::isfinite(a.distance[v]), std::isfinite(b.distance[v])) << where << ", vertex " << v;
    if (!std::isfinite(a.distance[v])) continue;
    const double bound = a.error_bound[v] + b.error_bound[v] + 1e-15;
    EXPECT_LE(std::abs(a.distance[v] - b.distance[v]), bound) << where << ", vertex " << v;
  }
}

TEST(Parts, EveryFaceIsInOnePartWithVerticesOfItsOwnAndGhostsFormRings) {
  for (const Case& c : cases()) {
    for (const unsigned bits : {0u, 3u, 6u, kOnePart}) {
      const WindowStructure whole(c.mesh, kOnePart), cut(c.mesh, bits);
      EXPECT_EQ(whole.vertex_count(), c.mesh.vertex_count());
      std::set<Index> outer;
      for (Index v = 0; v < cut.vertex_count(); ++v) outer.insert(cut.outer_vertex(v));
      EXPECT_EQ(outer.size(), c.mesh.vertex_count()) << c.name;
      for (Index f = 0; f < c.mesh.face_count(); ++f) {
        const Index inner = cut.inner_face(f);
        ASSERT_EQ(cut.outer_face(inner), f) << c.name << ", bits " << bits;
        for (std::size_t k = 0; k < 3; ++k) {
          const Index v = cut.faces[inner].vertex[k];
          EXPECT_EQ(cut.outer_vertex(v), c.mesh.faces()[f][k]);
          EXPECT_TRUE(cut.partition.is_in(cut.part_of_face(inner), v));
          EXPECT_EQ(cut.part_of_vertex(v), cut.part_of_face(inner));
          EXPECT_EQ(cut.ghost_in(cut.part_of_face(inner), cut.inner_vertex(c.mesh.faces()[f][k])), v);
        }
      }
      for (Index v = 0; v < cut.vertex_count(); ++v) {
        std::set<Index> ring{v};
        for (Index w = cut.partition.next_ghost(v); w != kNoIndex && w != v; w = cut.partition.next_ghost(w))
          ring.insert(w);
        for (const Index w : ring) EXPECT_TRUE(cut.is_same(v, w));
        EXPECT_EQ(*ring.begin(), cut.inner_vertex(cut.outer_vertex(v))) << "in the first part";
      }
    }
  }
}

TEST(Parts, HoweverAMeshIsCutDistancesStayWithinTheirBounds) {
  for (const Case& c : cases()) {
    const auto whole = make_windows(c.mesh, kOnePart, Merging::Always);
    for (const unsigned bits : {2u, 5u, 8u}) {
      const auto cut = make_windows(c.mesh, bits, Merging::Always);
      for (const DistanceOptions& options : ways()) {
        for (const std::vector<Source>& sources : source_lists(c.mesh)) {
          const std::string where = c.name + ", bits " + std::to_string(bits) + ", " +
                                    std::string(name_of(options.method)) + ", " + std::to_string(sources.size());
          const DistanceField a = test::run(*whole, c.mesh, sources, options);
          const DistanceField b = test::run(*cut, c.mesh, sources, options);
          expect_same_distances(a, b, where);
          if (options.method == Method::Windows) {
            EXPECT_LE(b.max_error_bound, options.tolerance) << where;
          }
        }
      }
    }
  }
}

TEST(Parts, AnyNumberOfThreadsGivesTheSameBits) {
  for (const Case& c : cases()) {
    const auto engine = make_windows(c.mesh, 4, Merging::Always);
    for (DistanceOptions options : ways()) {
      for (const std::vector<Source>& sources : source_lists(c.mesh)) {
        for (const double radius : {kInfinity, 0.3}) {
          options.max_distance = radius;
          options.threads = 1;
          const DistanceField one = test::run(*engine, c.mesh, sources, options);
          for (const unsigned threads : {2u, 3u, 8u, 32u, 0u}) {
            options.threads = threads;
            expect_equal_bits(test::run(*engine, c.mesh, sources, options), one,
                              c.name + ", " + std::to_string(threads) + " threads");
          }
        }
      }
    }
  }
}

TEST(Parts, TargetsOnEdgesBetweenPartsAndEverywhereReadTheSame) {
  for (const Case& c : cases()) {
    const auto whole = make_windows(c.mesh, kOnePart, Merging::Always), cut = make_windows(c.mesh, 2, Merging::Always);
    for (DistanceOptions options : ways()) {
      for (Index f = 0; f < c.mesh.face_count(); f += 37) {
        for (const std::array<double, 3>& w :
             {std::array{0.2, 0.3, 0.5}, std::array{0.5, 0.5, 0.0}, std::array{0.0, 1.0, 0.0}}) {
          options.targets.push_back({f, w});
        }
      }
      for (const std::vector<Source>& sources : source_lists(c.mesh)) {
        options.threads = 1;
        const DistanceField a = test::run(*whole, c.mesh, sources, options);
        const DistanceField b = test::run(*cut, c.mesh, sources, options);
        const double share = 2 * (options.method == Method::Exact ? 1e-12 : options.tolerance) + 1e-14;
        for (std::size_t i = 0; i < options.targets.size(); ++i) {
          if (a.target_distance[i] == kInfinity && b.target_distance[i] == kInfinity) continue;
          EXPECT_NEAR(a.target_distance[i], b.target_distance[i], share * (std::abs(a.target_distance[i]) + 0.1))
              << c.name << ", target " << i;
        }
        options.threads = 4;
        expect_equal_bits(test::run(*cut, c.mesh, sources, options), b, c.name);
      }
    }
  }
}

TEST(Parts, AListOfWhatWasTouchedHoldsEveryVertexOnce) {
  for (const Case& c : cases()) {
    const auto cut = make_windows(c.mesh, 3, Merging::Always);
    DistanceOptions options;
    options.max_distance = 0.4;
    std::vector<Index> touched;
    const DistanceField field = test::run(*cut, c.mesh, source_lists(c.mesh)[1], options, &touched);
    EXPECT_EQ(std::set<Index>(touched.begin(), touched.end()).size(), touched.size()) << c.name;
    for (Index v = 0; v < c.mesh.vertex_count(); ++v) {
      if (field.distance[v] < kInfinity) {
        EXPECT_NE(std::find(touched.begin(), touched.end(), v), touched.end()) << c.name << ", vertex " << v;
      }
    }
  }
}

// Rays lead over the borders of parts, and every window that was kept has the mesh's own numbers.
TEST(Parts, PathsLeadFromPartToPart) {
  for (const Case& c : cases()) {
    const auto whole = make_windows(c.mesh, kOnePart, Merging::Always), cut = make_windows(c.mesh, 3, Merging::Always);
    for (const bool all_points : {false, true}) {
      DistanceOptions options;
      options.method = Method::Exact;
      options.keep_paths = true;
      options.keep_windows = all_points;
      for (const std::vector<Source>& sources : source_lists(c.mesh)) {
        options.threads = 1;
        const DistanceField a = test::run(*whole, c.mesh, sources, options);
        options.threads = 4;
        const DistanceField b = test::run(*cut, c.mesh, sources, options);
        for (Index v = 0; v < c.mesh.vertex_count(); v += 5) {
          if (!std::isfinite(a.distance[v])) continue;
          const SurfacePath path = path_to(*b.windows, vertex_point(c.mesh, v));
          EXPECT_NEAR(path.length / c.mesh.unit(), a.distance[v] - sources[a.source[v]].offset / c.mesh.unit(),
                      1e-11 * (1 + std::abs(a.distance[v])))
              << c.name << ", vertex " << v;
        }
      }
    }
  }
}

TEST(Parts, ARunThatIsStoppedLeavesNothingBehind) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  const std::vector<Source> sources = source_lists(mesh)[3];
  const auto engine = make_windows(mesh, 4, Merging::Always);
  for (DistanceOptions options : ways()) {
    for (const unsigned threads : {1u, 3u}) {
      options.threads = threads;
      options.cancel = nullptr;
      const DistanceField before = test::run(*engine, mesh, sources, options);
      CancelToken token;
      token.cancel();
      options.cancel = &token;
      EXPECT_THROW(test::run(*engine, mesh, sources, options), Error);
      options.cancel = nullptr;
      expect_equal_bits(test::run(*engine, mesh, sources, options), before, std::to_string(threads) + " threads");
    }
  }
}

TEST(Scheduler, EveryPartIsTakenOnceAndLoadsAreNearlyEven) {
  partition::Scheduler scheduler(std::chrono::microseconds(20));
  scheduler.reset(12, 3);
  std::vector<partition::Due> due;
  for (Index p = 0; p < 12; ++p) due.push_back({p, 5 + p % 4});
  for (int round = 0; round < 3; ++round) {
    scheduler.deal(due);
    std::vector<int> taken(12, 0);
    std::size_t first = 0;
    scheduler.take(0, [&](Index p) {
      ++taken[p];
      first += 5 + p % 4;
    });
    EXPECT_EQ(taken, std::vector<int>(12, 1)) << "who comes first helps the others out";
    scheduler.take(1, [&](Index p) { ++taken[p]; });
    EXPECT_EQ(taken, std::vector<int>(12, 1));
  }
}

}  // namespace
}  // namespace brushfire::windows
