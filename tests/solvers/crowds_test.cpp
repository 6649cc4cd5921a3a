// Vertices and edges at which a hundred thousand faces and more meet: every method, set-up included, in seconds.
#include <brushfire/mesh/nearest_point.h>
#include <brushfire/mesh/report.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/window_field.h>
#include <brushfire/solvers/windows/paths/leg_search.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ctime>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace brushfire {
namespace {

// Several parts' worth. What is quadratic takes a hundred times as long as what is allowed here, which in turn is ten
// times what a release build takes, so that a sanitizer passes.
constexpr Index kFaces = 100'000;
constexpr double kSeconds = 10;

constexpr std::array kMethods{Method::Exact,        Method::Windows,       Method::CarriedSource,
                              Method::NovotniKlein, Method::KimmelSethian, Method::NovotniKlein2002,
                              Method::Dijkstra};

struct Crowd {
  std::string name;
  Mesh mesh;
};

// A closed fan at each height; they share vertex 0.
Mesh fans(const std::vector<double>& heights) {
  std::vector<Vec3> positions{{0, 0, 0}};
  std::vector<Face> faces;
  const Index count = kFaces / static_cast<Index>(heights.size());
  for (const double height : heights) {
    const Index first = static_cast<Index>(positions.size());
    for (Index k = 0; k < count; ++k) {
      const double turn = 2 * kPi * k / count;
      positions.push_back({std::cos(turn), std::sin(turn), height});
      faces.push_back({0, first + k, first + (k + 1) % count});
    }
  }
  return Mesh(positions, faces);
}

// Pages over the edge from vertex 0 to vertex 1; `width` narrower than half of it makes their outer corners obtuse.
Mesh book(double width) {
  std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 1}};
  std::vector<Face> faces;
  for (Index k = 0; k < kFaces; ++k) {
    const double turn = 2 * kPi * k / kFaces;
    positions.push_back({width * std::cos(turn), width * std::sin(turn), 0.5});
    faces.push_back(k % 2 == 0 ? Face{0, 1, k + 2} : Face{0, k + 2, 1});
  }
  return Mesh(positions, faces);
}

std::vector<Crowd> crowds() {
  std::vector<double> many;
  for (int k = 1; k <= 50; ++k) many.push_back(0.02 * k);
  return {{"flat fan", fans({0})},    {"cone", fans({1})}, {"double cone", fans({1, -1})},
          {"fifty fans", fans(many)}, {"book", book(1)},   {"book of obtuse pages", book(0.2)}};
}

double seconds_since(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

TEST(Crowds, TakeSecondsFromTheHubWithAnyMethod) {
  for (const Crowd& c : crowds()) {
    const Source source{vertex_point(c.mesh, 0)};
    for (const Method method : kMethods) {
      DistanceOptions options;
      options.method = method;
      options.threads = 1;
      const std::clock_t begin = std::clock();
      const DistanceField field = distance(c.mesh, std::span(&source, 1), options);
      EXPECT_LT(seconds_since(begin), kSeconds) << c.name << ' ' << name_of(method);
      for (Index v = 0; v < c.mesh.vertex_count(); ++v) {
        const double straight = norm(c.mesh.positions()[v]);
        ASSERT_NEAR(field.distance[v], straight, 1e-6 * straight) << c.name << ' ' << name_of(method);
      }
    }
  }
}

TEST(Crowds, TakeSecondsFromTheRimAndFromSeveralSources) {
  for (const Crowd& c : crowds()) {
    const Index last = c.mesh.vertex_count() - 1;
    for (const std::vector<Index>& at : {std::vector<Index>{last}, std::vector<Index>{last, 0, 0, 2}}) {
      std::vector<Source> sources;
      for (const Index v : at) sources.push_back({vertex_point(c.mesh, v)});
      for (const Method method : kMethods) {
        DistanceOptions options;
        options.method = method;
        options.threads = 1;
        const std::clock_t begin = std::clock();
        const DistanceField field = distance(c.mesh, sources, options);
        EXPECT_LT(seconds_since(begin), kSeconds) << c.name << ' ' << name_of(method);
        EXPECT_EQ(field.reached, c.mesh.vertex_count());
        EXPECT_EQ(field.source[at.back()], at.size() - 1) << c.name << ' ' << name_of(method);
      }
    }
  }
}

TEST(Crowds, AreReportedSearchedAndCrossedInSeconds) {
  for (const Crowd& c : crowds()) {
    const std::clock_t begin = std::clock();
    EXPECT_EQ(c.mesh.report().components, 1);
    const Index last = c.mesh.vertex_count() - 1;
    EXPECT_LT(NearestPointFinder(c.mesh)(c.mesh.positions()[last]).distance, 1e-12);
    PathFinder finder(c.mesh);
    const SurfacePoint from = vertex_point(c.mesh, last), to = vertex_point(c.mesh, last / 3);
    const SurfacePath path = finder.between(from, to);
    EXPECT_GT(path.points.size(), 1u);
    EXPECT_NEAR(path.length, finder.between(to, from).length, 1e-11 * path.length) << c.name;
    EXPECT_LT(seconds_since(begin), kSeconds) << c.name;
  }
}

// The chord of a third of the circle, which only its length in 106 bits tells from others.
TEST(Crowds, OneLegCrossesAThirdOfTheFaces) {
  const Mesh mesh = fans({0});
  const Index to = mesh.vertex_count() - 1, from = to / 3;
  const Source source{vertex_point(mesh, from)};
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  const DistanceField field = distance(mesh, std::span(&source, 1), options);
  const WindowField::Leg leg = field.windows->last_leg(to);
  EXPECT_EQ(leg.vertex, from);
  EXPECT_GT(leg.points.size(), kFaces / 3);
  EXPECT_NEAR(leg.length, norm(mesh.positions()[to] - mesh.positions()[from]), 1e-12);
}

// A hub and two rings around it: rays from the hub to the outer one pass between vertices of the inner one.
Mesh rings(Index count) {
  std::vector<Vec3> positions{{0, 0, 0}};
  std::vector<Face> faces;
  for (const double radius : {1.0, 2.0}) {
    for (Index k = 0; k < count; ++k) {
      const double turn = 2 * kPi * (k + 0.3 * radius) / count;
      positions.push_back({radius * std::cos(turn), radius * std::sin(turn), 0});
    }
  }
  for (Index k = 0; k < count; ++k) {
    const Index a = 1 + k, b = 1 + (k + 1) % count;
    faces.insert(faces.end(), {{0, a, b}, {a, a + count, b + count}, {a, b + count, b}});
  }
  return Mesh(positions, faces);
}

// No hint says which of a hundred thousand edges it is, and no bound says which it is not.
TEST(Crowds, ALegFromTheHubIsFoundByLength) {
  const Mesh mesh = rings(kFaces);
  const Index root = 1 + kFaces + kFaces / 2;
  const std::function<double(Index)> value = [&](Index v) {
    return norm(mesh.positions()[v] - mesh.positions()[root]) / mesh.unit();
  };
  detail::LocatedSource source;
  source.at = locate(mesh, vertex_point(mesh, root));
  const double straight = 2 / mesh.unit();
  const WindowField::Leg leg = windows::find_leg({mesh,
                                                  std::span(&source, 1),
                                                  windows::CurveIndex(),
                                                  0,
                                                  value,
                                                  locate(mesh, vertex_point(mesh, 0)),
                                                  straight * (1 - 1e-3),
                                                  0,
                                                  0,
                                                  kNoIndex,
                                                  kNoIndex,
                                                  {}});
  EXPECT_EQ(leg.vertex, root);
  EXPECT_NEAR(leg.length, straight, 1e-12 * straight);
}

}  // namespace
}  // namespace brushfire
