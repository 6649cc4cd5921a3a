// Ambient occlusion: shares of the sky that are known by geometry, both sides, the same bits for any number of threads.
#include <brushfire/core/error.h>
#include <brushfire/figure/ambient_occlusion.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

class AmbientOcclusion : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_ambient_occlusion()) GTEST_SKIP() << "built without Embree";
  }
};

// A floor (z = 0, x >= 0) and a wall (x = 0, z >= 0) that meet at the origin, vertex 0, both far larger than 1. The
// floor's front is its upper side, the wall's the one that looks to the floor.
Mesh corner_of_a_room() {
  constexpr double kFar = 1000;
  const std::vector<Vec3> positions{{0, 0, 0},       {0, -kFar, 0},    {0, kFar, 0},   {kFar, -kFar, 0},
                                    {kFar, kFar, 0}, {0, -kFar, kFar}, {0, kFar, kFar}};
  const std::vector<Face> faces{{0, 1, 3}, {0, 3, 4}, {0, 4, 2}, {0, 5, 1}, {0, 6, 5}, {0, 2, 6}};
  return Mesh(positions, faces);
}

TEST_F(AmbientOcclusion, PlaneSeesAllOfTheSkyOnBothSides) {
  for (const auto& open : ambient_occlusion(shapes::plane(4, 4).mesh())) {
    EXPECT_EQ(open[0], 1);
    EXPECT_EQ(open[1], 1);
  }
}

TEST_F(AmbientOcclusion, SphereIsOpenOutsideAndDarkInside) {
  const Mesh sphere = shapes::icosphere(3).mesh();
  for (const auto& open : ambient_occlusion(sphere)) {
    EXPECT_GT(open[0], 0.98);
    EXPECT_LT(open[1], 0.05);
  }
}

TEST_F(AmbientOcclusion, HalfOfTheSkyIsSeenWhereAFloorMeetsAWall) {
  AmbientOcclusionOptions options;
  options.directions = 4096;
  const Mesh room = corner_of_a_room();
  const auto open = ambient_occlusion(room, options);
  for (const Index h : room.corners(0)) {
    EXPECT_NEAR(open[h][0], 0.5, 0.01) << "corner " << h;
    EXPECT_GT(open[h][1], 0.95) << "corner " << h;  // outside: nothing in the way but grazing rays along the other
  }
}

// A sheet folded up and down, seen from above: ridges at even, crevices at odd x. Vertex 3 x + 1 is the fold's middle.
Mesh folded_sheet(Index folds) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index i = 0; i < folds; ++i) {
    for (const double y : {-20.0, 0.0, 20.0}) positions.push_back({static_cast<double>(i), y, i % 2 == 0 ? 2.0 : 0.0});
    for (Index j = 3 * i; i + 1 < folds && j < 3 * i + 2; ++j) {
      faces.push_back({j, j + 3, j + 4});
      faces.push_back({j, j + 4, j + 1});
    }
  }
  return Mesh(positions, faces);
}

TEST_F(AmbientOcclusion, CreviceIsDarkerThanRidgeByWhatGeometrySays) {
  constexpr Index kFolds = 9;
  const Mesh sheet = folded_sheet(kFolds);
  AmbientOcclusionOptions options;
  options.directions = 2048;
  const auto open = ambient_occlusion(sheet, options);
  for (Index fold = 2; fold + 2 < kFolds; ++fold) {
    // The back of the sheet has its ridges where the front has its crevices.
    const std::size_t dark = fold % 2 == 0 ? 1 : 0;
    for (const Index h : sheet.corners(3 * fold + 1)) {
      // What an endless fold of flanks twice as high as wide sees: its own wedge, and all that is above the ridges.
      const double wedge = 2 * std::atan(0.5), slope = std::atan(2);
      EXPECT_NEAR(open[h][dark], (1 - std::cos(wedge)) / 2, 0.02) << "fold " << fold;
      EXPECT_NEAR(open[h][1 - dark], (1 + std::cos(slope)) / 2, 0.02) << "fold " << fold;
    }
  }
}

TEST_F(AmbientOcclusion, WhatIsOutOfReachCastsNoShade) {
  AmbientOcclusionOptions options;
  const Mesh sphere = shapes::icosphere(3).mesh();
  options.reach = 0.01;  // of a ball of radius 1: nothing but the flattest rays ends that near
  for (const auto& open : ambient_occlusion(sphere, options)) EXPECT_GT(open[1], 0.95);
}

TEST_F(AmbientOcclusion, SameBitsForAnyNumberOfThreadsAndAnyScale) {
  const auto torus = shapes::torus(40, 20);
  AmbientOcclusionOptions options;
  options.directions = 100;
  options.threads = 1;
  const auto one = ambient_occlusion(torus.mesh(), options);
  options.threads = 3;
  EXPECT_EQ(ambient_occlusion(torus.mesh(), options), one);
  EXPECT_EQ(ambient_occlusion(torus.mesh(), options), one);
  for (const double scale : {0x1p-300, 0x1p300}) {
    std::vector<Vec3> positions(torus.positions.begin(), torus.positions.end());
    for (Vec3& p : positions) p = scale * p;
    EXPECT_EQ(ambient_occlusion(Mesh(positions, torus.faces), options), one) << scale;
  }
}

TEST_F(AmbientOcclusion, DegenerateMeshesAreAccepted) {
  EXPECT_TRUE(ambient_occlusion(Mesh()).empty());
  const std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {5, 5, 5}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 0, 1}};
  for (const auto& open : ambient_occlusion(Mesh(positions, faces))) {
    EXPECT_GE(open[0], 0);
    EXPECT_LE(open[0], 1);
  }
}

TEST_F(AmbientOcclusion, BadRequestsAndCancellingAreErrors) {
  const Mesh sphere = shapes::icosphere(2).mesh();
  AmbientOcclusionOptions options;
  options.directions = 7;
  EXPECT_THROW(ambient_occlusion(sphere, options), Error);
  options = {};
  options.reach = 0;
  EXPECT_THROW(ambient_occlusion(sphere, options), Error);
  const std::vector<Face> faces{{0, 1, 2}};
  const std::vector<std::array<double, 3>> lengths{{1, 1, 1}};
  EXPECT_THROW(ambient_occlusion(Mesh::from_lengths(3, faces, lengths)), Error);
  CancelToken cancel;
  cancel.cancel();
  options = {};
  options.cancel = &cancel;
  EXPECT_THROW(ambient_occlusion(sphere, options), Error);
}

TEST(AmbientOcclusionWithoutEmbree, SaysWhatToInstall) {
  if (has_ambient_occlusion()) GTEST_SKIP() << "built with Embree";
  try {
    ambient_occlusion(shapes::plane(2, 2).mesh());
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
    EXPECT_NE(std::string(e.what()).find("libembree-dev"), std::string::npos);
  }
}

}  // namespace
}  // namespace brushfire
