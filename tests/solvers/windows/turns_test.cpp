// How often windows are taken up: a few times for every face, however many faces light could wind through.
#include "oracle/zoo.h"

#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/uneven_wheel.h"

namespace brushfire {
namespace {

// Light that winds round a tip, or past the vertices of a rim, makes turns by faces squared; without it they are 2 to 6
// for every face, and some 8 where rounding has decided ties.
constexpr double kTurnsForEachFace = 10;

struct Place {
  std::string name;
  SurfacePoint point;
};

void expect_few_turns(const Mesh& mesh, const std::vector<Place>& places, const std::string& where) {
  for (const Place& place : places) {
    const Source source{place.point};
    for (const Method method : {Method::Exact, Method::Windows}) {
      DistanceOptions options;
      options.method = method;
      const DistanceField field = distance(mesh, std::span(&source, 1), options);
      EXPECT_EQ(field.reached, mesh.vertex_count()) << where;
      EXPECT_LE(static_cast<double>(field.updates), kTurnsForEachFace * mesh.face_count())
          << where << ", " << name_of(method) << " from " << place.name;
    }
  }
}

std::vector<Place> places_of(const Mesh& mesh, Index rim) {
  const Index face = mesh.face_count() / 3;
  return {{"a tip", vertex_point(mesh, 0)},
          {"the rim", vertex_point(mesh, rim)},
          {"inside of a face", {face, {0.2, 0.3, 0.5}}},
          {"an edge to a tip", {face, {0.4, 0.6, 0}}},
          {"an edge of the rim", {face, {0, 0.4, 0.6}}}};
}

// 500: ordinary faces; 2,000: needles in wider numbers; 20,000: in several parts.
TEST(Turns, AreFewForEachFaceOfABipyramid) {
  for (const Index rim : {500, 2'000, 20'000}) {
    for (const double height : {0.1, 1.0, 20.0}) {
      const Mesh mesh = oracle::bipyramid(rim, height, height);
      expect_few_turns(mesh, places_of(mesh, 2),
                       std::to_string(rim) + " vertices on the rim, " + std::to_string(height));
    }
  }
}

TEST(Turns, AreFewForEachFaceOfAFanAndABook) {
  for (const Index count : {500, 2'000, 20'000}) {
    for (const double height : {0.0, 1.0}) {
      const Mesh mesh = oracle::fan(count, true, height);
      expect_few_turns(mesh, places_of(mesh, 1), "a fan of " + std::to_string(count));
    }
    const Mesh book = shapes::book(count, 1, 2).mesh();
    expect_few_turns(book, places_of(book, 2), "a book of " + std::to_string(count));
  }
}

// A source at no distance from the hub of a wheel, to rounding: turned about the hub from face to face it would stay
// before the next spoke, and go round for ever. Shares of a face down to its own last bits, whatever lies around it.
TEST(Turns, ASourceBesideAVertexDoesNotGoRoundIt) {
  std::mt19937_64 random(20261130);
  std::uniform_real_distribution<double> power(-62, -36);
  for (int i = 0; i < 4000; ++i) {
    const Index count = std::array{3U, 4U, 6U, 8U, 17U, 60U, 200U}[static_cast<std::size_t>(i) % 7];
    const double height = std::array{0.0, 0.3, 3.0, 30.0, 200.0}[static_cast<std::size_t>(i / 7) % 5];
    const Mesh mesh = test::uneven_wheel(count, height, i % 3 == 0 ? 0 : 6, random);
    const double a = std::exp2(power(random)), b = i % 5 == 0 ? 0 : std::exp2(power(random));
    Source source;
    const SurfacePoint place{static_cast<Index>(random() % count), {1 - a - b, a, b}};
    if (i % 2) {
      source.point = place;
    } else {
      source = source_along({{place}});
    }
    DistanceOptions options;
    options.method = i % 4 < 2 ? Method::Exact : Method::Windows;
    const DistanceField field = distance(mesh, std::span(&source, 1), options);
    EXPECT_LE(static_cast<double>(field.updates), kTurnsForEachFace * mesh.face_count()) << i;
    // No farther from the source than from the hub, or nearer, than these are apart.
    const double apart = (a + b) * (1 + height);
    for (Index v = 1; v <= count; ++v) {
      EXPECT_NEAR(field.distance[v], norm(mesh.positions()[v] - mesh.positions()[0]), apart + field.error_bound[v])
          << i;
    }
  }
}

// The same where the faces around the vertex are in several parts.
TEST(Turns, ASourceBesideAnyVertexOfALargeMeshDoesNotGoRoundIt) {
  const Mesh mesh = shapes::icosphere(5).mesh();
  std::mt19937_64 random(20261130);
  std::uniform_real_distribution<double> power(-56, -40);
  DistanceSolver solver(mesh);
  DistanceOptions options;
  options.method = Method::Exact;
  options.max_distance = 0.05;
  for (int i = 0; i < 2000; ++i) {
    const double a = std::exp2(power(random)), b = std::exp2(power(random));
    const Source source{{static_cast<Index>(random() % mesh.face_count()), {a, 1 - a - b, b}}};
    EXPECT_LE(solver.distance(std::span(&source, 1), options).updates, 2000U) << i;
  }
}

// A hub, and around it a rim whose vertices are at random distances and heights: saddles, spikes, needles. With two
// hubs over one rim, or one; closed or not.
Mesh random_wheel(std::mt19937_64& random, Index count, double roughness, bool closed, bool two) {
  std::uniform_real_distribution<double> part(-roughness, roughness), phase(0, 1);
  std::vector<Vec3> p{{0, 0, 0.8}, {0.1, 0, -0.5}};
  std::vector<Face> t;
  const double shift = phase(random);
  for (Index k = 0; k < count; ++k) {
    const double angle = 2 * kPi * (k + shift) / count, radius = 1 + part(random);
    p.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.3 * part(random)});
  }
  for (Index k = 0; k + (closed ? 0 : 1) < count; ++k) {
    const Index a = 2 + k, b = 2 + (k + 1) % count;
    t.push_back({0, a, b});
    if (two) t.push_back({1, b, a});
  }
  return Mesh(p, t);
}

// Runs that keep their windows let them wait at every spoke.
TEST(Turns, OverManySpokesAtOnceLoseNothing) {
  std::mt19937_64 random(20261130);
  std::uniform_real_distribution<double> weight(0, 1);
  for (int i = 0; i < 48; ++i) {
    const double roughness = std::array{0.0, 1e-3, 0.1, 0.8}[static_cast<std::size_t>(i) % 4];
    const bool closed = i % 3 != 0, two = i % 5 != 0;
    const Mesh mesh = random_wheel(random, 260 + static_cast<Index>(i), roughness, closed, two);
    const auto place = [&] {
      const double a = weight(random), b = (1 - a) * weight(random);
      return SurfacePoint{static_cast<Index>(random() % mesh.face_count()), {a, b, 1 - a - b}};
    };
    const std::vector<Source> sources{{place(), 0, {}}};
    const std::vector<SurfacePoint> targets{place(), place(), place()};
    DistanceOptions options;
    options.method = i % 2 ? Method::Exact : Method::Windows;
    const DistanceField at_once = distance(mesh, sources, options);
    options.targets = targets;
    const DistanceField to_targets = distance(mesh, sources, options);
    options.targets.clear();
    options.keep_windows = true;
    const DistanceField one_by_one = distance(mesh, sources, options);
    options.targets = targets;
    const DistanceField to_targets_one_by_one = distance(mesh, sources, options);
    const std::string where = "wheel " + std::to_string(i);
    EXPECT_EQ(at_once.reached, two ? mesh.vertex_count() : mesh.vertex_count() - 1) << where;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (one_by_one.distance[v] == kInfinity) continue;  // the second hub where there is one only
      const double allowed = at_once.error_bound[v] + one_by_one.error_bound[v];
      ASSERT_NEAR(at_once.distance[v], one_by_one.distance[v], allowed) << where << ", vertex " << v;
    }
    for (std::size_t k = 0; k < targets.size(); ++k) {
      const double d = to_targets_one_by_one.target_distance[k];
      ASSERT_NEAR(to_targets.target_distance[k], d, 2 * one_by_one.max_error_bound * d) << where << ", target " << k;
    }
    EXPECT_LE(at_once.updates, one_by_one.updates) << where;
  }
}

// By symmetry a straight way down the middle of two faces leads from tip to tip.
TEST(Turns, LoseNothingOfABipyramid) {
  for (const Index rim : {300, 20'000}) {
    const Mesh mesh = oracle::bipyramid(rim, 1, 1);
    const Source source{vertex_point(mesh, 0)};
    for (const Method method : {Method::Exact, Method::Windows}) {
      DistanceOptions options;
      options.method = method;
      const DistanceField field = distance(mesh, std::span(&source, 1), options);
      const double middle = std::cos(kPi / rim), tip = 2 * std::hypot(1, middle);
      EXPECT_NEAR(field.distance[1], tip, 1e-11 * tip);
      for (Index v = 2; v < mesh.vertex_count(); ++v) ASSERT_NEAR(field.distance[v], std::sqrt(2), 1e-11) << v;
    }
  }
}

}  // namespace
}  // namespace brushfire
