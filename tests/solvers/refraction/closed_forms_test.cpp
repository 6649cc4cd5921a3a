// Both bounds by windows around what plane geometry says, at every vertex: half-planes, layers, roads, critical angles.
#include <brushfire/core/detail/random.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/sheets.h"

namespace brushfire {
namespace {

using test::shaken_sheet;

constexpr double kKeptBack = 1e-10;  // at least, for rounding

Vec3 middle_of(const Mesh& mesh, Index f) {
  const Face& t = mesh.faces()[f];
  return (1.0 / 3) * (mesh.positions()[t[0]] + mesh.positions()[t[1]] + mesh.positions()[t[2]]);
}

Vec3 place_of(const Mesh& mesh, const SurfacePoint& p) {
  const Face& t = mesh.faces()[p.face];
  return p.weights[0] * mesh.positions()[t[0]] + p.weights[1] * mesh.positions()[t[1]] +
         p.weights[2] * mesh.positions()[t[2]];
}

// The line y = `line`, along which a unit of length costs `along`, between a half-plane of weight `below` and one of
// weight `above`.
struct HalfPlanes {
  double line = 1, below = 1, above = 1, along = 1;

  double weight(double y) const { return y > line ? above : below; }

  // The least of  w |(x, h)| + w' |(length - x, h')|  over x.
  static double refracted(double w, double h, double v, double g, double length) {
    double low = 0, high = length;
    for (int i = 0; i < 300; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      const auto cost = [&](double x) { return w * std::hypot(x, h) + v * std::hypot(length - x, g); };
      (cost(a) < cost(b) ? high : low) = cost(a) < cost(b) ? b : a;
    }
    return w * std::hypot(low, h) + v * std::hypot(length - low, g);
  }

  double cost(Vec3 p, Vec3 q) const {
    const double h = std::abs(p.y - line), g = std::abs(q.y - line), length = std::abs(p.x - q.x);
    const bool other_side = (p.y - line) * (q.y - line) < 0;
    const double w = weight(p.y == line ? q.y : p.y), v = weight(q.y == line ? p.y : q.y);
    const double direct = other_side ? refracted(w, h, v, g, length) : w * std::hypot(length, p.y - q.y);
    const double c = std::min({along, above, below});
    const auto sideways = [&](double weight, double height) {
      return height == 0 ? 0 : height * c / std::sqrt(weight * weight - c * c);
    };
    if (!(sideways(w, h) + sideways(v, g) <= length)) return direct;
    const auto climb = [&](double weight, double height) {
      return height == 0 ? 0 : height * std::sqrt(weight * weight - c * c);
    };
    return std::min(direct, c * length + climb(w, h) + climb(v, g));
  }

  Weights weights(const Mesh& mesh) const {
    Weights result;
    for (Index f = 0; f < mesh.face_count(); ++f) result.face.push_back(weight(middle_of(mesh, f).y));
    if (along >= std::min(below, above)) return result;
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      const Index a = mesh.from(h), b = mesh.to(h);
      if (a < b && mesh.positions()[a].y == line && mesh.positions()[b].y == line)
        result.edges.push_back({{a, b}, along, 0});
    }
    return result;
  }
};

void expect_enclosed(const Mesh& mesh, const Weights& weights, const SurfacePoint& from, double tolerance,
                     const std::function<double(Vec3)>& truth) {
  const WeightedField field = weighted_distance(mesh, weights, std::vector<Source>{{from}}, {.tolerance = tolerance});
  ASSERT_EQ(field.engine, WeightedEngine::Windows);
  ASSERT_LE(field.max_error_bound, 1.05 * tolerance);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double cost = truth(mesh.positions()[v]);
    if (cost == 0) continue;
    ASSERT_LT(field.lower[v], cost * (1 - kKeptBack)) << v;
    ASSERT_GT(field.distance[v], cost * (1 + kKeptBack)) << v;
  }
}

void expect_half_planes(const HalfPlanes& planes, double tolerance) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = shaken_sheet(4, 2, seed);
    Random random(seed);
    std::vector<SurfacePoint> sources{vertex_point(mesh, 17 * 3), vertex_point(mesh, 17 * 4 + 2),
                                      vertex_point(mesh, 17 * 6 + 1)};  // below, on and above the line
    for (const bool on_edge : {false, true}) {
      const auto f = static_cast<Index>(random.below(mesh.face_count()));
      const double a = on_edge ? 0 : random.uniform(0, 0.5), b = random.uniform(0, 0.5);
      sources.push_back({f, {a, b, 1 - a - b}});
    }
    Index h = 0;  // on the line
    while (mesh.positions()[mesh.from(h)].y != planes.line || mesh.positions()[mesh.to(h)].y != planes.line) ++h;
    SurfacePoint on_line{h / 3, {0, 0, 0}};
    on_line.weights[h % 3] = 0.3;
    on_line.weights[(h + 1) % 3] = 0.7;
    sources.push_back(on_line);
    for (std::size_t s = 0; s < sources.size(); ++s) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", source " + std::to_string(s));
      const Vec3 p = place_of(mesh, sources[s]);
      expect_enclosed(mesh, planes.weights(mesh), sources[s], tolerance, [&](Vec3 q) { return planes.cost(p, q); });
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(WeightedWindows, EncloseWhatRefractionAtTwoHalfPlanesCosts) {
  for (const double ratio : {2.0, 0.5, 10.0, 0.1, 1e3, 1e-3}) {
    SCOPED_TRACE("ratio " + std::to_string(ratio));
    for (const double tolerance : {0.01, 1e-4}) {
      expect_half_planes({.above = ratio, .along = std::min(1.0, ratio)}, tolerance);
    }
  }
}

TEST(WeightedWindows, EncloseWhatARoadCosts) {
  for (const double along : {0.9, 0.25, 0.01}) {
    SCOPED_TRACE("along " + std::to_string(along));
    expect_half_planes({.along = along}, 1e-4);
    expect_half_planes({.above = 3, .along = along}, 1e-4);
  }
}

// Where rays that just touch the line at the critical angle pass through vertices, two windows meet there, and neither
// may leave it to the other.
TEST(WeightedWindows, EncloseCostsWhereTheCriticalAngleLiesBetweenTwoWindows) {
  const Mesh mesh = shapes::plane(10, 6, 10, 6).mesh();
  for (const double ratio :
       {std::sqrt(2.0), std::sqrt(5.0), std::sqrt(5.0) / 2, std::sqrt(10.0), std::sqrt(13.0) / 2}) {
    for (const bool is_road : {false, true}) {
      const HalfPlanes planes{.line = 3, .below = is_road ? ratio : 1, .above = ratio, .along = 1};
      for (Index v = 0; v < mesh.vertex_count(); v += is_road ? 7 : 3) {
        SCOPED_TRACE("ratio " + std::to_string(ratio) + ", source " + std::to_string(v));
        const Vec3 p = mesh.positions()[v];
        expect_enclosed(mesh, planes.weights(mesh), vertex_point(mesh, v), 1e-3,
                        [&](Vec3 q) { return planes.cost(p, q); });
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(WeightedWindows, EncloseWhatFourLayersCost) {
  const std::vector<double> layers{1, 3, 2, 5};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Mesh mesh = shaken_sheet(4, 3, seed);
    Weights weights;
    for (Index f = 0; f < mesh.face_count(); ++f)
      weights.face.push_back(layers[static_cast<std::size_t>(middle_of(mesh, f).x)]);
    const Index from = 17;  // (0, 1/4), in the cheapest layer: paths cross those between, and run along none
    const Vec3 p = mesh.positions()[from];
    const auto truth = [&](Vec3 q) {
      const double height = std::abs(q.y - p.y);
      // The slowness s along the layers is the same in all of them.
      const auto wide = [&](std::size_t i) { return std::clamp(q.x - static_cast<double>(i), 0.0, 1.0); };
      double low = 0, high = 1;
      for (int i = 0; i < 200; ++i) {
        const double s = 0.5 * (low + high);
        double climbed = 0;
        for (std::size_t k = 0; k < 4; ++k) climbed += wide(k) * s / std::sqrt((layers[k] - s) * (layers[k] + s));
        (climbed < height ? low : high) = s;
      }
      double cost = low * height;
      for (std::size_t k = 0; k < 4; ++k) cost += wide(k) * std::sqrt((layers[k] - low) * (layers[k] + low));
      return cost;
    };
    expect_enclosed(mesh, weights, vertex_point(mesh, from), 1e-4, truth);
  }
}

}  // namespace
}  // namespace brushfire
