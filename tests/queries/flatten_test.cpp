// Flattening: what unrolls is laid flat exactly; seams make discs.
#include <brushfire/queries/flatten.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/boundaries.h>
#include <brushfire/mesh/report.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brushfire {
namespace {

FlattenOptions exactly(Index landmarks) {
  FlattenOptions options;
  options.landmarks = landmarks;
  options.distance.method = Method::Exact;
  return options;
}

void expect_isometric(const Flattening& flat) {
  EXPECT_LT(flat.distortion.stress, 1e-6);
  EXPECT_NEAR(flat.distortion.max_stretch, 1, 1e-6);
  EXPECT_NEAR(flat.distortion.min_stretch, 1, 1e-6);
  EXPECT_NEAR(flat.distortion.angle, 1, 1e-6);
  EXPECT_EQ(flat.distortion.flipped, 0u);
}

TEST(Flatten, LaysACutCylinderFlat) { expect_isometric(flatten(shapes::cylinder(6, 20, 1, 3).mesh(), exactly(12))); }

TEST(Flatten, LaysASteepConeFlatThatIsCutFromItsApex) {
  const Mesh cone = shapes::cone(6, 24, 1, 4).mesh();
  Barriers seam;
  for (Index ring = 0; ring < 6; ++ring) seam.edges.push_back({ring == 0 ? 0 : 24 * ring - 23, 24 * ring + 1});
  expect_isometric(flatten(Domain(cone, seam), exactly(20)));
}

TEST(Flatten, LaysARolledSheetFlat) {
  Shape sheet = shapes::plane(14, 9, 7, 4);
  for (Vec3& p : sheet.positions) p = {2 * std::sin(p.x / 2), p.y, 2 * std::cos(p.x / 2)};
  const Flattening flat = flatten(sheet.mesh(), exactly(8));
  expect_isometric(flat);
  EXPECT_EQ(flat.mesh.vertex_count(), sheet.positions.size());  // a disc has no seam
}

TEST(Flatten, LaysALineOnALine) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index i = 0; i < 9; ++i) positions.push_back({0.3 * i, 0.4 * i, 0});
  for (Index i = 2; i < 9; ++i) faces.push_back({0, i - 1, i});
  const Flattening flat = flatten(Mesh(positions, faces), exactly(9));
  EXPECT_LT(flat.distortion.stress, 1e-9);
  for (const std::array<double, 2>& uv : flat.uv) EXPECT_LT(std::abs(uv[1]), 1e-6);
}

TEST(Flatten, IsTheSameAtBothEndsOfTheRangeOfNumbers) {
  const Shape shape = shapes::saddle(4);
  const Flattening plain = flatten(shape.mesh(), exactly(12));
  for (const double size : {0x1p-985, 0x1p985}) {
    Shape scaled = shape;
    for (Vec3& p : scaled.positions) p = size * p;
    const Flattening flat = flatten(scaled.mesh(), exactly(12));
    EXPECT_EQ(flat.distortion.stress, plain.distortion.stress);
    EXPECT_EQ(flat.distortion.max_stretch, plain.distortion.max_stretch);
    for (Index v = 0; v < plain.uv.size(); ++v) {
      EXPECT_EQ(flat.uv[v][0], size * plain.uv[v][0]);
      EXPECT_EQ(flat.uv[v][1], size * plain.uv[v][1]);
    }
  }
}

TEST(Flatten, ReportsWhatASphereDoesToLengths) {
  const Flattening flat = flatten(shapes::icosphere(3).mesh(), exactly(60));
  EXPECT_GT(flat.distortion.stress, 0.02);
  EXPECT_LT(flat.distortion.stress, 0.5);
  EXPECT_GT(flat.distortion.max_stretch, 1);
  EXPECT_LT(flat.distortion.min_stretch, 1);
}

// Euler's characteristic and the number of rims after cutting.
void expect_disc(const Mesh& mesh, Index base) {
  const CutMesh open = cut(mesh, Barriers{{}, {}, cut_to_disc(mesh, base)});
  EXPECT_EQ(open.mesh.report().components, 1u);
  EXPECT_EQ(open.mesh.report().euler_characteristic, 1);
  EXPECT_EQ(boundaries(open.mesh).size(), 1u);
}

TEST(CutToDisc, OpensSpheresHandlesAndHoles) {
  expect_disc(shapes::icosphere(2).mesh(), 7);
  expect_disc(shapes::torus(16, 9).mesh(), 5);
  expect_disc(shapes::cylinder(4, 9).mesh(), 3);
  expect_disc(shapes::cylinder(4, 9).mesh(), 22);  // from the middle
  expect_disc(shapes::plane(5, 4).mesh(), 12);
  // A torus with two holes.
  const Mesh torus = shapes::torus(20, 12).mesh();
  std::vector<Index> kept;
  for (Index f = 0; f < torus.face_count(); ++f) {
    if (f != 10 && f != 200) kept.push_back(f);
  }
  expect_disc(torus.with_faces(kept), 77);
  EXPECT_TRUE(cut_to_disc(shapes::plane(5, 4).mesh(), 12).empty());
}

TEST(Flatten, RefusesPiecesAndTooFewLandmarks) {
  Shape two = shapes::plane(1, 1);
  const auto n = static_cast<Index>(two.positions.size());
  for (Index v = 0; v < n; ++v) two.positions.push_back(two.positions[v] + Vec3{5, 0, 0});
  for (std::size_t f = 0; f < 2; ++f) {
    const Face t = two.faces[f];
    two.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  EXPECT_THROW(flatten(two.mesh(), exactly(4)), Error);
  EXPECT_THROW(flatten(shapes::plane(2, 2).mesh(), exactly(2)), Error);
}

}  // namespace
}  // namespace brushfire
