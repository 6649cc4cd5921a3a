// Whole fields on scans, stretched and dirty meshes.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>
#include <support/shared_meshes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/relative_errors.h"

namespace brushfire {
namespace {

DistanceField field_of(const Mesh& mesh, Method method, Index source, Precision precision = Precision::Float) {
  DistanceOptions options;
  options.method = method;
  options.precision = precision;
  const Source from{vertex_point(mesh, source), 0};
  return distance(mesh, {&from, 1}, options);
}

bool is_plane(const std::string& name) { return name.rfind("grid", 0) == 0 || name.rfind("square", 0) == 0; }

TEST(CarriedSource, IsNearerToTheTruthThanNovotniKleinOnEverySharedMesh) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const auto& [name, source] : test::shared_truths()) {
    const Mesh mesh = test::shared_mesh(name);
    const std::vector<double> truth = test::shared_truth(name, source);
    const test::RelativeErrors nk = test::relative_errors(field_of(mesh, Method::NovotniKlein, source).distance, truth);
    const test::RelativeErrors own =
        test::relative_errors(field_of(mesh, Method::CarriedSource, source).distance, truth);
    if (is_plane(name)) {
      EXPECT_LE(own.largest, 1e-4) << name << "." << source;
    } else {
      EXPECT_LT(own.mean, 0.75 * nk.mean) << name << "." << source;
      EXPECT_LT(own.largest, nk.largest) << name << "." << source;
      EXPECT_LT(own.mean, 1e-3) << name << "." << source;
    }
  }
}

// 604 sources of a flat square each: what loses its source somewhere reads 0.1 to 10 % too much behind.
TEST(CarriedSource, FlatMeshesAreExactFromEveryVertex) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const char* name : {"square604", "square604-x10"}) {
    const Mesh mesh = test::shared_mesh(name);
    DistanceSolver solver(mesh);
    for (const Precision precision : {Precision::Float, Precision::Double}) {
      DistanceOptions options;
      options.method = Method::CarriedSource;
      options.precision = precision;
      const double room = precision == Precision::Float ? 1e-4 : 1e-11;
      DistanceField field;
      for (Index s = 0; s < mesh.vertex_count(); ++s) {
        const Source source{vertex_point(mesh, s)};
        solver.distance({&source, 1}, options, field);
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          const double euclid = norm(mesh.positions()[v] - mesh.positions()[s]);
          ASSERT_NEAR(field.distance[v], euclid, room * euclid) << name << ", from " << s << " to " << v;
        }
      }
    }
  }
}

TEST(CarriedSource, OpensSlitsAndGoesAroundThem) {
  const Shape shape = shapes::plane(24, 24);
  const Mesh whole(shape.positions, shape.faces);
  std::vector<Index> slit;
  for (Index h = 0; h < whole.halfedge_count(); ++h) {
    const Vec3 a = whole.positions()[whole.from(h)], b = whole.positions()[whole.to(h)];
    if (a.x == b.x && std::abs(a.x - whole.positions()[12].x) < 1e-12 && std::min(a.y, b.y) > 0.2) slit.push_back(h);
  }
  ASSERT_FALSE(slit.empty());
  const Mesh mesh = whole.with_slits(slit);
  const DistanceField own = field_of(mesh, Method::CarriedSource, 24 * 25, Precision::Double);
  const DistanceField exact = field_of(mesh, Method::Exact, 24 * 25);
  const test::RelativeErrors e = test::relative_errors(own.distance, exact.distance);
  EXPECT_LT(e.mean, 2e-3);
  EXPECT_LT(e.largest, 0.02);
}

TEST(CarriedSource, ThreadsDoNotChangeItsBits) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  DistanceOptions options;
  options.method = Method::CarriedSource;
  const Source source{vertex_point(mesh, 5)};
  const DistanceField one = distance(mesh, {&source, 1}, options);
  options.threads = 3;
  EXPECT_EQ(distance(mesh, {&source, 1}, options).distance, one.distance);
}

}  // namespace
}  // namespace brushfire
