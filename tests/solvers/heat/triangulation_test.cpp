// The laws of intrinsic triangulations: flips and covers change no surface.
#include <brushfire/core/error.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/heat/operators.h>
#include <brushfire/solvers/heat/scales.h>
#include <brushfire/solvers/heat/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace brushfire {
namespace {

using heat::Cover;
using heat::Triangulation;

double area_of(const Triangulation& t) {
  double sum = 0;
  for (std::size_t f = 0; f < t.face_count(); ++f) sum += 0.5 * heat::lay_flat(t, f).double_area();
  return sum / t.sheets;
}

std::vector<double> angle_sums(const Triangulation& t) {
  std::vector<double> sums(t.vertex_count, 0.0);
  for (Index h = 0; h < t.tail.size(); ++h) {
    const double a = t.length[h], b = t.length[Mesh::previous(h)], c = t.length[Mesh::next(h)];
    sums[t.tail[h]] += std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
  }
  return sums;
}

void expect_glued(const Triangulation& t) {
  for (Index h = 0; h < t.tail.size(); ++h) {
    const Index o = t.twin[h];
    if (o == kNoIndex) {
      EXPECT_EQ(t.sheets, 1);
      continue;
    }
    ASSERT_NE(o, h);
    ASSERT_EQ(t.twin[o], h);
    ASSERT_EQ(t.tail[o], t.tail[Mesh::next(h)]);
    ASSERT_EQ(t.length[o], t.length[h]);
  }
}

double least_edge_weight(const Triangulation& t) {
  double least = 1;
  for (Index h = 0; h < t.tail.size(); ++h) {
    if (t.twin[h] == kNoIndex) continue;
    least = std::min(least, heat::half_cotangent(t, h) + heat::half_cotangent(t, t.twin[h]));
  }
  return least;
}

// Sheared, so that most diagonals are the wrong ones.
Mesh sheared(Shape shape, double shear) {
  for (Vec3& p : shape.positions) p.x += shear * p.y + 0.3 * shear * p.z;
  return shape.mesh();
}

TEST(IntrinsicTriangulation, FlipsMakeItDelaunayAndKeepAreaAnglesAndGluing) {
  for (const Mesh& mesh : {sheared(shapes::noise_terrain(20, 20, 0.4), 3), sheared(shapes::torus(30, 12), 2),
                           sheared(shapes::icosphere(3), 4), sheared(shapes::cone(6, 40, 0.2, 3), 2)}) {
    for (const Cover cover : {Cover::Single, Cover::Tufted}) {
      Triangulation t = heat::triangulation_of(mesh, cover);
      expect_glued(t);
      const double area = area_of(t);
      const std::vector<double> angles = angle_sums(t);
      EXPECT_GT(heat::flip_to_delaunay(t), 0u);
      expect_glued(t);
      EXPECT_GE(least_edge_weight(t), -heat::kFlipTolerance);
      EXPECT_NEAR(area_of(t), area, 1e-9 * area);
      const std::vector<double> after = angle_sums(t);
      for (Index v = 0; v < t.vertex_count; ++v) EXPECT_NEAR(after[v], angles[v], 1e-6);
    }
  }
}

TEST(IntrinsicTriangulation, InThePlaneItIsTheDelaunayTriangulationOfThePoints) {
  // A fan from one corner of a convex outline, whose Delaunay triangulation is another one.
  std::vector<Vec3> p;
  std::vector<Face> fan;
  std::vector<Vec2> flat;
  for (Index i = 0; i < 24; ++i) {
    const double angle = 2 * kPi * (i + 0.3 * std::sin(5.0 * i)) / 24;
    p.push_back({2.5 * std::cos(angle), std::sin(angle), 0});
    flat.push_back({p.back().x, p.back().y});
    if (i >= 2) fan.push_back({0, i - 1, i});
  }
  Triangulation t = heat::triangulation_of(Mesh(p, fan), Cover::Single);
  heat::flip_to_delaunay(t);
  std::set<std::pair<Index, Index>> edges, expected;
  for (Index h = 0; h < t.tail.size(); ++h) edges.insert(std::minmax(t.tail[h], t.tail[Mesh::next(h)]));
  for (const Face& f : delaunay(flat).faces) {
    for (int k = 0; k < 3; ++k) expected.insert(std::minmax(f[k], f[(k + 1) % 3]));
  }
  EXPECT_EQ(edges, expected);
}

TEST(IntrinsicTriangulation, MollificationLeavesSoundMeshesAloneAndGivesEveryOtherFaceAnArea) {
  const Mesh sound = shapes::icosphere(3).mesh();
  Triangulation t = heat::triangulation_of(sound, Cover::AsItIs);
  const std::vector<double> before = t.length;
  heat::mollify(t, detail::components_of(sound));
  EXPECT_EQ(t.length, before);

  const std::vector<Vec3> p{{0, 0, 0}, {1, 1, 0}, {1, 1, 0}, {4, 0, 0}, {2, 0, 0}};
  const Mesh bad(p, std::vector<Face>{{0, 1, 2}, {0, 4, 1}, {4, 3, 2}, {4, 2, 1}, {0, 3, 4}, {3, 3, 1}, {2, 2, 2}});
  Triangulation u = heat::triangulation_of(bad, Cover::AsItIs);
  EXPECT_EQ(u.sheets, 2);
  heat::mollify(u, detail::components_of(bad));
  for (std::size_t f = 0; f < u.face_count(); ++f) EXPECT_GT(heat::lay_flat(u, f).double_area(), 0);
  heat::flip_to_delaunay(u);
  expect_glued(u);
}

TEST(IntrinsicTriangulation, TheTuftedCoverOfAnythingIsClosed) {
  for (const Mesh& mesh : {shapes::book(5, 3, 4).mesh(), shapes::bow_tie(3, 6).mesh(), shapes::plane(4, 4).mesh()}) {
    Triangulation t = heat::triangulation_of(mesh, Cover::AsItIs);
    EXPECT_EQ(t.sheets, 2);
    EXPECT_EQ(t.face_count(), 2u * mesh.face_count());
    expect_glued(t);
    for (const Index o : t.twin) EXPECT_NE(o, kNoIndex);
  }
  EXPECT_EQ(heat::triangulation_of(shapes::torus(9, 9).mesh(), Cover::AsItIs).sheets, 1);
}

TEST(IntrinsicTriangulation, PagesAreGluedToTheNextOnesAroundTheSpine) {
  // Of a book the back of each page meets the front of the next one: the numbers of the faces say nothing.
  const Mesh mesh = shapes::book(5, 1, 1).mesh();
  const Triangulation t = heat::triangulation_of(mesh, Cover::AsItIs);
  const Index n = mesh.halfedge_count();
  const auto angle_of = [&](Index h) {  // of the page around z
    const Index f = (h < n ? h : h - n) / 3;
    Vec3 sum;
    for (const Index v : mesh.faces()[f]) sum = sum + mesh.positions()[v];
    return std::atan2(sum.y, sum.x);
  };
  int glued = 0;
  for (Index h = 0; h < t.tail.size(); ++h) {
    const Index a = t.tail[h], b = t.tail[Mesh::next(h)];
    if (a > 1 || b > 1) continue;  // the spine's vertices are 0 and 1
    const double step = std::remainder(angle_of(t.twin[h]) - angle_of(h), 2 * kPi);
    EXPECT_NEAR(std::abs(step), 2 * kPi / 5, 1e-9);
    ++glued;
  }
  EXPECT_EQ(glued, 10);
}

TEST(IntrinsicTriangulation, OnAClosedSurfaceBothCoversHaveTheSameMatrices) {
  const Mesh mesh = sheared(shapes::torus(20, 10), 1);
  std::vector<heat::Operators> both;
  for (const Cover cover : {Cover::Single, Cover::Tufted}) {
    Triangulation t = heat::triangulation_of(mesh, cover);
    heat::flip_to_delaunay(t);
    both.push_back(heat::operators_of(t));
  }
  ASSERT_EQ(both[0].pattern.row, both[1].pattern.row);
  for (std::size_t e = 0; e < both[0].laplacian.size(); ++e) {
    EXPECT_NEAR(both[0].laplacian[e], both[1].laplacian[e], 1e-9);
  }
  for (std::size_t v = 0; v < both[0].mass.size(); ++v) EXPECT_NEAR(both[0].mass[v], both[1].mass[v], 1e-9);
}

TEST(IntrinsicTriangulation, TheLaplacianTakesConstantsToZeroAndLinearFunctionsInThePlane) {
  const Mesh mesh = sheared(shapes::plane(9, 7), 1.5);
  Triangulation t = heat::triangulation_of(mesh, Cover::Single);
  heat::flip_to_delaunay(t);
  const heat::Operators o = heat::operators_of(t);
  std::vector<double> ones(mesh.vertex_count(), 0.0), x(mesh.vertex_count(), 0.0);
  for (int c = 0; c < o.pattern.columns(); ++c) {
    for (int e = o.pattern.start[c]; e < o.pattern.start[c + 1]; ++e) {
      const int r = o.pattern.row[e];
      ones[r] += o.laplacian[e];
      x[r] += o.laplacian[e] * mesh.positions()[c].x;
      if (r == c) continue;
      ones[c] += o.laplacian[e];
      x[c] += o.laplacian[e] * mesh.positions()[r].x;
    }
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_NEAR(ones[v], 0, 1e-12);
    const Index column = v % 10, row = v / 10;
    const bool inside = column > 0 && column < 9 && row > 0 && row < 7;
    EXPECT_NEAR(inside ? x[v] : 0, 0, 1e-9);
  }
}

TEST(IntrinsicTriangulation, ASingleCoverOfWhatIsNotOrientedIsRefusedWithThePlace) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  const auto fault = [&](const std::vector<Face>& faces) -> std::string {
    try {
      heat::triangulation_of(Mesh(p, faces), Cover::Single);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(fault({{0, 1, 2}, {2, 1, 3}}), "");
  EXPECT_TRUE(
      contains(fault({{0, 1, 2}, {2, 1, 3}, {1, 2, 4}}), "the edge between vertices 1 and 2 has more than two"));
  EXPECT_TRUE(
      contains(fault({{0, 1, 2}, {1, 2, 3}}), "faces 0 and 1 run the same way along the edge between vertices"));
  EXPECT_TRUE(contains(fault({{0, 1, 2}, {3, 3, 4}}), "face 1 has a vertex twice"));
}

}  // namespace
}  // namespace brushfire
