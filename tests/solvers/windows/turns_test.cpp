// How often windows are taken up: a few times for every face, however many faces light could wind through.
#include "oracle/zoo.h"

#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

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
  return {{"a tip", vertex_point(mesh, 0)}, {"the rim", vertex_point(mesh, rim)}};
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
