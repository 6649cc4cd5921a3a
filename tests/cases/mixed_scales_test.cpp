// Lengths of one mesh that differ by up to 1e20: what was wrong by percents, or never ended.
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace brushfire {
namespace {

constexpr double kRounding = 1e-12;

DistanceField field_of(const Mesh& mesh, const SurfacePoint& source, Method method, double tolerance = 0) {
  DistanceOptions options;
  options.method = method;
  options.tolerance = tolerance;
  const std::vector<Source> sources{{source}};
  return distance(mesh, sources, options);
}

void expect_distance(const Mesh& mesh, const SurfacePoint& source, Index target, double truth) {
  for (const Method method : {Method::Exact, Method::Windows}) {
    const DistanceField field = field_of(mesh, source, method);
    EXPECT_NEAR(field.distance[target], truth, kRounding * truth) << name_of(method);
    EXPECT_LE(std::abs(field.distance[target] - truth), field.error_bound[target] + 2e-16 * truth) << name_of(method);
  }
  const DistanceField merged = field_of(mesh, source, Method::Windows, 1e-3);
  EXPECT_NEAR(merged.distance[target], truth, 1e-3 * truth);
}

TEST(MixedScales, AThousandMillionthBesideOneIsRight) {
  const std::vector<Vec3> p{{4.302888158430978e-10, 3.0748486610913166e-09, 0.0},
                            {4.899344465970438e-10, 3.5270034201915075e-09, 0.0},
                            {-5.921487155243328e-10, 3.6231335032242515e-09, 0.0},
                            {0.07599163604203463, 0.9818647800286964, 0.0},
                            {7.951351702641244e-10, 3.734646297912131e-09, 0.0}};
  const std::vector<Face> faces{{0, 1, 2}, {1, 3, 2}, {3, 1, 4}};
  expect_distance(Mesh(p, faces), {0, {0.3175741090000086, 0.2508508017643311, 0.4315750892356604}}, 4,
                  8.49618038738446e-10);
}

TEST(MixedScales, ThroughATinyFaceBetweenHugeOnesIsRight) {
  const std::vector<Vec3> p{{-10805715090.518063, 1.3233184398101196e-06, 0.0},
                            {-9.751554891192338e-11, 1.1942210484208413e-26, 5.630062841447308e-11},
                            {7.478901430895795e-05, 1221397293669.1458, -705174056287.3617},
                            {-9.999075452684866e-08, 1.2245335747563394e-23, -5.7729689042549865e-08},
                            {-1.9847377881504661e-19, -0.0010804409290538944, -0.0006237928612327552}};
  const std::vector<Face> faces{{1, 3, 2}, {1, 4, 3}, {3, 4, 0}};
  const Mesh mesh(p, faces);
  expect_distance(mesh, vertex_point(mesh, 0), 2, 1421153827665.24);
  expect_distance(mesh, vertex_point(mesh, 2), 0, 1421153827665.24);
}

TEST(MixedScales, ThereAndBackAreEquallyLong) {
  const std::vector<Vec3> p{{-3742298.0113882613, 81.96726929277324, 266852736.73670954},
                            {13560019.028510269, 0.4834490877732916, -5050093.201634217},
                            {0.0017583456224516355, -2.3547910908015352e-11, -0.0003843402477030703},
                            {11.804946590976774, 9.723688759817663e-06, 26.096766510946836},
                            {1.0244748197273661e-12, 1.4305497690672593e-19, 2.0426583066126502e-13},
                            {2.3984488538731554, 9.823283513991513e-08, -0.46152792606612986},
                            {-7.027014914806995e-10, 2.1031285445475573e-15, 1.0101656789863514e-09},
                            {0.2199517555480872, 8.496644550997446e-08, -0.045706181031339284},
                            {56567838.234465234, 7.59723246688621, -8959970.125731701},
                            {8.873078704565253e-10, 3.1387230536053015e-15, 6.991588786097018e-10},
                            {4.222000312634934e-08, 2.3629646727203237e-14, -9.033256485831344e-11},
                            {40.4860848043965, 8.520301876266524e-06, -4.815960097190528},
                            {-59812763.42693119, 149.08718050414487, -41023890.412777245},
                            {1.783692183496546e-05, 1.1481682332367517e-11, 5.1674612022901195e-06},
                            {128.1732776144387, 3.7840265165293284e-05, 7.522091817394312}};
  const std::vector<Face> faces{{0, 1, 4},   {0, 4, 3},    {1, 2, 5},    {1, 5, 4},   {3, 4, 6},  {4, 7, 6},
                                {4, 5, 8},   {4, 8, 7},    {6, 7, 9},    {7, 10, 9},  {7, 8, 10}, {8, 11, 10},
                                {9, 10, 12}, {10, 13, 12}, {10, 11, 14}, {10, 14, 13}};
  const Mesh mesh(p, faces);
  const double there = field_of(mesh, vertex_point(mesh, 7), Method::Exact).distance[11];
  EXPECT_NEAR(there, field_of(mesh, vertex_point(mesh, 11), Method::Exact).distance[7], kRounding * there);
}

TEST(MixedScales, RunsEndWhereOneMoreEdgeRoundsToNothing) {
  const std::vector<Vec3> four{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 1e+16}};
  const std::vector<Face> its_faces{{0, 1, 2}, {0, 1, 2}, {2, 1, 3}};
  const std::vector<Vec3> nine{{0.0, 0.0, 0.0},
                               {0.0, 0.0, 269493.8632525538},
                               {0.0, 0.0, 0.20333856728277136},
                               {-0.0003355534211937723, 0.000251248522019183, 3.4683195554171834e-05},
                               {-0.0008312342476198834, 0.0009242294181920699, 0.0017954260198282462},
                               {-181073236636.5908, 56148583274.39803, -56607712789.41399},
                               {-5.153224685019182e-12, 1.0928615462475018e-12, 3.875584823482745e-12},
                               {4.7268769325257866e-05, -3.27343228740523e-05, 2.0197187001892322e-06},
                               {2.001264910770773e-05, -1.6616901223953203e-05, 1.6675125430203603e-05}};
  const std::vector<Face> nine_faces{{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {0, 1, 5}, {1, 6, 5},
                                     {1, 2, 6}, {0, 1, 7}, {1, 8, 7}, {1, 2, 8}};
  for (const Mesh& mesh : {Mesh(four, its_faces), Mesh(nine, nine_faces)}) {
    for (Index source = 0; source < mesh.vertex_count(); ++source) {
      for (const double tolerance : {0.0, 1e-3}) {
        const DistanceField field = field_of(mesh, vertex_point(mesh, source), Method::Windows, tolerance);
        EXPECT_EQ(field.reached, mesh.vertex_count()) << "from " << source;
      }
    }
  }
}

}  // namespace
}  // namespace brushfire
