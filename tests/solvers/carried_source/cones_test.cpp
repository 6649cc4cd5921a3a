// Cones, saddles and pages: surfaces that are flat but for a point or a line, where distances are known.
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire {
namespace {

DistanceField march(const Mesh& mesh, const Source& source, std::vector<SurfacePoint> targets = {}) {
  DistanceOptions options;
  options.method = Method::CarriedSource;
  options.precision = Precision::Double;
  options.targets = std::move(targets);
  return distance(mesh, {&source, 1}, options);
}

// Faces around vertex 0, with `angle` in all; closed or not. Rim vertices are 1 from it.
Mesh cone(Index rim, double angle, bool closed, bool mirror_some) {
  std::vector<Face> faces;
  std::vector<std::array<double, 3>> lengths;
  const Index steps = closed ? rim : rim - 1;
  const double edge = 2 * std::sin(angle / steps / 2);
  for (Index k = 0; k < steps; ++k) {
    const Index a = 1 + k, b = 1 + (k + 1) % rim;
    if (mirror_some && k % 3 == 1) {
      faces.push_back({0, b, a});
    } else {
      faces.push_back({0, a, b});
    }
    lengths.push_back({1, edge, 1});
  }
  return Mesh::from_lengths(rim + 1, faces, lengths);
}

double across(double turn) { return turn < kPi ? 2 * std::sin(turn / 2) : 2; }

class Cones : public testing::TestWithParam<double> {};

// From a rim vertex the light passes the apex on both sides; a saddle casts a shadow.
TEST_P(Cones, ClosedOnesAreExact) {
  for (const Index rim : {24u, 40u, 97u}) {
    const double angle = GetParam() * kPi;
    if (angle / rim > 0.5 * kPi) continue;
    for (const bool mirrored : {false, true}) {
      const Mesh mesh = cone(rim, angle, true, mirrored);
      for (const Index source : {1u, 7u, rim}) {
        const DistanceField field = march(mesh, {vertex_point(mesh, source)});
        for (Index v = 1; v <= rim; ++v) {
          const double turn = angle * std::abs(static_cast<double>(v) - source) / rim;
          EXPECT_NEAR(field.distance[v], across(std::min(turn, angle - turn)), 1e-9)
              << rim << " around " << GetParam() << " pi, from " << source << " to " << v;
        }
      }
    }
  }
}

TEST_P(Cones, OpenOnesAreExact) {
  const Index rim = 60;
  const double angle = GetParam() * kPi;
  for (const bool mirrored : {false, true}) {
    const Mesh mesh = cone(rim, angle, false, mirrored);
    for (const Index source : {1u, 20u, rim}) {
      const DistanceField field = march(mesh, {vertex_point(mesh, source)});
      for (Index v = 1; v <= rim; ++v) {
        const double turn = angle * std::abs(static_cast<double>(v) - source) / (rim - 1);
        EXPECT_NEAR(field.distance[v], across(turn), 1e-9) << "from " << source << " to " << v;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, Cones, testing::Values(0.9, 1.5, 2.0, 2.3, 3.0, 3.7, 5.0, 9.0));

// Half planes that meet in a line: light goes from one into every other, straight on.
Mesh pages(Index count, Index size, std::mt19937& random) {
  std::vector<Vec3> positions;
  for (Index y = 0; y <= size; ++y) positions.push_back({0, 0, static_cast<double>(y)});
  std::vector<Face> faces;
  for (Index p = 0; p < count; ++p) {
    const double turn = 2 * kPi * p / count;
    const auto first = static_cast<Index>(positions.size());
    for (Index x = 1; x <= size; ++x) {
      for (Index y = 0; y <= size; ++y) {
        positions.push_back({x * std::cos(turn), x * std::sin(turn), static_cast<double>(y)});
      }
    }
    const auto at = [&](Index x, Index y) { return x == 0 ? y : first + (x - 1) * (size + 1) + y; };
    for (Index x = 0; x < size; ++x) {
      for (Index y = 0; y < size; ++y) {
        Face a{at(x, y), at(x + 1, y), at(x + 1, y + 1)}, b{at(x, y), at(x + 1, y + 1), at(x, y + 1)};
        if (random() % 2 == 0) std::swap(a[1], a[2]);
        if (random() % 2 == 0) std::swap(b[0], b[1]);
        faces.push_back(a), faces.push_back(b);
      }
    }
  }
  return Mesh(positions, faces);
}

TEST(CarriedSource, LightPassesEdgesOfManyFacesStraight) {
  std::mt19937 random(3);
  const Index size = 8;
  for (const Index count : {1u, 2u, 3u, 5u}) {
    const Mesh mesh = pages(count, size, random);
    const Index page = size * (size + 1);
    const Index source = (size + 1) + 4 * (size + 1) + 3;  // on the first page, at x = 5, y = 3
    const DistanceField field = march(mesh, {vertex_point(mesh, source)});
    for (Index p = 1; p < count; ++p) {
      for (Index x = 1; x <= size; ++x) {
        for (Index y = 0; y <= size; ++y) {
          const Index v = (size + 1) + p * page + (x - 1) * (size + 1) + y;
          EXPECT_NEAR(field.distance[v], std::hypot(x + 5.0, y - 3.0), 1e-9) << count << " pages";
        }
      }
    }
  }
}

// The same with sources and targets that are no vertices.
TEST(CarriedSource, StartsAndEndsAnywhereOnPages) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  const Index size = 5;
  const Mesh mesh = pages(3, size, random);
  const Index page = 2 * size * size;
  const auto flat = [&](const SurfacePoint& p) {
    const Vec3 at = position(mesh, p);
    return Vec2{std::hypot(at.x, at.y), at.z};
  };
  for (int run = 0; run < 100; ++run) {
    const auto anywhere = [&](Index first_face) {
      const double a = run % 3 == 0 ? 0 : unit(random), b = unit(random);
      return SurfacePoint{first_face + static_cast<Index>(random() % page), {a * b, a * (1 - b), 1 - a}};
    };
    const SurfacePoint from = anywhere(0), to = anywhere(page * (1 + static_cast<Index>(random() % 2)));
    const DistanceField field = march(mesh, {from}, {to});
    const Vec2 a = flat(from), b = flat(to);
    EXPECT_NEAR(field.target_distance[0], std::hypot(a.x + b.x, a.y - b.y), 1e-9) << run;
  }
}

}  // namespace
}  // namespace brushfire
