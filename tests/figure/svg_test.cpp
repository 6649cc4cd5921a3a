// SVG: visible lines only, text escaped.
#include <brushfire/core/error.h>
#include <brushfire/figure/render.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

RenderOptions front(int size) {
  RenderOptions options;
  options.width = options.height = size;
  options.camera = named_view("front");
  return options;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

Polyline circle(double radius, double z) {
  Polyline line;
  line.closed = true;
  for (int i = 0; i < 90; ++i) {
    line.points.push_back({radius * std::cos(i * kPi / 45), radius * std::sin(i * kPi / 45), z});
  }
  return line;
}

TEST(Svg, LineInFrontIsDrawnAndLineBehindIsNot) {
  Panel panel;
  panel.mesh = shapes::icosphere(4).mesh();
  const std::vector<std::vector<Polyline>> near{{circle(0.6, 0.8)}}, far{{circle(0.6, -0.8)}};
  const std::span panels(&panel, 1);
  EXPECT_EQ(count(render_svg(panels, near, front(100)), "<path"), 1u);
  EXPECT_EQ(count(render_svg(panels, far, front(100)), "<path"), 0u);
}

TEST(Svg, LineAroundABodyIsCutWhereItGoesBehind) {
  Panel panel;
  panel.mesh = shapes::icosphere(4).mesh();
  Polyline equator;
  equator.closed = true;
  for (int i = 0; i < 90; ++i) equator.points.push_back({std::cos(i * kPi / 45), 0.2, std::sin(i * kPi / 45)});
  const std::vector<std::vector<Polyline>> lines{{equator}};
  RenderOptions options = front(100);
  const std::string svg = render_svg(std::span(&panel, 1), lines, options);
  const std::size_t begin = svg.find("<path d=\"") + 9;
  const std::string d = svg.substr(begin, svg.find('"', begin) - begin);
  EXPECT_GE(count(d, "M"), 1u);
  EXPECT_LE(count(d, "M"), 3u);
  EXPECT_LT(count(d, "L"), 60u);  // half of the 90 pieces, and the cuts
}

TEST(Svg, TextIsEscaped) {
  Panel panel;
  panel.mesh = shapes::plane(2, 2).mesh();
  panel.scalar.assign(9, 1.0);
  panel.title = "a < b & \"c\"";
  RenderOptions options = front(64);
  const std::string svg = render_svg(std::span(&panel, 1), {}, options);
  EXPECT_EQ(svg.find("a < b"), std::string::npos);
  if (svg.find("<text") != std::string::npos) {
    EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
  }
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(Svg, OneSetOfLinesPerPanelIsAskedFor) {
  Panel panel;
  panel.mesh = shapes::plane(2, 2).mesh();
  const std::vector<std::vector<Polyline>> two(2);
  EXPECT_THROW(render_svg(std::span(&panel, 1), two, front(64)), Error);
}

}  // namespace
}  // namespace brushfire
