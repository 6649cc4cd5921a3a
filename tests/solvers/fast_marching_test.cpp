// The fast marching methods and Dijkstra on curved, stretched, dirty and multi-source problems.
#include <brushfire/core/error.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/distance.h>
#include <support/shared_meshes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace brushfire {
namespace {

constexpr std::array kMarchingMethods{Method::CarriedSource, Method::NovotniKlein, Method::NovotniKlein2002,
                                      Method::KimmelSethian, Method::Dijkstra};

DistanceField field_from(const Mesh& mesh, std::vector<Source> sources, Method method = Method::NovotniKlein,
                         Precision precision = Precision::Double) {
  DistanceOptions options;
  options.method = method;
  options.precision = precision;
  return distance(mesh, sources, options);
}

Source at_vertex(const Mesh& mesh, Index v, double offset = 0) { return {vertex_point(mesh, v), offset}; }

double mean_error(const std::vector<double>& distance, const std::vector<double>& truth) {
  double sum = 0;
  Index count = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (!(truth[v] > 0) || !std::isfinite(truth[v])) continue;
    sum += std::abs(distance[v] - truth[v]) / truth[v];
    ++count;
  }
  return sum / count;
}

bool is_stretched(const std::string& name) {
  return name.find("x10") != std::string::npos || name.find("shear") != std::string::npos;
}

// Vertices that are connected to `from` through faces, by flooding: what must be finite.
std::vector<bool> reachable(const Mesh& mesh, Index from) {
  std::vector<bool> seen(mesh.vertex_count(), false);
  std::vector<Index> stack{from};
  seen[from] = true;
  while (!stack.empty()) {
    const Index v = stack.back();
    stack.pop_back();
    for (const Index h : mesh.corners(v)) {
      for (const Index w : mesh.faces()[Mesh::face_of(h)]) {
        if (!seen[w]) seen[w] = true, stack.push_back(w);
      }
    }
  }
  return seen;
}

void expect_infinity_exactly_where_unreachable(const Mesh& mesh, Index source) {
  const std::vector<bool> seen = reachable(mesh, source);
  for (const Method method : kMarchingMethods) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
      const DistanceField field = field_from(mesh, {at_vertex(mesh, source)}, method, precision);
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        ASSERT_FALSE(std::isnan(field.distance[v])) << name_of(method) << ", vertex " << v;
        ASSERT_EQ(field.distance[v] < kInfinity, seen[v]) << name_of(method) << ", vertex " << v;
        ASSERT_EQ(field.source[v], seen[v] ? 0u : kNoIndex);
      }
      EXPECT_EQ(field.reached + field.unreachable, mesh.vertex_count());
    }
  }
}

TEST(FastMarching, NovotniKleinIsWithinHalfAPercentInTheMeanOfTheExactDistances) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const auto& [name, source] : test::shared_truths()) {
    if (is_stretched(name)) continue;
    const Mesh mesh = test::shared_mesh(name);
    const std::vector<double> truth = test::shared_truth(name, source);
    for (const Precision precision : {Precision::Double, Precision::Float}) {
      const DistanceField field = field_from(mesh, {at_vertex(mesh, source)}, Method::NovotniKlein, precision);
      EXPECT_LE(mean_error(field.distance, truth), 0.005) << name << "." << source;
    }
  }
}

TEST(FastMarching, TheUpdateAsPrintedIsMuchWorseThanTheCorrectedOneOnCurvedMeshes) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  const Mesh mesh = test::shared_mesh("stanford-bunny");
  const std::vector<double> truth = test::shared_truth("stanford-bunny", 0);
  const double corrected = mean_error(field_from(mesh, {at_vertex(mesh, 0)}).distance, truth);
  const double printed = mean_error(field_from(mesh, {at_vertex(mesh, 0)}, Method::NovotniKlein2002).distance, truth);
  const double planar = mean_error(field_from(mesh, {at_vertex(mesh, 0)}, Method::KimmelSethian).distance, truth);
  EXPECT_GT(printed, 0.03);
  EXPECT_LT(4 * corrected, planar);
}

TEST(FastMarching, NoVertexComesUpMoreThanThreeTimesInTheMeanOnAnyMesh) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const std::string& name : test::shared_mesh_names()) {
    const Mesh mesh = test::shared_mesh(name);
    for (const Method method : {Method::CarriedSource, Method::NovotniKlein, Method::KimmelSethian}) {
      for (const Index face : {0u, mesh.face_count() / 2}) {
        const DistanceField field = field_from(mesh, {at_vertex(mesh, mesh.faces()[face][0])}, method);
        EXPECT_LE(field.updates, 3u * mesh.vertex_count()) << name;
      }
    }
  }
}

TEST(FastMarching, InfinityExactlyWhereUnreachableOnEverySharedMesh) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  for (const std::string& name : test::shared_mesh_names()) {
    SCOPED_TRACE(name);
    const Mesh mesh = test::shared_mesh(name);
    expect_infinity_exactly_where_unreachable(mesh, mesh.faces()[0][0]);
  }
}

TEST(FastMarching, InfinityExactlyWhereUnreachableOnHandBuiltDirt) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0},  {0, 1, 0}, {0, -1, 0}, {0, 0, 1},   {2, 0, 0},
                            {3, 1, 0}, {3, -1, 0}, {9, 9, 9}, {1, 0, 0},  {0.5, 0, 0}, {5, 5, 5}};
  const std::map<std::string, std::vector<Face>> dirt{
      {"three faces on an edge", {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}},
      {"bow-tie", {{0, 1, 2}, {1, 6, 7}}},
      {"duplicate faces", {{0, 1, 2}, {0, 1, 2}, {1, 2, 0}}},
      {"opposite duplicate", {{0, 1, 2}, {0, 2, 1}}},
      {"flipped neighbour", {{0, 1, 2}, {0, 1, 3}}},
      {"repeated index conducts", {{0, 1, 2}, {1, 1, 5}, {5, 6, 7}}},
      {"repeated index at the other end", {{1, 5, 5}, {0, 1, 2}, {5, 6, 7}}},
      {"a face that is one point", {{0, 0, 0}, {0, 1, 2}}},
      {"needle: two corners at one place", {{0, 1, 2}, {1, 9, 2}, {9, 5, 2}}},
      {"cap: three corners on a line", {{0, 1, 10}, {0, 10, 2}, {10, 1, 2}}},
      {"all corners at one place", {{1, 9, 1}, {0, 1, 2}}},
      {"soup", {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}},
      {"two components", {{0, 1, 2}, {5, 6, 7}}},
  };
  for (const auto& [name, faces] : dirt) {
    SCOPED_TRACE(name);
    const Mesh mesh(p, faces);
    std::set<Index> used;
    for (const Face& t : faces) used.insert(t.begin(), t.end());
    for (const Index v : used) expect_infinity_exactly_where_unreachable(mesh, v);
  }
}

TEST(FastMarching, AFaceWithARepeatedIndexConductsAlongItsEdge) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {1, 1, 3}, {3, 4, 5}};
  const Mesh mesh(p, faces);
  for (const Method method : kMarchingMethods) {
    const DistanceField field = field_from(mesh, {at_vertex(mesh, 0)}, method);
    EXPECT_NEAR(field.distance[3], 3, 1e-14) << name_of(method);
    if (method == Method::NovotniKlein2002) continue;  // takes 3 and 5 for parts of one circle around nowhere
    EXPECT_NEAR(field.distance[4], 4, 1e-14) << name_of(method);
  }
}

// Not to the last digit: without coordinates there is another internal order, and with it another order of arrival.
TEST(FastMarching, MeshesFromLengthsGiveTheDistancesOfTheirCoordinatesWithinTheMethodsError) {
  const Mesh with = shapes::folded_sphere(3).mesh();
  std::vector<std::array<double, 3>> lengths;
  for (Index f = 0; f < with.face_count(); ++f) {
    lengths.push_back({with.lengths()[3 * f] * with.unit(), with.lengths()[3 * f + 1] * with.unit(),
                       with.lengths()[3 * f + 2] * with.unit()});
  }
  const Mesh without = Mesh::from_lengths(with.vertex_count(), with.faces(), lengths);
  const DistanceField a = field_from(with, {at_vertex(with, 5)}), b = field_from(without, {at_vertex(without, 5)});
  for (Index v = 0; v < with.vertex_count(); ++v) EXPECT_NEAR(b.distance[v], a.distance[v], 0.005 * a.distance[v]);
}

TEST(FastMarching, ScalingByPowersOfTwoScalesTheResultToTheBit) {
  const Shape shape = shapes::noise_terrain(30, 30);
  const Mesh mesh(shape.positions, shape.faces);
  for (const double scale : {0x1p-300, 0x1p-7, 0x1p9, 0x1p300}) {
    std::vector<Vec3> positions = shape.positions;
    for (Vec3& p : positions) p = scale * p;
    const Mesh scaled(positions, shape.faces);
    for (const Method method : kMarchingMethods) {
      for (const Precision precision : {Precision::Double, Precision::Float}) {
        const DistanceField a = field_from(mesh, {at_vertex(mesh, 77)}, method, precision);
        const DistanceField b = field_from(scaled, {at_vertex(scaled, 77)}, method, precision);
        for (Index v = 0; v < mesh.vertex_count(); ++v) ASSERT_EQ(b.distance[v], scale * a.distance[v]);
      }
    }
  }
}

TEST(FastMarching, FloatLanesTakeCoordinatesOfAnySizeAnywhere) {
  const Shape shape = shapes::torus(24, 16);
  const DistanceField expected = field_from(shape.mesh(), {at_vertex(shape.mesh(), 5)});
  for (const double scale : {1e-30, 3e-8, 7e11, 1e30, 1e-300, 1e297}) {
    Shape scaled = shape;
    for (Vec3& p : scaled.positions) p = scale * (p + Vec3{3, -5, 7});
    const Mesh mesh = scaled.mesh();
    const DistanceField field = field_from(mesh, {at_vertex(mesh, 5)}, Method::NovotniKlein, Precision::Float);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_NEAR(field.distance[v] / scale, expected.distance[v], 2e-4 * expected.distance[v]) << scale;
    }
  }
}

TEST(FastMarching, RigidMotionAndRenumberingStayWithinTheMethodsError) {
  const Shape shape = shapes::noise_terrain(40, 40);
  const Mesh mesh(shape.positions, shape.faces);
  const DistanceField original = field_from(mesh, {at_vertex(mesh, 3)});
  std::mt19937 random(11);
  std::vector<Index> rank(mesh.vertex_count());
  std::iota(rank.begin(), rank.end(), Index{0});
  std::shuffle(rank.begin(), rank.end(), random);
  std::vector<Vec3> positions(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = shape.positions[v];
    positions[rank[v]] = {0.6 * p.x - 0.8 * p.y + 3, 0.8 * p.x + 0.6 * p.y - 1, p.z + 2};
  }
  std::vector<Face> faces = shape.faces;
  for (Face& t : faces) t = {rank[t[1]], rank[t[2]], rank[t[0]]};
  std::shuffle(faces.begin(), faces.end(), random);
  const Mesh moved(positions, faces);
  const DistanceField field = field_from(moved, {at_vertex(moved, rank[3])});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_NEAR(field.distance[rank[v]], original.distance[v], 0.005 * original.distance[v]) << v;
  }
}

TEST(FastMarching, SeveralSourcesGiveTheMinimumOfSingleOnesWithinTheMethodsError) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  const std::vector<Index> vertices{0, 100, 900, 2000};
  std::vector<Source> sources;
  std::vector<DistanceField> singles;
  for (const Index v : vertices) {
    sources.push_back(at_vertex(mesh, v));
    singles.push_back(field_from(mesh, {sources.back()}));
  }
  const DistanceField all = field_from(mesh, sources);
  double sum = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    double least = kInfinity;
    for (const DistanceField& f : singles) least = std::min(least, f.distance[v]);
    if (least > 0) sum += std::abs(all.distance[v] - least) / least;
    ASSERT_NEAR(all.distance[v], least, 0.12 * least) << v;
    ASSERT_LT(all.source[v], vertices.size());
  }
  EXPECT_LE(sum / mesh.vertex_count(), 0.01);
}

TEST(FastMarching, AnOffsetIsAddedToTheWholeFieldOfOneSource) {
  const Mesh mesh = shapes::icosphere(3).mesh();
  for (const Method method : kMarchingMethods) {
    const DistanceField plain = field_from(mesh, {at_vertex(mesh, 0)}, method);
    const DistanceField shifted = field_from(mesh, {at_vertex(mesh, 0, -2.5)}, method);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_NEAR(shifted.distance[v], plain.distance[v] - 2.5, 1e-14) << name_of(method);
    }
  }
}

TEST(FastMarching, ADominatedSourceReadsLessThanItsOffsetAndEqualOnesGoToTheLowest) {
  const Mesh mesh = shapes::plane(20, 20).mesh();
  const DistanceField field =
      field_from(mesh, {at_vertex(mesh, 0), at_vertex(mesh, 1, 10), at_vertex(mesh, 0), at_vertex(mesh, 440)});
  EXPECT_NEAR(field.distance[1], 0.05, 1e-15);
  EXPECT_EQ(field.source[1], 0u);
  EXPECT_EQ(field.source[0], 0u);
  EXPECT_EQ(field.source[440], 3u);
  EXPECT_EQ(std::count(field.source.begin(), field.source.end(), 2u), 0);
}

TEST(FastMarching, MaxDistanceCutsWithoutChangingWhatIsInside) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  for (const Method method : kMarchingMethods) {
    const DistanceField whole = field_from(mesh, {at_vertex(mesh, 9)}, method);
    DistanceOptions options;
    options.method = method;
    options.precision = Precision::Double;
    options.max_distance = 0.7;
    const Source source = at_vertex(mesh, 9);
    const DistanceField cut = distance(mesh, {&source, 1}, options);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_EQ(cut.distance[v], whole.distance[v] <= 0.7 ? whole.distance[v] : kInfinity) << name_of(method);
    }
    EXPECT_EQ(cut.reached + cut.beyond_radius + cut.unreachable, mesh.vertex_count());
  }
}

TEST(FastMarching, TargetsReadTheSameValueAsInAFullRun) {
  const Mesh mesh = shapes::folded_sphere(4).mesh();
  for (const Method method : kMarchingMethods) {
    const DistanceField whole = field_from(mesh, {at_vertex(mesh, 9)}, method);
    DistanceOptions options;
    options.method = method;
    options.precision = Precision::Double;
    for (const Index v : {10u, 300u, 1500u}) options.targets.push_back(vertex_point(mesh, v));
    const Source source = at_vertex(mesh, 9);
    const DistanceField field = distance(mesh, {&source, 1}, options);
    EXPECT_EQ(field.target_distance,
              (std::vector<double>{whole.distance[10], whole.distance[300], whole.distance[1500]}));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (field.distance[v] < kInfinity) {
        ASSERT_EQ(field.distance[v], whole.distance[v]);
      }
    }
  }
}

TEST(FastMarching, ASetTokenCancels) {
  const Mesh mesh = shapes::icosphere(4).mesh();
  CancelToken token;
  token.cancel();
  for (const Method method :
       {Method::CarriedSource, Method::NovotniKlein, Method::NovotniKlein2002, Method::KimmelSethian}) {
    DistanceOptions options;
    options.method = method;
    options.cancel = &token;
    const Source source = at_vertex(mesh, 0);
    EXPECT_THROW(distance(mesh, {&source, 1}, options), Error);
  }
}

TEST(FastMarching, ProgressGrowsFromZeroToOne) {
  const Mesh mesh = shapes::icosphere(5).mesh();
  std::vector<double> shares;
  DistanceOptions options;
  options.method = Method::NovotniKlein;
  options.progress = [&](double share) { shares.push_back(share); };
  const Source source = at_vertex(mesh, 0);
  distance(mesh, {&source, 1}, options);
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GE(shares.front(), 0);
  EXPECT_LE(shares.back(), 1);
}

TEST(FastMarching, FloatLanesAgreeWithDoubleOnesOnScans) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  const Mesh mesh = test::shared_mesh("stanford-bunny");
  const DistanceField a = field_from(mesh, {at_vertex(mesh, 0)}, Method::NovotniKlein, Precision::Double);
  const DistanceField b = field_from(mesh, {at_vertex(mesh, 0)}, Method::NovotniKlein, Precision::Float);
  EXPECT_LE(mean_error(b.distance, a.distance), 5e-4);  // rounding decides ties between fronts, which meet anywhere
}

}  // namespace
}  // namespace brushfire
