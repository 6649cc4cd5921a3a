// Titles, colour bars and legends: where they go and what they say, for pixels and for SVG alike.
#pragma once

#include <brushfire/figure/detail/panel.h>
#include <brushfire/figure/detail/text.h>

#include <string>
#include <vector>

namespace brushfire::detail {

struct TextAt {
  double x, y, height;  // left end of the baseline, pixels
  std::string text;
};

struct Swatch {
  Rectangle at;
  Color color;
};

struct Bar {
  Rectangle at;
  std::vector<Color> rows;               // [at.height], from the top
  int point_above = 0, point_below = 0;  // pixels, for values beyond the range; 0: there are none
  std::vector<double> ticks;             // rows that have a mark
};

// The picture's frame around its panels.
struct Layout {
  int width = 0, height = 0;
  std::vector<Rectangle> panels;
  std::vector<TextAt> texts;
  std::vector<Swatch> swatches;  // of labels, and of what has no value
  std::vector<Bar> bars;
};

// Throws Error(InvalidArgument) for anything in the request that render() refuses.
void check_request(std::span<const Panel> panels, const RenderOptions& options);

// One for each of the options' scales.
std::vector<ScalarRange> ranges_of(std::span<const Panel> panels, const RenderOptions& options);
Layout lay_out(std::span<const Panel> panels, const RenderOptions& options, std::span<const ScalarRange> ranges,
               const Font& font);
void paint(const Layout& layout, const Font& font, Image& picture);

}  // namespace brushfire::detail
