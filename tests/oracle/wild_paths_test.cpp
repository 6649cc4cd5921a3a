// Paths where numbers and sheets are of every kind: found, straight, on the mesh, and as long as the field says.
#include "oracle/wild_paths.h"
#include "oracle/polyhedral.h"
#include "oracle/wild.h"

#include <brushfire/core/error.h>
#include <brushfire/queries/path.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>
#include <string>
#include <thread>

namespace brushfire::oracle {
namespace {

// Fields themselves are right in these; where others miss the oracle no path can be as long as they say.
bool has_right_fields(Wild family) {
  return family == Wild::Grid || family == Wild::Doubled || family == Wild::Book || family == Wild::Soup;
}

// A field that takes longer is given up: not fields are tested here.
class TimeLimit {
 public:
  explicit TimeLimit(CancelToken& token)
      : watch_([this, &token] {
          std::unique_lock lock(mutex_);
          if (!done_.wait_for(lock, std::chrono::milliseconds(100), [this] { return is_done_; })) token.cancel();
        }) {}
  ~TimeLimit() {
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    done_.notify_one();
    watch_.join();
  }

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread watch_;
};

TEST(WildPaths, AreFoundAndStraightAndAsLongAsTheFieldSays) {
  for (const Wild family : kWild) {
    int judged = 0;
    for (std::uint32_t seed = 1; seed <= (has_right_fields(family) ? 60U : 16U); ++seed) {
      std::mt19937 random(seed);
      const Mesh mesh = wild_complex(family, random);
      for (int pair = 0; pair < 2; ++pair) {
        const SurfacePoint from = wild_point(mesh, random), to = wild_point(mesh, random);
        SCOPED_TRACE(std::string(name_of(family)) + ", seed " + std::to_string(seed) + ", pair " +
                     std::to_string(pair));
        CancelToken token;
        PathVerdict v;
        try {
          const TimeLimit limit(token);
          v = judge_path(mesh, from, to, false, nullptr, &token);
        } catch (const Error& e) {
          ASSERT_EQ(e.code(), ErrorCode::Cancelled) << e.what();
          continue;
        }
        ++judged;
        if (v.complaint.rfind("field", 0) == 0) {
          if (!has_right_fields(family)) continue;
          v = judge_path(mesh, from, to);
          if (!v.field_true) continue;
        }
        ASSERT_EQ(v.complaint, "");
      }
    }
    EXPECT_GE(judged, 8) << name_of(family);
  }
}

void expect_good_path(const Mesh& mesh, const SurfacePoint& from, const SurfacePoint& to) {
  const PathVerdict v = judge_path(mesh, from, to);
  EXPECT_EQ(v.complaint, "");
  EXPECT_TRUE(v.reached);
  EXPECT_LE(std::abs(v.length - v.truth), 1e-11 * v.truth);
}

TEST(WildPaths, FromBesideACornerOfAnIntegerGridAreFound) {
  const std::vector<Vec3> p{{2, 0, 0}, {3, 0, 1}, {1, 1, 0}, {2, 1, 1}, {3, 1, 0}, {4, 1, 0}, {4, 2, 0}};
  const Mesh mesh(p, std::vector<Face>{{0, 3, 2}, {0, 1, 4}, {0, 4, 3}, {1, 5, 4}, {4, 5, 6}});
  expect_good_path(mesh, {4, {2.5379513028672522e-08, 0.999999952811053, 2.1809433943526143e-08}},
                   vertex_point(mesh, 2));
}

TEST(WildPaths, AlongTwoNeedlesAreFound) {
  const std::vector<Vec3> p{{-2.1409557321810737e-09, 2.3522809593408014e-09, 3.055114909651717e-08},
                            {-0.5633970167273403, 0.5886110878788458, 10.50851723372571},
                            {3.1940619766502285e-10, 1.7171392649915808e-09, 4.638434113154111e-08},
                            {2.3674243566114977e-09, 3.6686615400425298e-09, 2.304012730281333e-08}};
  const Mesh mesh(p, std::vector<Face>{{0, 3, 1}, {0, 2, 3}});
  const Source source{SurfacePoint{1, {0.09091963010898796, 0.909080369891012, 0.0}}};
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  const SurfacePath path = path_to(*distance(mesh, std::span(&source, 1), options).windows, vertex_point(mesh, 1));
  const double truth = static_cast<double>(polyhedral_distance(mesh, std::span(&source, 1), kFar, {}).distance[1]);
  EXPECT_NEAR(path.length, truth, 1e-11 * truth);
}

TEST(WildPaths, FromBesideAVertexThatIsNoSaddleDoNotBendThere) {
  const std::vector<Vec3> p{{1, 1, 1}, {2, 1, 1}, {1, 2, 0}, {2, 2, 0}};
  const Mesh mesh(p, std::vector<Face>{{0, 1, 3}, {0, 3, 2}});
  expect_good_path(mesh, {0, {1.1642103075538804e-10, 3.4245224195749055e-10, 0.9999999995411267}},
                   vertex_point(mesh, 2));
}

TEST(WildPaths, AreNotShorterThanTheEdgeThatTheyRunAlong) {
  const std::vector<Vec3> p{{1, 0, 0},
                            {-1, 0, 0},
                            {0, -1, 0},
                            {0, 0, -1},
                            {1.0347587926877404e-12, 2.7308956622358656e-12, -0.9999999999962343}};
  const Mesh mesh(p, std::vector<Face>{{2, 1, 3}, {0, 3, 4}});
  expect_good_path(mesh, vertex_point(mesh, 3), vertex_point(mesh, 0));
  EXPECT_DOUBLE_EQ(PathFinder(mesh).between(vertex_point(mesh, 3), vertex_point(mesh, 0)).length, std::sqrt(2.0));
}

// Legs so short that the path's length does not tell where they cross an edge: the last 7e-11 of 2e5 turned by 1.4.
TEST(WildPaths, AreStraightAtEdgesAlsoWhereLengthDoesNotTell) {
  struct Case {
    Wild family;
    std::uint32_t seed;
    int pair;
  };
  for (const auto& [family, seed, wanted] : {Case{Wild::PowerLaw, 1008, 2}, Case{Wild::FarPoint, 1008, 0},
                                             Case{Wild::FarPoint, 1047, 0}, Case{Wild::Clusters, 1008, 2}}) {
    SCOPED_TRACE(std::string(name_of(family)) + ", seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const Mesh mesh = wild_complex(family, random);
    for (int pair = 0; pair <= wanted; ++pair) {
      const SurfacePoint from = wild_point(mesh, random), to = wild_point(mesh, random);
      if (pair == wanted) {
        EXPECT_EQ(judge_path(mesh, from, to, false).complaint, "");
      }
    }
  }
}

// Every face twice, the other way round: between the sheets over one edge a way may go to and fro.
TEST(WildPaths, OverDoubledSheetsOfAPrismAreFound) {
  constexpr Index kSides = 8;
  std::vector<Vec3> p;
  std::vector<Face> t;
  for (Index k = 0; k < 2 * kSides; ++k) {
    const double angle = 2 * kPi * (k % kSides) / kSides;
    p.push_back({std::cos(angle), std::sin(angle), k < kSides ? 0.0 : 10});
  }
  for (Index k = 0; k < kSides; ++k) {
    const Index a = k, b = (k + 1) % kSides, c = a + kSides, d = b + kSides;
    for (const Face& f : {Face{a, b, d}, Face{a, d, c}}) {
      t.push_back(f);
      t.push_back({f[0], f[2], f[1]});
    }
  }
  const Mesh mesh(p, t);
  for (Index v = 1; v < mesh.vertex_count(); ++v) {
    SCOPED_TRACE("to " + std::to_string(v));
    const PathVerdict verdict = judge_path(mesh, vertex_point(mesh, 0), vertex_point(mesh, v), false);
    EXPECT_EQ(verdict.complaint, "");
  }
}

}  // namespace
}  // namespace brushfire::oracle
