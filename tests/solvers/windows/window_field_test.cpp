// WindowField: legs add up to distances, points inside of faces have the values that the corners predict.
#include "support/shared_meshes.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace brushfire {
namespace {

// The length of the polyline along the traced path, measured in space; the number of vertices at which it bends or
// passes through is bounded by `most_legs`.
double traced_length(const Mesh& mesh, const WindowField& windows, WindowField::Leg leg, double& sum_of_legs,
                     Index& source) {
  double length = 0;
  sum_of_legs = 0;
  for (std::size_t legs = 0; legs <= mesh.vertex_count(); ++legs) {
    for (std::size_t i = 1; i < leg.points.size(); ++i) {
      length += norm(position(mesh, leg.points[i]) - position(mesh, leg.points[i - 1]));
    }
    sum_of_legs += leg.length;
    source = leg.source;
    if (leg.vertex == kNoIndex) return length;
    leg = windows.last_leg(leg.vertex);
  }
  ADD_FAILURE() << "a path that never ends";
  return kInfinity;
}

TEST(WindowField, EveryTracedPolylineIsAsLongAsTheDistance) {
  std::vector<std::pair<std::string, Mesh>> meshes{{"saddle", shapes::saddle(12, 1.5).mesh()},
                                                   {"cube", shapes::cube(5).mesh()},
                                                   {"torus", shapes::torus(20, 12).mesh()},
                                                   {"plane", shapes::plane(9, 7).mesh()},
                                                   {"book", shapes::book(5, 4, 6).mesh()},
                                                   {"bow tie", shapes::bow_tie(3, 7).mesh()},
                                                   {"terrain", shapes::noise_terrain(25, 25, 0.5).mesh()}};
  if (test::has_shared_data()) {
    for (const char* name : {"fandisk", "cow", "teapot", "nm-fin", "beetle"}) {
      meshes.emplace_back(name, test::shared_mesh(name));
    }
  }
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_paths = true;
  for (const auto& [name, mesh] : meshes) {
    Source inner{{mesh.face_count() / 2, {0.2, 0.3, 0.5}}, 0};
    const std::vector<Source> sources{inner, {vertex_point(mesh, 0), 0.25}};
    const DistanceField field = distance(mesh, sources, options);
    ASSERT_TRUE(field.windows);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (field.distance[v] == kInfinity) continue;
      double legs = 0;
      Index source = kNoIndex;
      const double length = traced_length(mesh, *field.windows, field.windows->last_leg(v), legs, source);
      ASSERT_LT(source, sources.size()) << name << ", vertex " << v;
      const double wanted = field.distance[v] - sources[source].offset;
      ASSERT_NEAR(length, wanted, 1e-9 * std::abs(field.distance[v])) << name << ", vertex " << v;
      ASSERT_NEAR(legs, wanted, 1e-9 * std::abs(field.distance[v])) << name << ", vertex " << v;
    }
  }
}

TEST(WindowField, KeptWindowsOfWiderNumbersAgreeWithTargetsAsWell) {
  Shape shape = shapes::icosphere(1);
  for (const Index v : {4u, 5u, 11u}) shape.positions[v] = 1e-9 * shape.positions[v];
  shape.positions[2] = 1e7 * shape.positions[2];
  const Mesh mesh = shape.mesh();
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  DistanceOptions everywhere, at_targets;
  everywhere.method = at_targets.method = Method::Exact;
  everywhere.keep_windows = true;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const double a = uniform(random), b = uniform(random) * (1 - a);
    at_targets.targets.push_back({f, {a, b, 1 - a - b}});
    at_targets.targets.push_back({f, {0, a, 1 - a}});
  }
  for (const Source& source : {Source{vertex_point(mesh, 4)}, Source{{7, {0.25, 0.25, 0.5}}}}) {
    const DistanceField all = distance(mesh, std::span(&source, 1), everywhere);
    const DistanceField some = distance(mesh, std::span(&source, 1), at_targets);
    for (std::size_t i = 0; i < at_targets.targets.size(); ++i) {
      const double d = some.target_distance[i];
      EXPECT_NEAR(all.windows->value(at_targets.targets[i]).distance, d, 4e-15 * d) << i;
    }
  }
}

// A face with a vertex twice is an edge: a source in it and points in it lie on a line.
TEST(WindowField, KeptWindowsGiveTheDistanceAlongTheEdgeOfAFaceWithARepeatedVertex) {
  const Mesh mesh = Shape{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 0, 1}, {1, 2, 2}}}.mesh();
  const std::vector<Source> sources{{{0, {0.25, 0.25, 0.5}}}};
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  const DistanceField field = distance(mesh, sources, options);
  EXPECT_DOUBLE_EQ(field.windows->value({0, {0.75, 0, 0.25}}).distance, 0.75);
  EXPECT_DOUBLE_EQ(field.windows->value({0, {0, 0.125, 0.875}}).distance, 1.125);
  EXPECT_DOUBLE_EQ(field.windows->value({1, {0.5, 0.5, 0}}).distance, 4);
}

TEST(WindowField, KeptWindowsGiveTheDistanceAtEveryPointAndAgreeWithTargets) {
  const Mesh mesh = shapes::noise_terrain(20, 20, 0.5).mesh();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 300; ++i) {
    const double a = uniform(random), b = uniform(random) * (1 - a);
    SurfacePoint p{static_cast<Index>(random() % mesh.face_count()), {a, b, 1 - a - b}};
    if (i % 3 == 0) p.weights = {0, a, 1 - a};  // on an edge
    points.push_back(p);
  }
  const std::vector<Source> sources{{points[0]}, {points[1], 0.1}};
  DistanceOptions options;
  options.method = Method::Exact;
  options.keep_windows = true;
  const DistanceField everywhere = distance(mesh, sources, options);
  options.keep_windows = false;
  options.keep_paths = true;
  options.targets = points;
  const DistanceField targets = distance(mesh, sources, options);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const WindowField::Value value = everywhere.windows->value(points[i]);
    EXPECT_NEAR(value.distance, targets.target_distance[i], 1e-12) << i;
    EXPECT_EQ(value.source, targets.target_source[i]);
    EXPECT_NEAR(targets.windows->value(points[i]).distance, value.distance, 1e-12);
    double legs = 0;
    Index source = kNoIndex;
    const double length =
        traced_length(mesh, *everywhere.windows, everywhere.windows->last_leg(points[i]), legs, source);
    ASSERT_LT(source, 2u);
    EXPECT_NEAR(length, value.distance - sources[source].offset, 1e-9) << i;
    // The point as the source, the source as the target.
    DistanceOptions back;
    back.method = Method::Exact;
    back.targets = {sources[0].point, sources[1].point};
    if (i > 60) continue;
    const std::vector<Source> from_here{{points[i]}};
    const DistanceField reverse = distance(mesh, from_here, back);
    EXPECT_NEAR(std::min(reverse.target_distance[0], reverse.target_distance[1] + 0.1), value.distance, 1e-12) << i;
  }
  EXPECT_THROW(targets.windows->value({0, {0.31, 0.33, 0.36}}), Error);
}

}  // namespace
}  // namespace brushfire
