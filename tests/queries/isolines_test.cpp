// Isolines: convergence to circles, loop counts by Morse theory, and order where levels meet vertices.
#include <brushfire/core/detail/random.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/delaunay.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/queries/isolines.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

std::vector<double> values_at(const Mesh& mesh, const auto& function) {
  std::vector<double> values;
  for (const Vec3& p : mesh.positions()) values.push_back(function(p));
  return values;
}

// Every point has the level's value, consecutive ones share a face and are different.
void expect_well_formed(const Mesh& mesh, std::span<const double> values, std::span<const Isoline> lines) {
  for (const Isoline& l : lines) {
    const auto& points = l.line.points;
    ASSERT_GE(points.size(), 2u);
    double length = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const PointLocation a = locate(mesh, points[i]);
      ASSERT_NE(a.on, PointLocation::On::Interior);
      double value = 0, size = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = values[mesh.faces()[a.face][k]];
        value += a.weights[k] > 0 ? a.weights[k] * x : 0;
        size = std::max(size, a.weights[k] > 0 ? std::abs(x) : 0);
      }
      EXPECT_NEAR(value, l.level, 4e-12 * size);
      if (i + 1 == points.size() && !l.line.closed) break;
      const PointLocation b = locate(mesh, points[(i + 1) % points.size()]);
      const Index f = common_face(mesh, a, b, a.face);
      ASSERT_NE(f, kNoIndex);
      const double piece = distance_within(mesh, f, a, b);
      EXPECT_GT(piece, 0);
      length += piece * mesh.unit();
    }
    EXPECT_NEAR(l.line.length, length, 1e-13 * length);
  }
}

// Of a closed curve in the plane z = 0: positive where it runs counter-clockwise.
double enclosed_area(const Mesh& mesh, const SurfacePath& line) {
  double twice = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Vec3 a = position(mesh, line.points[i]), b = position(mesh, line.points[(i + 1) % line.points.size()]);
    twice += cross(a, b).z;
  }
  return 0.5 * twice;
}

struct Errors {
  double length, area;
};

Errors circle_errors(Index cells) {
  const Mesh mesh = shapes::plane(cells, cells, 2, 2).mesh();
  const Vec3 centre{1 + 0.31 / 32, 1 - 0.17 / 32, 0};
  const std::vector<double> values = values_at(mesh, [&](Vec3 p) { return norm(p - centre); });
  const double r = 0.7;
  const std::vector<Isoline> lines = isolines(mesh, values, std::vector<double>{r});
  EXPECT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].line.closed);
  expect_well_formed(mesh, values, lines);
  return {std::abs(lines[0].line.length - 2 * kPi * r), std::abs(enclosed_area(mesh, lines[0].line) - kPi * r * r)};
}

TEST(Isolines, LengthAndAreaConvergeToTheCircleOnThePlaneWithSecondOrder) {
  const Errors coarse = circle_errors(32), fine = circle_errors(128);
  EXPECT_LT(coarse.length, 2e-3 * 2 * kPi * 0.7);
  // A quarter of the edge length: a sixteenth of the error; 12 leaves room for where the vertices happen to lie.
  EXPECT_LT(fine.length, coarse.length / 12);
  EXPECT_LT(fine.area, coarse.area / 12);
}

TEST(Isolines, LengthAndAreaConvergeToTheCircleOnTheConeWithSecondOrder) {
  const auto errors = [](Index n) {
    const Mesh mesh = shapes::cone(n, 4 * n).mesh();
    double total_angle = 0;
    for (const Index h : mesh.corners(0)) total_angle += mesh.corner_angle(h);
    const Vec3 apex = mesh.positions()[0];
    // A source beside the apex would need a solver; from the apex the distance is straight.
    const std::vector<double> values = values_at(mesh, [&](Vec3 p) { return norm(p - apex); });
    const double r = 0.613;
    const std::vector<Isoline> lines = isolines(mesh, values, std::vector<double>{r});
    EXPECT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines[0].line.closed);
    expect_well_formed(mesh, values, lines);
    // Faces between two generators lie in one plane with the apex: the sector of each piece is a flat triangle.
    const auto& points = lines[0].line.points;
    double area = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 a = position(mesh, points[i]) - apex, b = position(mesh, points[(i + 1) % points.size()]) - apex;
      area += 0.5 * norm(cross(a, b));
    }
    return Errors{std::abs(lines[0].line.length - total_angle * r), std::abs(area - 0.5 * total_angle * r * r)};
  };
  const Errors coarse = errors(8), fine = errors(32);
  EXPECT_LT(coarse.length, 0.01);
  EXPECT_LT(coarse.area, 0.01);
  EXPECT_LT(fine.length, coarse.length / 12);
  EXPECT_LT(fine.area, coarse.area / 12);
}

TEST(Isolines, LoopsOfAHeightFunctionAreThoseOfMorseTheory) {
  const Mesh sphere = shapes::icosphere(4).mesh(), torus = shapes::torus(48, 24).mesh();
  const std::vector<double> on_sphere = values_at(sphere, [](Vec3 p) { return p.z + 0.3 * p.x; });
  const std::vector<double> levels{-1.2, -0.9, -0.3, 0.0, 0.5, 1.0, 1.2};
  std::vector<Index> loops(levels.size(), 0);
  std::vector<Isoline> lines = isolines(sphere, on_sphere, levels);
  expect_well_formed(sphere, on_sphere, lines);
  for (const Isoline& l : lines) {
    EXPECT_TRUE(l.line.closed);
    ++loops[l.level_index];
  }
  EXPECT_EQ(loops, (std::vector<Index>{0, 1, 1, 1, 1, 1, 0}));
  // The torus stands on its rim: minimum at -1.4, saddles at -0.6 and 0.6, maximum at 1.4.
  const std::vector<double> on_torus = values_at(torus, [](Vec3 p) { return p.x + 1e-3 * p.y; });
  const std::vector<double> torus_levels{-1.5, -1, -0.5, 0, 0.5, 1, 1.5};
  loops.assign(torus_levels.size(), 0);
  lines = isolines(torus, on_torus, torus_levels);
  expect_well_formed(torus, on_torus, lines);
  for (const Isoline& l : lines) {
    EXPECT_TRUE(l.line.closed);
    ++loops[l.level_index];
  }
  EXPECT_EQ(loops, (std::vector<Index>{0, 1, 2, 2, 2, 1, 0}));
}

TEST(Isolines, EveryCrossedFaceHasOnePieceWhateverTheField) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Mesh mesh = shapes::delaunay_disc(200, seed).mesh();
    const std::vector<double> values = values_at(mesh, [&](Vec3) { return random.uniform(); });
    const double level = 0.5;
    const std::vector<Isoline> lines = isolines(mesh, values, std::vector<double>{level});
    expect_well_formed(mesh, values, lines);
    std::size_t crossed = 0, pieces = 0;
    for (const Face& t : mesh.faces()) {
      const int above = (values[t[0]] >= level) + (values[t[1]] >= level) + (values[t[2]] >= level);
      crossed += above == 1 || above == 2;
    }
    for (const Isoline& l : lines) pieces += l.line.points.size() - (l.line.closed ? 0 : 1);
    EXPECT_EQ(pieces, crossed);
  }
}

TEST(Isolines, SmallerValuesLieOnTheLeft) {
  const Mesh mesh = shapes::plane(16, 16).mesh();
  const std::vector<double> bowl = values_at(mesh, [](Vec3 p) { return norm(p - Vec3{0.5, 0.5, 0}); });
  const std::vector<double> hill = values_at(mesh, [](Vec3 p) { return -norm(p - Vec3{0.5, 0.5, 0}); });
  EXPECT_GT(enclosed_area(mesh, isolines(mesh, bowl, std::vector<double>{0.3})[0].line), 0);
  EXPECT_LT(enclosed_area(mesh, isolines(mesh, hill, std::vector<double>{-0.3})[0].line), 0);
  const std::vector<double> ramp = values_at(mesh, [](Vec3 p) { return p.x; });
  const std::vector<Isoline> across = isolines(mesh, ramp, std::vector<double>{0.33});
  ASSERT_EQ(across.size(), 1u);
  EXPECT_FALSE(across[0].line.closed);
  EXPECT_EQ(position(mesh, across[0].line.points.front()).y, 0);
  EXPECT_EQ(position(mesh, across[0].line.points.back()).y, 1);
}

TEST(Isolines, LevelsThroughVerticesGiveCleanCurves) {
  // Whole-numbered values on a regular grid: every level meets vertices, edges and flat faces.
  const Mesh mesh = shapes::plane(10, 10, 10, 10).mesh();
  const auto manhattan = [](Vec3 p) { return std::abs(p.x - 5) + std::abs(p.y - 5); };
  const auto chessboard = [](Vec3 p) { return std::max(std::abs(p.x - 5), std::abs(p.y - 5)); };
  const auto steps = [](Vec3 p) { return std::floor(p.x / 3); };
  for (const std::vector<double>& values :
       {values_at(mesh, manhattan), values_at(mesh, chessboard), values_at(mesh, steps)}) {
    const std::vector<double> levels{1, 2, 3, 4};
    const std::vector<Isoline> lines = isolines(mesh, values, levels);
    EXPECT_EQ(lines.size(), 4u - (values[0] == 0));  // `steps` ends at 3
    expect_well_formed(mesh, values, lines);
  }
  const std::vector<double> values = values_at(mesh, chessboard);
  const std::vector<Isoline> square = isolines(mesh, values, std::vector<double>{3});
  // A square of side 6; at two of its corners a whole face has the level's value, and the curve passes below it.
  EXPECT_DOUBLE_EQ(square[0].line.length, 20 + 2 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(enclosed_area(mesh, square[0].line), 35);
}

TEST(Isolines, PeaksAndRidgesExactlyAtTheLevelGiveNoCurve) {
  const Mesh mesh = shapes::plane(8, 8, 8, 8).mesh();
  const std::vector<double> peak = values_at(mesh, [](Vec3 p) { return -norm(p - Vec3{4, 4, 0}); });
  EXPECT_TRUE(isolines(mesh, peak, std::vector<double>{0}).empty());
  const std::vector<double> ridge = values_at(mesh, [](Vec3 p) { return p.x == 4 && p.y > 1 && p.y < 7 ? 0.0 : -1.0; });
  EXPECT_TRUE(isolines(mesh, ridge, std::vector<double>{0}).empty());
  const std::vector<double> wall = values_at(mesh, [](Vec3 p) { return p.x == 4 ? 0.0 : -1.0; });
  const std::vector<Isoline> lines = isolines(mesh, wall, std::vector<double>{0});
  EXPECT_EQ(lines.size(), 2u);  // from border to border on both sides, along the same vertices
  expect_well_formed(mesh, wall, lines);
  // A valley exactly at the level has curves on neither side: the vertex counts as above.
  const std::vector<double> pit = values_at(mesh, [](Vec3 p) { return norm(p - Vec3{4, 4, 0}); });
  EXPECT_TRUE(isolines(mesh, pit, std::vector<double>{0}).empty());
}

TEST(Isolines, CurvesEndWhereVerticesAreNotReached) {
  const Mesh mesh = shapes::plane(8, 8).mesh();
  const std::vector<double> values = values_at(mesh, [](Vec3 p) { return p.y > 0.6 ? kInfinity : p.x; });
  const std::vector<Isoline> lines = isolines(mesh, values, std::vector<double>{0.4, 2});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_FALSE(lines[0].line.closed);
  EXPECT_DOUBLE_EQ(lines[0].line.length, 0.5);
  const std::vector<double> nowhere(mesh.vertex_count(), kInfinity);
  EXPECT_TRUE(isolines(mesh, nowhere, std::vector<double>{1}).empty());
}

TEST(Isolines, OnABookEachPageHasItsOwnCurve) {
  const Mesh mesh = shapes::book(3, 4, 4).mesh();
  const std::vector<double> values = values_at(mesh, [](Vec3 p) { return p.z; });
  const std::vector<Isoline> lines = isolines(mesh, values, std::vector<double>{0.3});
  EXPECT_EQ(lines.size(), 3u);
  expect_well_formed(mesh, values, lines);
  for (const Isoline& l : lines) EXPECT_NEAR(l.line.length, 1, 1e-15);
}

TEST(Isolines, OrientationOfFacesDoesNotBreakCurves) {
  Shape s = shapes::icosphere(3);
  Random random(4);
  for (Face& t : s.faces) {
    if (random.below(2) == 0) std::swap(t[1], t[2]);
  }
  const Mesh mesh = s.mesh();
  const std::vector<double> values = values_at(mesh, [](Vec3 p) { return p.z; });
  const std::vector<Isoline> lines = isolines(mesh, values, std::vector<double>{0.1, -0.7});
  ASSERT_EQ(lines.size(), 2u);
  for (const Isoline& l : lines) EXPECT_TRUE(l.line.closed);
  expect_well_formed(mesh, values, lines);
}

TEST(Isolines, LevelsKeepTheCallersOrderAndMayRepeat) {
  const Mesh mesh = shapes::icosphere(2).mesh();
  const std::vector<double> values = values_at(mesh, [](Vec3 p) { return p.z; });
  const std::vector<Isoline> lines = isolines(mesh, values, std::vector<double>{0.5, -0.5, 0.5, 9});
  ASSERT_EQ(lines.size(), 3u);
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(lines[i].level_index, i);
  EXPECT_EQ(lines[0].line.length, lines[2].line.length);
}

TEST(Isolines, LevelListsCoverTheRange) {
  const std::vector<double> values{0, 0.5, 2.2, kInfinity};
  EXPECT_EQ(levels_every(values, 0.5), (std::vector<double>{0.5, 1, 1.5, 2}));
  EXPECT_EQ(levels_between(values, 1), (std::vector<double>{1.1}));
  EXPECT_EQ(levels_between(values, 10).size(), 10u);
  EXPECT_TRUE(levels_between(std::vector<double>{1, 1}, 4).empty());
  EXPECT_TRUE(levels_every(std::vector<double>{kInfinity}, 1).empty());
  EXPECT_THROW(levels_every(values, 0), Error);
  EXPECT_THROW(levels_every(values, 1e-9), Error);
}

TEST(Isolines, BadValuesAndLevelsAreErrors) {
  const Mesh mesh = shapes::plane(1, 1).mesh();
  const std::vector<double> values{0, 1, 1, 2}, nan{0, 1, std::nan(""), 2}, few{0, 1};
  EXPECT_THROW(isolines(mesh, nan, std::vector<double>{0.5}), Error);
  EXPECT_THROW(isolines(mesh, few, std::vector<double>{0.5}), Error);
  EXPECT_THROW(isolines(mesh, values, std::vector<double>{kInfinity}), Error);
  EXPECT_TRUE(isolines(mesh, values, {}).empty());
}

}  // namespace
}  // namespace brushfire
