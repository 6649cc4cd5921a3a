// Whole pictures: what is seen where, refusals, the same pixels for any number of threads.
#include <brushfire/core/error.h>
#include <brushfire/figure/detail/legend.h>
#include <brushfire/figure/render.h>
#include <brushfire/mesh/shapes.h>

#include "square_panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

using test::brightness;
using test::front;
using test::render_one;
using test::square;

TEST(Render, ColourFollowsTheScalarFromLeftToRight) {
  const Image image = render_one(square(), front(100));
  EXPECT_GT(image.pixel(8, 50)[2], image.pixel(8, 50)[1]);    // viridis begins violet
  EXPECT_GT(image.pixel(90, 50)[1], image.pixel(90, 50)[2]);  // and ends yellow
  EXPECT_EQ(image.pixel(0, 0)[0], 255);                       // the margin is background
}

// How many pixels of the row something dark was drawn on.
int darkened(const Image& image, const Image& without, int row) {
  int dark = 0;
  for (int x = 0; x < image.width; ++x) dark += brightness(image, x, row) < 0.6 * brightness(without, x, row);
  return dark;
}

TEST(Render, IsolineIsADarkLineOfItsWidthAtItsLevel) {
  Panel panel = square();
  panel.isolines = {0.5};
  RenderOptions options = front(200);
  options.line_width = 4;
  const Image image = render_one(panel, options);
  const Image without = render_one(square(), options);
  EXPECT_NEAR(darkened(image, without, 77), 4, 1);
  EXPECT_LT(brightness(image, 100, 77), 0.5 * brightness(without, 100, 77));
  EXPECT_EQ(image.pixel(94, 77)[1], without.pixel(94, 77)[1]);
}

TEST(Render, IsolinesKeepTheirWidthOnTheScreenWhateverTheSlopeOfTheScalar) {
  for (const double slope : {0.2, 1.0, 30.0}) {
    Panel panel = square();
    for (double& x : panel.scalar) x = slope * x;
    panel.isolines = {0.5 * slope};
    RenderOptions options = front(200);
    options.line_width = 6;
    const Image image = render_one(panel, options);
    const Image without = render_one(square(), options);
    EXPECT_NEAR(darkened(image, without, 77), 6, 1) << "slope " << slope;
  }
}

TEST(Render, BandsAlternateBetweenConsecutiveLevels) {
  Panel panel = square();
  panel.isolines = {0.25, 0.5, 0.75};
  RenderOptions options = front(200);
  options.fill = Fill::Bands;
  options.scales[0].low = -1;  // one colour throughout, so that only the bands differ
  options.scales[0].high = 1000;
  const Image image = render_one(panel, options);
  const double first = brightness(image, 30, 90), second = brightness(image, 75, 90),
               third = brightness(image, 120, 90);
  EXPECT_GT(second, 1.5 * first);
  EXPECT_GT(second, 1.5 * third);
}

TEST(Render, FacesWithAnInfiniteValueAreGreyAndDoNotStretchTheRange) {
  Panel panel = square();
  for (std::size_t v = 0; v < panel.scalar.size(); ++v) {
    if (panel.mesh.positions()[v].x > 0.8) panel.scalar[v] = kInfinity;
  }
  const Image image = render_one(panel, front(100));
  const std::uint8_t* p = image.pixel(90, 50);
  EXPECT_EQ(p[0], p[1]);
  EXPECT_EQ(p[1], p[2]);
  EXPECT_LT(p[0], 250);
  EXPECT_GT(image.pixel(66, 50)[1], image.pixel(66, 50)[2]);  // near the largest finite value: the map's far end
}

TEST(Render, BeyondTheFrontTheSurfaceIsPlain) {
  Panel panel = square();
  panel.front = 0.5;
  const Image image = render_one(panel, front(100)), whole = render_one(square(), front(100));
  EXPECT_EQ(image.pixel(20, 50)[0], whole.pixel(20, 50)[0]);
  EXPECT_NEAR(image.pixel(80, 50)[0], image.pixel(80, 50)[2], 20);  // no hue
  EXPECT_NEAR(image.pixel(60, 50)[0], image.pixel(90, 50)[0], 1);   // and the same everywhere
}

TEST(Render, DotsOnTheFarSideAreHiddenAndPathsThereAreDashed) {
  Panel panel;
  panel.mesh = shapes::icosphere(4).mesh();
  RenderOptions options = front(120);
  options.hidden_paths = false;
  const Image bare = render_one(panel, options);
  panel.dots = {{0, 0, -1}};
  panel.paths = {{{{-0.3, 0, -0.95}, {0.3, 0, -0.95}}, false}};
  EXPECT_EQ(render_one(panel, options).rgba, bare.rgba);
  options.hidden_paths = true;
  const Image dashed = render_one(panel, options);
  int changes = 0;
  bool red = false;
  for (int x = 0; x < 120; ++x) {
    const bool now =
        dashed.pixel(x, 60)[0] > bare.pixel(x, 60)[0] + 10 || dashed.pixel(x, 60)[2] + 40 < bare.pixel(x, 60)[2];
    changes += now != red;
    red = now;
  }
  EXPECT_GE(changes, 4);  // two dashes at least
  EXPECT_EQ(changes % 2, 0);
  options.hidden_paths = false;
  panel.dots = {{0, 0, 1}};
  EXPECT_NE(render_one(panel, options).rgba, bare.rgba);
}

// Of two triangles over a square the corners x = 0 have label 0 and those of x = 1 label 1; the border is at x = 0.8.
TEST(Render, LabelsChangeWhereTheCellsMeetAndNotHalfwayBetweenVertices) {
  Panel panel;
  panel.mesh = shapes::plane(1, 1).mesh();
  for (const Vec3& p : panel.mesh.positions()) panel.labels.push_back(p.x > 0.5 ? 1 : 0);
  const auto column_of_change = [&](int row) {
    const Image image = render_one(panel, front(200));
    const auto same = [&](int a, int b) {
      return std::equal(image.pixel(a, row), image.pixel(a, row) + 3, image.pixel(b, row));
    };
    int x = 100;
    while (x > 8 && same(x - 1, x)) --x;
    if (x > 8) return x;
    for (x = 100; x < 190 && same(x, x + 1); ++x) {
    }
    return x;
  };
  const double width = 200 * 0.92;
  EXPECT_GT(std::abs(column_of_change(60) - (100 + 0.3 * width)), 20);
  const auto corner = [&](Index v) { return panel.mesh.positions()[v]; };
  for (Index f = 0; f < 2; ++f) {
    SharedFace& face = panel.label_borders.emplace_back();
    face.face = f;
    for (std::size_t k = 0; k < 3; ++k) face.label[k] = panel.labels[panel.mesh.faces()[f][k]];
    for (std::size_t at = 0; at < 3; ++at) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = corner(panel.mesh.faces()[f][at]).x;
        face.distance[at][k] = face.label[k] == 0 ? 1 + x : 2.6 - x;  // equal at 0.8
      }
    }
  }
  for (const int row : {40, 100, 160}) EXPECT_NEAR(column_of_change(row), 100 + 0.3 * width, 3) << row;
}

TEST(Render, ColoursOfLabelsCanBeGivenAndThenNameThemInTheLegendOnlyWhereEachHasItsOwn) {
  Panel panel = square();
  panel.labels.assign(panel.scalar.size(), 0);
  for (std::size_t v = 0; v < panel.labels.size(); ++v) panel.labels[v] = static_cast<Index>(v % 3);
  RenderOptions options = front(240);
  options.colour_bar = true;
  const auto swatches = [&] {
    const std::span<const Panel> panels(&panel, 1);
    return detail::lay_out(panels, options, detail::ranges_of(panels, options), detail::Font("")).swatches;
  };
  panel.label_colors = {4, 2, 3};
  ASSERT_EQ(swatches().size(), 3u);
  EXPECT_TRUE(swatches().front().color == label_color(4));
  panel.label_colors = {4, 2, 4};
  EXPECT_TRUE(swatches().empty());
}

TEST(Render, PathIsSeenAlongItsWholeLength) {
  Panel panel;
  panel.mesh = shapes::icosphere(4).mesh();
  for (int i = 0; i <= 20; ++i) {
    const double a = (i - 10) * 0.1;
    panel.paths.resize(1);
    panel.paths[0].points.push_back({std::sin(a), 0, std::cos(a)});
  }
  const Image image = render_one(panel, front(200));
  for (int x = 30; x <= 170; ++x) {
    const std::uint8_t* p = image.pixel(x, 100);
    EXPECT_GT(p[0], p[2] + 60) << "at column " << x;  // red
  }
}

TEST(Render, TransparentBackgroundHasNoOpacity) {
  RenderOptions options = front(64);
  options.transparent = true;
  const Image image = render_one(square(), options);
  EXPECT_EQ(image.pixel(0, 0)[3], 0);
  EXPECT_EQ(image.pixel(32, 32)[3], 255);
}

TEST(Render, SamePixelsForAnyNumberOfThreads) {
  Panel panel;
  panel.mesh = shapes::folded_sphere(4).mesh();
  for (const Vec3& p : panel.mesh.positions()) panel.scalar.push_back(p.x + p.y);
  panel.isolines = {-0.5, 0, 0.5};
  panel.dots = {{0, 0, 1.2}};
  RenderOptions options;
  options.width = 300;
  options.height = 200;
  options.threads = 1;
  const Image one = render_one(panel, options);
  options.threads = 3;
  EXPECT_EQ(render_one(panel, options).rgba, one.rgba);
}

TEST(Render, PanelsShareOneRangeOfColours) {
  Panel low = square(), high = square();
  for (double& x : high.scalar) x += 9;
  const std::vector<Panel> panels{low, high};
  const detail::ScalarRange range = detail::ranges_of(panels, {}).front();
  EXPECT_EQ(range.low, 0);
  EXPECT_EQ(range.high, 10);
  const Image image = render(panels, front(100));
  EXPECT_EQ(image.width, 200);
  EXPECT_GT(image.pixel(90, 50)[2], image.pixel(90, 50)[1]);  // still violet: a tenth of the range
}

TEST(Render, CornersThatAreLessOpenAreDarker) {
  Panel panel = square();
  const Image plain = render_one(panel, front(100));
  panel.openness.assign(panel.mesh.halfedge_count(), {1, 1});
  EXPECT_EQ(render_one(panel, front(100)).rgba, plain.rgba);
  panel.openness.assign(panel.mesh.halfedge_count(), {0.5, 1});
  const Image shaded = render_one(panel, front(100));
  EXPECT_LT(brightness(shaded, 50, 50), 0.7 * brightness(plain, 50, 50));
  RenderOptions options = front(100);
  options.camera = named_view("back");  // where everything is open
  const Image back = render_one(panel, options);
  EXPECT_GT(brightness(back, 50, 50), brightness(shaded, 50, 50) / 0.7);
}

TEST(Render, BadRequestsAreErrorsThatSayWhatIsWrong) {
  const auto message = [](const Panel& panel, const RenderOptions& options) -> std::string {
    try {
      render_one(panel, options);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  Panel panel = square();
  RenderOptions options = front(100);
  panel.scalar.pop_back();
  EXPECT_NE(message(panel, options).find("80 values for a mesh of 81 vertices"), std::string::npos);
  panel = square();
  panel.isolines = {0.5, 0.2};
  EXPECT_NE(message(panel, options).find("ascend"), std::string::npos);
  panel = square();
  options.width = 5;
  EXPECT_NE(message(panel, options).find("5 x 100"), std::string::npos);
  options = front(100);
  options.scales[0].low = 2;
  options.scales[0].high = 1;
  EXPECT_NE(message(panel, options).find("range"), std::string::npos);
  options = front(100);
  panel.scale = 1;
  EXPECT_NE(message(panel, options).find("scale 1 of 1"), std::string::npos);
  panel.scale = 0;
  panel.openness.resize(3);
  EXPECT_NE(message(panel, options).find("384 corners"), std::string::npos);
  panel.openness.clear();
  options.samples = 0;
  EXPECT_NE(message(panel, options).find("samples"), std::string::npos);
  options = front(100);
  options.font = "/no/such/font.ttf";
  EXPECT_NE(message(panel, options).find("/no/such/font.ttf"), std::string::npos);
  EXPECT_THROW(render({}, front(100)), Error);
}

TEST(Render, EmptyAndDegenerateMeshesGiveABlankPictureNotACrash) {
  Panel empty;
  EXPECT_EQ(render_one(empty, front(32)).pixel(16, 16)[0], 255);
  const std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 0, 1}};
  Panel point;
  point.mesh = Mesh(positions, faces);
  EXPECT_EQ(render_one(point, front(32)).width, 32);
}

}  // namespace
}  // namespace brushfire
