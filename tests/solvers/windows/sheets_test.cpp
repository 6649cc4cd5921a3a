// Faces that lie on each other: as quick as one, the same bits, and points inside of a copy are told apart.
#include "support/path_checker.h"
#include "support/shared_meshes.h"

#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/path.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/propagation/links.h>
#include <brushfire/solvers/windows/store/spines.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace brushfire {
namespace {

Mesh copies_of(const Mesh& mesh, int copies) {
  std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  for (int k = 1; k < copies; ++k) {
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Face& t = mesh.faces()[f];
      faces.push_back(k % 2 == 0 ? Face{t[1], t[2], t[0]} : Face{t[0], t[2], t[1]});
    }
  }
  return Mesh(mesh.positions(), faces);
}

DistanceField exact(const Mesh& mesh, const Source& source, DistanceOptions options = {}) {
  options.method = Method::Exact;
  return distance(mesh, std::span(&source, 1), options);
}
DistanceField exact(const Mesh& mesh, Index vertex) { return exact(mesh, Source{vertex_point(mesh, vertex)}); }

// An equilateral triangle, twice; the way from the middle of one to that of the other is over the middle of an edge.
Mesh two_sided_triangle() {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  const std::vector<Face> faces{{0, 1, 2}, {2, 1, 0}, {0, 1, 2}};
  return Mesh(positions, faces);
}
constexpr std::array<double, 3> kMiddle{1.0 / 3, 1.0 / 3, 1.0 / 3};
const double kOverAnEdge = 2 * std::sqrt(3.0) / 6;

TEST(SheetCopies, HaveTheBitsOfOneAndCostNoMore) {
  for (const Index sides : {8u, 16u, 24u, 32u, 48u, 100u}) {
    const Mesh prism = shapes::cylinder(1, sides, 1, 10).mesh();
    const DistanceField single = exact(prism, 0);
    for (const int copies : {2, 3, 7}) {
      const DistanceField field = exact(copies_of(prism, copies), 0);
      EXPECT_EQ(field.distance, single.distance) << sides;
      EXPECT_EQ(field.source, single.source) << sides;
      EXPECT_EQ(field.error_bound, single.error_bound) << sides;
      EXPECT_EQ(field.updates, single.updates) << sides;
    }
  }
}

Mesh in_cases(const char* name) { return read_mesh((test::shared_directory() / "cases" / name).string()).mesh; }

TEST(SheetCopies, OfTheSharedCaseAndOfAScanAreTheSingleOne) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  const DistanceField prism = exact(in_cases("01-doubled-prism.obj"), 0);
  EXPECT_EQ(prism.distance, exact(in_cases("01-single-prism.obj"), 0).distance);
  EXPECT_NEAR(*std::max_element(prism.distance.begin(), prism.distance.end()), 10.481198390235813, 1e-12);
  const Mesh bunny = test::shared_mesh("stanford-bunny"), doubled = copies_of(bunny, 2);
  for (const Method method :
       {Method::Exact, Method::Windows, Method::CarriedSource, Method::NovotniKlein, Method::KimmelSethian}) {
    DistanceOptions options;
    options.method = method;
    const Source source{vertex_point(bunny, 0)};
    const DistanceField one = distance(bunny, std::span(&source, 1), options);
    const DistanceField two = distance(doubled, std::span(&source, 1), options);
    EXPECT_EQ(one.distance, two.distance);
    EXPECT_EQ(one.updates, two.updates);
  }
}

TEST(SheetCopies, OfTheSharedCaseHaveThePathThatOnceWasLost) {
  BRUSHFIRE_NEEDS_SHARED_DATA();
  const Mesh mesh = in_cases("19-path-lost-doubled-prism.obj");
  const SurfacePath path = PathFinder(mesh).between(vertex_point(mesh, 0), vertex_point(mesh, 30));
  EXPECT_NEAR(path.length, 10.478010151462053, 1e-12);
  EXPECT_EQ(test::judge(mesh, path), "");
}

// 8 vertices and 18 different faces, 944 in all.
TEST(SheetCopies, OfAFewFacesOfABoxAreThoseFaces) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 8; ++i) positions.push_back({1.0 * (i & 1), 2.0 * (i >> 1 & 1), 3.0 * (i >> 2)});
  std::vector<Face> faces{{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                          {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5},
                          {0, 3, 7}, {1, 2, 6}, {0, 7, 6}, {1, 4, 7}, {2, 5, 7}, {3, 4, 6}};
  const DistanceField few = exact(Mesh(positions, faces), 0);
  std::mt19937 random(1);
  while (faces.size() < 944) faces.push_back(faces[random() % 18]);
  const DistanceField many = exact(Mesh(positions, faces), 0);
  EXPECT_EQ(few.distance, many.distance);
  EXPECT_EQ(few.updates, many.updates);
}

TEST(SheetCopies, AreMetOverTheirEdgesByLightThatStartsInsideOfOne) {
  const Mesh mesh = two_sided_triangle();
  DistanceOptions options;
  options.targets = {{0, kMiddle}, {1, kMiddle}, {2, kMiddle}, {0, {0.2, 0.3, 0.5}}};
  for (const Index face : {0u, 1u, 2u}) {
    const DistanceField field = exact(mesh, {{face, kMiddle}}, options);
    for (Index other = 0; other < 3; ++other) {
      EXPECT_NEAR(field.target_distance[other], other == face ? 0 : kOverAnEdge, 1e-15) << face << ' ' << other;
    }
    for (const double d : field.distance) EXPECT_NEAR(d, 1 / std::sqrt(3.0), 1e-15);
  }
}

TEST(SheetCopies, HaveValuesAndPathsOfTheirOwnInside) {
  const Mesh mesh = two_sided_triangle();
  DistanceOptions options;
  options.keep_windows = true;
  const DistanceField field = exact(mesh, {{1, kMiddle}}, options);
  EXPECT_EQ(&field.windows->mesh().faces()[0], &mesh.faces()[0]);
  EXPECT_NEAR(field.windows->value({0, kMiddle}).distance, kOverAnEdge, 1e-15);
  EXPECT_NEAR(field.windows->value({1, {0.3, 0.3, 0.4}}).distance, 0.1 / 3 * 2 * std::sqrt(0.75), 1e-12);
  PathFinder finder(mesh);
  for (const Index from : {0u, 1u, 2u}) {
    for (const Index to : {0u, 1u, 2u}) {
      const SurfacePath path = finder.between({from, kMiddle}, {to, kMiddle});
      EXPECT_NEAR(path.length, from == to ? 0 : kOverAnEdge, 1e-15);
      EXPECT_EQ(path.points.front().face, from);
      EXPECT_EQ(path.points.back().face, to);
      EXPECT_EQ(test::judge(mesh, path), "");
    }
  }
}

TEST(SheetCopies, AreNamedInPathsAsTheyWereGiven) {
  const Mesh mesh = copies_of(shapes::plane(3, 3).mesh(), 2);
  const Index half = mesh.face_count() / 2;
  PathFinder finder(mesh);
  const SurfacePoint from{half + 1, {0.2, 0.3, 0.5}}, to{half + 14, {0.6, 0.3, 0.1}};
  const SurfacePath path = finder.between(from, to);
  EXPECT_NEAR(path.length, norm(position(mesh, to) - position(mesh, from)), 1e-14);
  EXPECT_EQ(path.points.front().face, from.face);
  EXPECT_EQ(path.points.back().face, to.face);
  EXPECT_EQ(path.points.back().weights, to.weights);
  EXPECT_EQ(test::judge(mesh, path), "");
}

TEST(SheetCopies, OfATargetAreNoTargets) {
  const Mesh mesh = copies_of(shapes::plane(2, 2).mesh(), 2);
  DistanceOptions options;
  options.keep_paths = true;
  options.targets = {{0, kMiddle}};
  const DistanceField field = exact(mesh, {vertex_point(mesh, 8)}, options);
  EXPECT_EQ(field.windows->value({0, kMiddle}).distance, field.target_distance[0]);
  EXPECT_THROW(field.windows->value({mesh.face_count() / 2, kMiddle}), Error);
}

// The copies of a slit edge are apart: round the corner, or not at all.
TEST(SheetCopies, BesideASlitHaveEdgesOfTheirOwn) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};
  const Mesh whole(positions, faces);
  const Mesh slit = whole.with_slits(std::array<Index, 1>{1});
  const SurfacePoint here{0, {0, 0.5, 0.5}}, there{1, {0, 0.5, 0.5}};
  DistanceOptions options;
  options.targets = {there, here};
  EXPECT_EQ(exact(whole, {here}, options).target_distance[0], 0);
  const DistanceField field = exact(slit, {here}, options);
  EXPECT_NEAR(field.target_distance[0], 1, 1e-15);
  EXPECT_EQ(field.target_distance[1], 0);
}

TEST(SheetCopies, KeepLabelsOffsetsRadiusAndSparseFields) {
  const Mesh one = shapes::noise_terrain(20, 20, 0.4).mesh(), two = copies_of(one, 2);
  const Index half = one.face_count();
  const std::vector<Source> sources{{vertex_point(one, 3), 0.1}, {{100, kMiddle}, 0.0}, {vertex_point(one, 3), 0.1}};
  std::vector<Source> on_copies = sources;
  on_copies[1].point.face += half;
  for (const double radius : {0.2, kInfinity}) {
    DistanceOptions options;
    options.max_distance = radius;
    const DistanceField single = distance(one, sources, options), field = distance(two, on_copies, options);
    EXPECT_EQ(single.source, field.source);
    EXPECT_EQ(single.reached, field.reached);
    for (Index v = 0; v < one.vertex_count(); ++v) {
      ASSERT_TRUE(single.distance[v] == field.distance[v] ||
                  std::abs(single.distance[v] - field.distance[v]) <= 1e-12 * single.distance[v]);
    }
    const SparseField sparse = DistanceSolver(two).distance_sparse(on_copies, options);
    EXPECT_EQ(sparse.vertex.size(), field.reached);
  }
}

// The other diagonal in each square of the second sheet: no face has a copy, every other edge has four faces.
Mesh two_triangulations(Index cells) {
  const Shape first = shapes::plane(cells, cells);
  std::vector<Face> faces = first.faces;
  for (std::size_t f = 0; f + 1 < first.faces.size(); f += 2) {
    // The two faces of a square share two vertices; the second sheet joins the other two.
    const Face &t = first.faces[f], &u = first.faces[f + 1];
    std::vector<Index> shared, other;
    for (const Index v : t) (std::find(u.begin(), u.end(), v) != u.end() ? shared : other).push_back(v);
    for (const Index v : u) {
      if (std::find(t.begin(), t.end(), v) == t.end()) other.push_back(v);
    }
    faces.push_back({other[0], other[1], shared[0]});
    faces.push_back({other[0], other[1], shared[1]});
  }
  return Mesh(first.positions, faces);
}

TEST(Sheets, OfTwoTriangulationsCarryTheirLightOnce) {
  for (const Index cells : {20u, 40u}) {
    const Mesh one = shapes::plane(cells, cells).mesh(), two = two_triangulations(cells);
    for (const Index source : {0u, cells + 2}) {
      const DistanceField single = exact(one, source), field = exact(two, source);
      for (Index v = 0; v < one.vertex_count(); ++v) {
        ASSERT_NEAR(field.distance[v], single.distance[v], 1e-12 * single.distance[v]) << cells << ' ' << v;
      }
      // Each sheet by itself, and light that is folded back dies at the next spine.
      EXPECT_LE(field.updates, 6 * single.updates) << cells;
    }
  }
}

namespace d = windows;

d::Window window(double b0, double b1, Vec2 source, double sigma) {
  d::Window w;
  w.b0 = b0, w.b1 = b1, w.source = source, w.sigma = sigma;
  w.d0 = value_at(w, b0), w.d1 = value_at(w, b1);
  return w;
}

TEST(SpineMemory, LetsEqualLightPassOnce) {
  d::SpineMemory memory;
  const d::Window first = window(0.2, 0.8, {0.4, -1}, 3);
  d::Window w = first;
  EXPECT_TRUE(memory.learn(1, 2, w, 0));
  w = first;
  EXPECT_FALSE(memory.learn(1, 2, w, 0));
  EXPECT_TRUE(memory.learn(1, 3, w, 0)) << "another edge";
  w = window(0.3, 0.6, {0.4, -1}, 4);
  EXPECT_FALSE(memory.learn(1, 2, w, 0)) << "longer";
  w = window(0.3, 0.6, {0.4, -1}, 2);
  EXPECT_TRUE(memory.learn(1, 2, w, 0)) << "shorter";
}

TEST(SpineMemory, TakesFromTheEndsWhatIsNowhereShorter) {
  d::SpineMemory memory;
  d::Window w = window(0, 0.5, {0.4, -1}, 3);
  EXPECT_TRUE(memory.learn(1, 2, w, 0));
  w = window(0.3, 1, {0.4, -1}, 3);
  EXPECT_TRUE(memory.learn(1, 2, w, 0));
  EXPECT_EQ(w.b0, 0.5);
  EXPECT_EQ(w.d0, value_at(w, 0.5));
  w = window(0.1, 0.9, {0.4, -1}, 3);
  EXPECT_FALSE(memory.learn(1, 2, w, 0)) << "two windows cover it";
}

TEST(SpineMemory, OfEqualLightKeepsTheLowestLabel) {
  d::SpineMemory memory;
  d::Window w = window(0, 1, {0.4, -1}, 3);
  EXPECT_TRUE(memory.learn(1, 2, w, 5));
  EXPECT_FALSE(memory.learn(1, 2, w, 7));
  EXPECT_TRUE(memory.learn(1, 2, w, 4));
  EXPECT_FALSE(memory.learn(1, 2, w, 5));
}

TEST(SpineMemory, LetsPassWhatIsShorterBetweenTheEnds) {
  d::SpineMemory memory;
  d::Window far = window(0, 2, {1, -3}, 0), near = window(0, 2, {1, -0.1}, 2.5);
  ASSERT_LT(far.d0, near.d0);
  EXPECT_TRUE(memory.learn(1, 2, far, 0));
  EXPECT_TRUE(memory.learn(1, 2, near, 0)) << "2.6 instead of 3 in the middle";
}

// Light in one fan at a bow-tie, over the middle of its first face: straight on in that fan, everywhere in the other.
TEST(LinkShadow, IsAllOfTheOtherFanAndNothingOfAFlatOne) {
  std::vector<Vec3> positions{{0, 0, 0}};
  std::vector<Face> faces;
  constexpr Index kCount = 8;
  for (const double height : {0.0, 1.0}) {
    const Index first = static_cast<Index>(positions.size());
    for (Index k = 0; k < kCount; ++k) {
      const double turn = 2 * kPi * k / kCount;
      positions.push_back({std::cos(turn), std::sin(turn), height});
      faces.push_back({0, first + k, first + (k + 1) % kCount});
    }
  }
  const d::WindowStructure structure(Mesh(positions, faces), 15);
  const Index v = structure.inner_vertex(0), h = structure.inner_halfedge(1);
  EXPECT_EQ(structure.vertex_type[v], d::VertexType::Fans);
  std::vector<Index> room;
  d::LinkShadow shadow;
  const double middle = 0.5 * structure.faces[h / 3].length[h % 3];
  const auto sectors = shadow(structure, structure.corners_of(v, room), {middle, h});
  EXPECT_EQ(sectors.size(), kCount);
  for (const d::Sector& s : sectors) {
    EXPECT_GE(structure.outer_face(s.face), kCount);
    EXPECT_TRUE(s.from_edge() && s.to_edge());
  }
}

// Three half planes and the opposite of one of them over one line: straight on is two ways, a shadow none.
TEST(LinkShadow, OfABookIsNothingWhereAllPagesAreFlat) {
  const std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
  std::vector<Face> faces;
  for (const Index page : {3u, 4u, 5u}) {
    faces.push_back({0, 1, page});
    faces.push_back({0, page, 2});
  }
  const d::WindowStructure structure(Mesh(positions, faces), 15);
  std::vector<Index> room;
  d::LinkShadow shadow;
  const Index h = structure.inner_halfedge(1);  // from vertex 1 to the first page
  const std::span<const Index> corners = structure.corners_of(structure.inner_vertex(0), room);
  for (const double place : {0.1, 0.5, 0.9}) {
    EXPECT_TRUE(shadow(structure, corners, {place * std::sqrt(2.0), h}).empty()) << place;
  }
}

}  // namespace
}  // namespace brushfire
