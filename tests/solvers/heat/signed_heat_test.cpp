// Signed distances by heat, beside lines and circles in the plane and on the sphere.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/solvers/heat/cholesky.h>
#include <brushfire/solvers/signed_heat.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire {
namespace {

class SignedHeat : public testing::Test {
 protected:
  void SetUp() override {
    if (!heat::can_factor()) GTEST_SKIP() << "this build has no Eigen";
  }
};

SignedCurve row_of(const Mesh& mesh, Index columns, Index row, Index begin, Index end) {
  SignedCurve curve;
  for (Index i = begin; i <= end; ++i) curve.points.push_back(vertex_point(mesh, row * (columns + 1) + i));
  return curve;
}

TEST_F(SignedHeat, OfALineItIsTheHeightAndNegativeOnTheLeft) {
  const Mesh mesh = shapes::plane(20, 20, 20, 20).mesh();
  const SignedCurve line = row_of(mesh, 20, 8, 0, 20);  // to the right: its left is above
  SignedHeatSolver solver(mesh);
  for (const LevelSetConstraint c :
       {LevelSetConstraint::None, LevelSetConstraint::ZeroSet, LevelSetConstraint::Multiple}) {
    const std::vector<double> d = solver.distance({&line, 1}, {}, {.constraint = c});
    for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(d[v], 8 - mesh.positions()[v].y, 0.3) << v;
  }
}

TEST_F(SignedHeat, OfACircleItIsNegativeInsideAndZeroOnIt) {
  const Mesh mesh = shapes::plane(30, 30, 30, 30).mesh();
  std::vector<double> away;
  const Vec3 centre{15.2, 14.7, 0};
  for (const Vec3& p : mesh.positions()) away.push_back(norm(p - centre));
  const std::vector<double> level{8.5};
  const std::vector<Isoline> lines = isolines(mesh, away, level);  // counter-clockwise
  ASSERT_EQ(lines.size(), 1u);
  SignedCurve circle{lines[0].line.points};
  circle.points.push_back(circle.points.front());
  SignedHeatSolver solver(mesh);
  for (const bool preserve : {false, true}) {
    const std::vector<double> d = solver.distance({&circle, 1}, {}, {.preserve_normals = preserve});
    for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(d[v], away[v] - 8.5, 0.6) << v;
    for (const SurfacePoint& p : circle.points) {
      double value = 0;
      for (int k = 0; k < 3; ++k) value += p.weights[k] * d[mesh.faces()[p.face][k]];
      EXPECT_NEAR(value, 0, 0.01);
    }
  }
}

TEST_F(SignedHeat, GapsAreClosed) {
  const Mesh mesh = shapes::plane(24, 24, 24, 24).mesh();
  const std::vector<SignedCurve> dashes{row_of(mesh, 24, 12, 0, 4), row_of(mesh, 24, 12, 8, 14),
                                        row_of(mesh, 24, 12, 19, 24)};
  const std::vector<double> d = SignedHeatSolver(mesh).distance(dashes);
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(d[v], 12 - mesh.positions()[v].y, 0.8) << v;
}

TEST_F(SignedHeat, ItGoesFartherThanNumbersReach) {
  const Mesh mesh = shapes::plane(3, 1500, 3, 1500).mesh();
  const SignedCurve line = row_of(mesh, 3, 100, 0, 3);
  for (const bool preserve : {false, true}) {
    const std::vector<double> d = SignedHeatSolver(mesh).distance({&line, 1}, {}, {.preserve_normals = preserve});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double expected = 100 - mesh.positions()[v].y;
      ASSERT_NEAR(d[v], expected, 0.3 + 1e-3 * std::abs(expected)) << v;
    }
  }
}

TEST_F(SignedHeat, WithoutADirectionItGrowsOnBothSides) {
  const Mesh mesh = shapes::icosphere(3).mesh();
  const SurfacePoint pole = vertex_point(mesh, 4);
  const std::vector<double> d = SignedHeatSolver(mesh).distance({}, {&pole, 1});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 a = mesh.positions()[4], b = mesh.positions()[v];
    EXPECT_NEAR(d[v], std::atan2(norm(cross(a, b)), dot(a, b)), 0.2);
  }
}

TEST_F(SignedHeat, OtherComponentsAreInfinitelyFarAndErrorsNameWhatIsWrong) {
  Shape shape = shapes::plane(4, 4, 4, 4);
  const Index n = static_cast<Index>(shape.positions.size());
  for (const Vec3 p : {Vec3{90, 0, 0}, Vec3{91, 0, 0}, Vec3{90, 1, 0}}) shape.positions.push_back(p);
  shape.faces.push_back({n, n + 1, n + 2});
  const Mesh mesh = shape.mesh();
  SignedHeatSolver solver(mesh);
  const SignedCurve line = row_of(mesh, 4, 2, 0, 4);
  EXPECT_EQ(solver.distance({&line, 1})[n], kInfinity);
  const SignedCurve jump{{vertex_point(mesh, 0), vertex_point(mesh, 24)}};
  EXPECT_THROW(solver.distance({&jump, 1}), Error);
  EXPECT_THROW(solver.distance({}), Error);
}

}  // namespace
}  // namespace brushfire
