// Cases of the corpus that were wrong once.
#include "corpus/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace brushfire::corpus {
namespace {

struct Once {
  const char* family;
  std::uint64_t seed, index;
  const char* method;
  const char* what;
};

constexpr Once kWrongOnce[] = {
    {"soup", 2, 2, "paths", "source and target in one face with a repeated vertex"},
    {"far-point", 2, 47, "paths", "a search for a leg that wound round a spike"},
    {"collinear", 2, 44, "targets", "an oracle whose light turned back in a face without area"},
    {"soup", 20261130, 167, "targets", "a source and a target in one face, next to its corner"},
    {"components", 20261129, 86, "paths", "legs that explain a value to a share of other sources' offsets"},
    {"mutilated", 2, 76, "exact", "no bound where every face has an edge without length"},
    {"tiny-clusters", 2, 14, "dijkstra", "distances to corners from three lengths"},
    {"far-point", 20261202, 38, "exact", "a vertex that only light along edges leads to was left out"},
    {"lattice", 20261201, 329, "paths", "the vertex before a source in a face without size was left out"},
    {"zoo", 20261202, 443, "paths", "offsets far beyond a mesh without size that were taken for ties"},
    {"lattice", 20261201, 15, "exact", "a chord that a rounded window undercut, with the bound of the chord"},
    {"curves-needles", 7, 45, "exact", "a curve's end whose light lost a tie with parallel light that begins there"},
    {"curves-components", 7, 45, "windows", "a vertex beside a curve, to rounding on it, with a bound of 0"},
    {"curves-zoo", 7, 11, "paths", "a curve with several values at a vertex, from which a path began with any"},
    {"curves-far-point", 7, 31, "paths", "a place near the end of a segment 1e16 long, by a share of one double"},
    {"curves-fans", 7, 25, "paths", "a search that trusted shares of a spoke 1e14 times as long as the leg"},
    {"curves-repeated", 8, 56, "radius", "light along a face without area that was left at its far corner"},
    {"curves-tiny-clusters", 8, 63, "paths", "a leg that explained a value to a share of the offsets along a curve"},
    {"curves-zoo", 9, 99, "exact",
     "wider numbers in a face with an edge without length, where it is entered from beyond"},
    {"curves-bipyramids", 9, 74, "targets", "a run that ended by a path shorter by rounding than its target's light"},
    {"curves-mutilated", 9, 4, "targets", "the same, on lengths of 1e11"},
    {"far-point", 20261130, 967, "paths",
     "vertices that rounding of an edge 1e16 long put at no distance from a vertex"},
    {"far-point", 20261201, 117, "paths", "the same"},
    {"zoo", 20261201, 88, "paths", "the same, at lengths of 1e5 and a value of 1e-12"},
    {"curves-far-point", 10, 9, "paths", "the same, before a curve"},
    {"curves-integer-grid", 12, 48, "exact", "a curve's end beside a vertex, whose light went round it for ever"},
    {"curves-far-point", 14, 55, "exact", "a curve from an edge, whose grazing light began behind it"},
    {"curves-bipyramids", 14, 59, "upper",
     "a curve whose end is beside a tip, round which its light went thousands of times"},
    {"mutilated", 20261130, 641, "paths", "vertices at one place, by feet on edges that round"},
    {"zoo", 20261208, 134, "paths", "a vertex at the place of one that lies on an edge to rounding"},
    {"mutilated", 20261208, 287, "exact", "light along the line of faces without area: the oracle's"},
    {"extremes", 20261208, 104, "paths", "sums of subnormal lengths: the judge's"},
    {"mutilated", 20261207, 53, "paths",
     "offsets beside which the mesh has no size: ways along edges between its vertices, not the shortest ones"},
    {"curves-doubled", 9, 13, "paths", "a point at no distance from its curve, in another face: the judge's"},
    {"curves-lattice", 10, 33, "paths", "a value beside a source that is less than nothing by rounding"},
    {"curves-collinear", 7, 41, "exact", "parallel light of less than nothing at a place of the curve"},
};

// curves-NAME: curves on the complexes of NAME.
Family family_called(const std::string& name) {
  const std::string curves = "curves-";
  const bool has_curves = name.rfind(curves, 0) == 0;
  for (const Family& f : small_families()) {
    if (f.name == (has_curves ? name.substr(curves.size()) : name)) return has_curves ? with_curves(f) : f;
  }
  return {};
}

TEST(Corpus, WhatWasWrongOnceIsRight) {
  for (const Once& once : kWrongOnce) {
    const Family family = family_called(once.family);
    ASSERT_FALSE(family.name.empty()) << once.family;
    Examination examination(family, once.seed);
    const std::vector<Task> tasks = tasks_of({once.method}, {0.01});
    for (const std::size_t start : {0u, 1u}) {
      const Outcome outcome = examination.run(once.index, start, tasks.back());
      limit_processor_time(0);
      EXPECT_TRUE(outcome.good()) << once.family << ", " << once.what << ": " << outcome.text;
    }
  }
}

// Its bound was as large as its value: docs/decisions/wide-numbers.md.
TEST(Corpus, AVertexBeyondOneThatTheSourceIsVeryNearToIsShown) {
  const auto families = small_families();
  const auto far =
      std::find_if(families.begin(), families.end(), [](const Family& f) { return f.name == "far-point"; });
  ASSERT_NE(far, families.end());
  const Case c = make_case(*far, 20261202, 38);
  DistanceOptions options;
  options.method = Method::Exact;
  const DistanceField field = distance(c.mesh, c.starts[1], options);
  EXPECT_NEAR(field.distance[11], 1.7695483778716121, 1e-15);
  EXPECT_LT(field.error_bound[11], 1e-12);
}

}  // namespace
}  // namespace brushfire::corpus
