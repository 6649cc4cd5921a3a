// The z-buffer: no holes, the nearest face in front, the same picture whatever the order of the faces.
#include <brushfire/figure/detail/raster.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace brushfire::detail {
namespace {

std::vector<Index> all_faces(const Shape& s) {
  std::vector<Index> faces(s.faces.size());
  std::iota(faces.begin(), faces.end(), Index{0});
  return faces;
}

Strip draw_whole(const Shape& s, const Camera& camera, int width, int height) {
  const Projection projection(camera, s.positions, 0, 0, width, height);
  Strip strip(width, 0, height);
  draw(s.faces, project(s.positions, projection, 1), all_faces(s), strip);
  return strip;
}

TEST(Raster, ConvexSolidHasNoHolesFromAnySide) {
  const Shape sphere = shapes::icosphere(4);
  for (int turn = 0; turn < 12; ++turn) {
    Camera camera;
    camera.azimuth = 31.7 * turn;
    camera.elevation = 60 - 11.3 * turn;
    const Strip strip = draw_whole(sphere, camera, 200, 200);
    for (int row = 0; row < strip.rows; ++row) {
      int first = strip.columns, last = -1;
      for (int column = 0; column < strip.columns; ++column) {
        if (strip.face[strip.at(column, row)] == kNoIndex) continue;
        first = std::min(first, column);
        last = column;
      }
      for (int column = first; column <= last; ++column) {
        ASSERT_NE(strip.face[strip.at(column, row)], kNoIndex)
            << "hole at " << column << ", " << row << ", turn " << turn;
      }
    }
  }
}

TEST(Raster, FacesTurnedAwayAreHiddenByThoseInFront) {
  const Shape sphere = shapes::icosphere(3);
  const Strip strip = draw_whole(sphere, named_view("front"), 150, 150);
  for (const Index f : strip.face) {
    if (f == kNoIndex) continue;
    double z = 0;
    for (const Index v : sphere.faces[f]) z += sphere.positions[v].z;
    EXPECT_GT(z, -0.2);  // the rim itself may be seen edge-on
  }
}

TEST(Raster, OrderOfTheFacesDoesNotShowInTheDepths) {
  const Shape shape = shapes::folded_sphere(4);
  Camera camera;
  const Projection projection(camera, shape.positions, 0, 0, 120, 120);
  const auto vertices = project(shape.positions, projection, 2);
  std::vector<Index> listed = all_faces(shape);
  Strip forward(240, 0, 240), backward(240, 0, 240);
  draw(shape.faces, vertices, listed, forward);
  std::reverse(listed.begin(), listed.end());
  draw(shape.faces, vertices, listed, backward);
  EXPECT_EQ(forward.depth, backward.depth);
}

TEST(Raster, BandsTogetherShowWhatTheWholeShows) {
  const Shape shape = shapes::torus(40, 20);
  Camera camera;
  camera.elevation = 50;
  const int size = 130, band = 16;
  const Projection projection(camera, shape.positions, 0, 0, size, size);
  const auto vertices = project(shape.positions, projection, 1);
  const Strip whole = draw_whole(shape, camera, size, size);
  const FaceBands bands = sort_into_bands(shape.faces, vertices, size, band, 1);
  for (int b = 0; b * band < size; ++b) {
    const int rows = std::min(band, size - b * band);
    Strip strip(size, b * band, rows);
    const auto begin = bands.offset[static_cast<std::size_t>(b)], end = bands.offset[static_cast<std::size_t>(b) + 1];
    draw(shape.faces, vertices, std::span(bands.face).subspan(begin, end - begin), strip);
    for (int row = strip.first_row; row < strip.first_row + rows; ++row) {
      for (int column = 0; column < size; ++column) {
        ASSERT_EQ(strip.face[strip.at(column, row)], whole.face[whole.at(column, row)]) << column << ", " << row;
      }
    }
  }
}

TEST(Raster, WeightsOfATriangleReproduceItsCornersAndSumToOne) {
  const ScreenVertex a{10 * kSubsample, 20 * kSubsample, 1, 1}, b{90 * kSubsample, 35 * kSubsample, 2, 1},
      c{40 * kSubsample, 80 * kSubsample, 3, 1};
  const ScreenTriangle t(a, b, c);
  for (int row = 0; row < 100; row += 7) {
    for (int column = 0; column < 100; column += 7) {
      const auto w = t.weights(column, row);
      EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-5);
      const double x = 10 * w[0] + 90 * w[1] + 40 * w[2], y = 20 * w[0] + 35 * w[1] + 80 * w[2];
      EXPECT_NEAR(x, column + 0.5, 1e-3);
      EXPECT_NEAR(y, row + 0.5, 1e-3);
      const auto right = t.weights(column + 1, row), down = t.weights(column, row + 1);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(right[k] - w[k], t.weights_dx()[k], 1e-5);
        EXPECT_NEAR(down[k] - w[k], t.weights_dy()[k], 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace brushfire::detail
