// Whole pictures: what is seen where, refusals, the same pixels for any number of threads.
#include <brushfire/core/error.h>
#include <brushfire/figure/detail/legend.h>
#include <brushfire/figure/render.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

// The unit square seen from the front: the screen shows x to the right and y up.
Panel square(Index cells = 8) {
  Panel panel;
  panel.mesh = shapes::plane(cells, cells).mesh();
  for (const Vec3& p : panel.mesh.positions()) panel.scalar.push_back(p.x);
  return panel;
}

RenderOptions front(int size) {
  RenderOptions options;
  options.width = options.height = size;
  options.camera = named_view("front");
  options.colour_bar = false;
  options.silhouettes = false;
  return options;
}

Image render_one(const Panel& panel, const RenderOptions& options) { return render(std::span(&panel, 1), options); }

double brightness(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return (p[0] + p[1] + p[2]) / 3.0;
}

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

TEST(Render, TheBarHasAPointAndSaysHowFarValuesGoBeyondItsRange) {
  Panel panel = square();
  RenderOptions options = front(240);
  options.colour_bar = true;
  const auto layout = [&] {
    const std::span<const Panel> panels(&panel, 1);
    return detail::lay_out(panels, options, detail::ranges_of(panels, options), detail::Font(""));
  };
  const auto says = [&](const std::string& text) {
    const detail::Layout laid = layout();
    return std::any_of(laid.texts.begin(), laid.texts.end(), [&](const auto& t) { return t.text == text; });
  };
  EXPECT_EQ(layout().bars[0].point_above, 0);
  EXPECT_EQ(layout().bars[0].point_below, 0);
  options.scales[0].low = 0.25;
  options.scales[0].high = 0.5;
  EXPECT_GT(layout().bars[0].point_above, 0);
  EXPECT_GT(layout().bars[0].point_below, 0);
  EXPECT_TRUE(says("to 1.0")) << "at the top";
  // The point is in the picture, in the colour of the end.
  const Image image = render_one(panel, options);
  const detail::Bar bar = layout().bars[0];
  const std::uint8_t* p = image.pixel(bar.at.x + bar.at.width / 2, bar.at.y - bar.point_above / 2);
  EXPECT_LT(p[2], 100);  // yellow
}

TEST(Render, TheBarShowsBandsAsTheyAreOnTheSurface) {
  Panel panel = square();
  panel.isolines = {0.25, 0.5, 0.75};
  RenderOptions options = front(240);
  options.colour_bar = true;
  options.fill = Fill::Bands;
  const std::span<const Panel> panels(&panel, 1);
  const detail::Layout layout = detail::lay_out(panels, options, detail::ranges_of(panels, options), detail::Font(""));
  const std::vector<Color>& rows = layout.bars[0].rows;
  int steps = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) steps += std::abs(rows[i].g - rows[i - 1].g) > 0.15F;
  EXPECT_EQ(steps, 3);
  for (const double value : {0.1, 0.4, 0.6, 0.9}) {
    const auto row = static_cast<std::size_t>(std::lround((1 - value) * static_cast<double>(rows.size() - 1)));
    const Color c = detail::value_color(value, {0, 1}, Colormap::Viridis, Fill::Bands, panel.isolines);
    EXPECT_NEAR(rows[row].g, c.g, 0.02) << value;
  }
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

TEST(Render, PanelsOfAnotherScaleHaveTheirOwnRangeAndBar) {
  std::vector<Panel> panels{square(), square(), square()};
  for (double& x : panels[1].scalar) x += 9;
  for (double& x : panels[2].scalar) x *= 1e-3;
  panels[2].scale = 1;
  RenderOptions options = front(100);
  options.colour_bar = true;
  options.scales.resize(2);
  options.scales[1].colormap = Colormap::Magma;
  const std::vector<detail::ScalarRange> ranges = detail::ranges_of(panels, options);
  EXPECT_EQ(ranges[0].high, 10);
  EXPECT_EQ(ranges[1].high, 1e-3);
  const detail::Layout layout = detail::lay_out(panels, options, ranges, detail::Font(""));
  ASSERT_EQ(layout.bars.size(), 2u);
  EXPECT_TRUE(layout.bars[1].rows.front() == color_of(Colormap::Magma, 1));
  // panel, panel, bar, panel, bar, none over another
  EXPECT_EQ(layout.panels[1].x, 100);
  EXPECT_GE(layout.bars[0].at.x, 200);
  EXPECT_GT(layout.panels[2].x, layout.bars[0].at.x + layout.bars[0].at.width);
  EXPECT_GE(layout.bars[1].at.x, layout.panels[2].x + 100);
  EXPECT_GT(layout.width, layout.bars[1].at.x + layout.bars[1].at.width);
  // The third panel uses the whole of its map: nearly black to nearly white.
  const Image image = render(panels, options);
  const int x = layout.panels[2].x;
  EXPECT_LT(brightness(image, x + 6, 50), 40);
  EXPECT_GT(brightness(image, x + 92, 50), 180);
}

TEST(Render, WhatHasNoValueIsInTheLegend) {
  Panel panel = square();
  RenderOptions options = front(240);
  options.colour_bar = true;
  const auto swatches = [&] {
    const std::span<const Panel> panels(&panel, 1);
    return detail::lay_out(panels, options, detail::ranges_of(panels, options), detail::Font("")).swatches;
  };
  EXPECT_TRUE(swatches().empty());
  panel.scalar[40] = kInfinity;
  ASSERT_EQ(swatches().size(), 1u);
  EXPECT_TRUE(swatches().front().color == detail::kNoValueColor);
  EXPECT_LE(swatches().front().at.y + swatches().front().at.height, 240);
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

TEST(Render, TextOfTheFrameStaysInsideThePicture) {
  const detail::Font font("");
  Panel panel = square();
  panel.title = "A title that is far too long for a panel of one hundred and sixty pixels, and goes on";
  for (double& x : panel.scalar) x *= 123456.789;
  RenderOptions options;
  options.width = 160;
  options.height = 120;
  options.scales[0].unit = "geodesic distance, in units of the mesh";
  const std::vector<Panel> panels{panel};
  const auto layout = detail::lay_out(panels, options, detail::ranges_of(panels, options), font);
  EXPECT_GE(layout.texts.size(), 4u);
  for (const detail::TextAt& t : layout.texts) {
    EXPECT_GE(t.x, 0) << t.text;
    EXPECT_LE(t.x + font.width(t.text, t.height), layout.width) << t.text;
    EXPECT_GE(t.y - t.height, -1) << t.text;
    EXPECT_LE(t.y, layout.height) << t.text;
  }
}

// How many pixels of a picture are darker than grey.
std::size_t dark_pixels(const Image& picture) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) count += picture.rgba[i] < 128 ? 1 : 0;
  return count;
}

Image written(const std::string& text) {
  Image picture;
  picture.width = 64, picture.height = 32;
  picture.rgba.assign(64 * 32 * 4, 255);
  detail::Font("").write(picture, 4, 26, 26, text, {0, 0, 0});
  return picture;
}

TEST(Render, EveryLetterOfTheBuiltInFontIsInkAndNotTheBoxOfAMissingOne) {
  const Image box = written("\U0001F40C");  // a snail, which it lacks
  EXPECT_GT(dark_pixels(box), 0u);
  for (const char* letter : {"0", "1", "9", "-", ".", "e", "A", "z", "%", "°", "µ", "é", "ß", "ğ",
                             "ł", "ș", "Ω", "α", "Ж", "я", "²", "−", "≤", "∞", "→", "–", "’", "€"}) {
    const Image picture = written(letter);
    EXPECT_GT(dark_pixels(picture), 2u) << letter;
    EXPECT_NE(picture.rgba, box.rgba) << letter;
  }
}

TEST(Render, TheColourBarHasNumbersOnAMachineWithoutFonts) {
  // No font of the system is looked for: what is drawn here is drawn everywhere.
  const Panel panel = square();
  RenderOptions options;
  options.width = 160, options.height = 120;
  const std::vector<Panel> panels{panel};
  const auto layout = detail::lay_out(panels, options, detail::ranges_of(panels, options), detail::Font(""));
  const Image picture = render_one(panel, options);
  ASSERT_GE(layout.texts.size(), 3u);
  for (const detail::TextAt& t : layout.texts) {
    std::size_t ink = 0;
    for (int y = static_cast<int>(t.y - t.height); y < static_cast<int>(t.y) + 1; ++y) {
      for (int x = static_cast<int>(t.x); x < static_cast<int>(t.x + t.height); ++x) {
        ink += picture.pixel(x, y)[0] < 128 ? 1 : 0;
      }
    }
    EXPECT_GT(ink, 3u) << t.text;
  }
}

TEST(Render, LabelsGetALegendAndDistinctColours) {
  Panel panel = square();
  panel.scalar.clear();
  for (const Vec3& p : panel.mesh.positions()) panel.labels.push_back(p.x < 0.5 ? 0 : 3);
  panel.label_names = {"left", "", "", "right"};
  RenderOptions options = front(100);
  options.colour_bar = true;
  const std::vector<Panel> panels{panel};
  const auto layout = detail::lay_out(panels, options, detail::ranges_of(panels, options), detail::Font(""));
  ASSERT_EQ(layout.swatches.size(), 2u);
  EXPECT_TRUE(layout.swatches[1].color == label_color(3));
  const Image image = render(panels, options);
  EXPECT_NE(image.pixel(20, 50)[0], image.pixel(80, 50)[0]);
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
