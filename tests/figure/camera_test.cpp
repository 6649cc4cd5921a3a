// Cameras: where named views look from, and that what is shown fits.
#include <brushfire/core/error.h>
#include <brushfire/figure/detail/projection.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace brushfire {
namespace {

using detail::Projection;

const std::vector<Vec3> kAxes{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

TEST(Camera, FrontViewShowsThePlaneAsOnPaper) {
  const Projection p(named_view("front"), kAxes, 0, 0, 100, 100);
  EXPECT_GT(p({1, 0, 0}).x, p({-1, 0, 0}).x);
  EXPECT_LT(p({0, 1, 0}).y, p({0, -1, 0}).y);  // rows count from the top
  EXPECT_GT(p({0, 0, 1}).depth, p({0, 0, -1}).depth);
}

TEST(Camera, TopViewWithZUpLooksDownTheZAxisWithYUpwards) {
  Camera camera;
  camera.up = Axis::Z;
  const Projection p(named_view("top", camera), kAxes, 0, 0, 100, 100);
  EXPECT_GT(p({0, 0, 1}).depth, p({0, 0, -1}).depth);
  EXPECT_GT(p({1, 0, 0}).x, p({-1, 0, 0}).x);
  EXPECT_LT(p({0, 1, 0}).y, p({0, -1, 0}).y);
}

TEST(Camera, TurnedToADirectionSeesThatSideWithUpUpwards) {
  for (const Axis up : {Axis::X, Axis::Y, Axis::Z}) {
    for (const Vec3& d : kAxes) {
      for (const Vec3& e : kAxes) {
        const Vec3 outward = d + 0.5 * e;
        Camera camera;
        camera.up = up;
        camera = turned_to(outward, camera);
        const Projection p(camera, kAxes, 0, 0, 100, 100);
        const double upwards = up == Axis::X ? outward.x : up == Axis::Y ? outward.y : outward.z;
        // From straight below nothing is seen that is not seen from its side.
        if (upwards > -0.9 * norm(outward)) {
          EXPECT_GT(p(outward).depth, p({}).depth);
        }
        const Vec3 top{up == Axis::X ? 1.0 : 0, up == Axis::Y ? 1.0 : 0, up == Axis::Z ? 1.0 : 0};
        EXPECT_LT(p(top).y, p(-1.0 * top).y);
      }
    }
  }
  EXPECT_EQ(turned_to({}).azimuth, Camera{}.azimuth);
}

TEST(Camera, OppositeViewsSeeOppositeSides) {
  for (const auto& [one, other] : {std::pair{"front", "back"}, {"left", "right"}, {"top", "bottom"}}) {
    const Projection a(named_view(one), kAxes, 0, 0, 100, 100), b(named_view(other), kAxes, 0, 0, 100, 100);
    for (const Vec3& v : kAxes) EXPECT_NEAR(a(v).depth, -b(v).depth, 1e-12) << one;
  }
}

TEST(Camera, EveryPointFitsItsRectangleWhateverTheScaleAndTheView) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    Shape shape = shapes::torus(24, 12);
    for (Vec3& v : shape.positions) v = scale * v + Vec3{3 * scale, -7 * scale, scale};
    for (const bool perspective : {false, true}) {
      for (const double azimuth : {0.0, 33.0, 90.0, 217.0}) {
        Camera camera;
        camera.azimuth = azimuth;
        camera.elevation = azimuth / 3 - 40;
        camera.perspective = perspective;
        const Projection p(camera, shape.positions, 10, 20, 300, 200);
        double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
        for (const Vec3& v : shape.positions) {
          const auto s = p(v);
          left = std::min(left, s.x);
          right = std::max(right, s.x);
          top = std::min(top, s.y);
          bottom = std::max(bottom, s.y);
        }
        EXPECT_GE(left, 10);
        EXPECT_LE(right, 310);
        EXPECT_GE(top, 20);
        EXPECT_LE(bottom, 220);
        // And fills it in one direction, up to the margin.
        EXPECT_GT(std::max((right - left) / 300, (bottom - top) / 200), 0.93);
      }
    }
  }
}

TEST(Camera, UnknownViewIsAnErrorThatListsTheViews) {
  try {
    named_view("above");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("front, back, left, right, top, bottom, iso"), std::string::npos);
  }
}

}  // namespace
}  // namespace brushfire
