// What stands around the panels of a picture: colour bars, legends, titles, text.
#include <brushfire/figure/detail/legend.h>
#include <brushfire/figure/render.h>

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

detail::Layout layout_of(const Panel& panel, const RenderOptions& options) {
  const std::span<const Panel> panels(&panel, 1);
  return detail::lay_out(panels, options, detail::ranges_of(panels, options), detail::Font(""));
}

TEST(Render, TheBarHasAPointAndSaysHowFarValuesGoBeyondItsRange) {
  Panel panel = square();
  RenderOptions options = front(240);
  options.colour_bar = true;
  const auto layout = [&] { return layout_of(panel, options); };
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
  const auto swatches = [&] { return layout_of(panel, options).swatches; };
  EXPECT_TRUE(swatches().empty());
  panel.scalar[40] = kInfinity;
  ASSERT_EQ(swatches().size(), 1u);
  EXPECT_TRUE(swatches().front().color == detail::kNoValueColor);
  EXPECT_LE(swatches().front().at.y + swatches().front().at.height, 240);
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

}  // namespace
}  // namespace brushfire
