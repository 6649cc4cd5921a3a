// Validation, panels, frame.
#include <brushfire/figure/render.h>

#include <brushfire/core/error.h>
#include <brushfire/figure/detail/legend.h>
#include <brushfire/figure/detail/panel.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace brushfire {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::InvalidArgument, what); }

void check_size(std::size_t got, const Panel& panel, const char* what) {
  if (got != 0 && got != panel.mesh.vertex_count()) {
    refuse(std::to_string(got) + " " + what + " for a mesh of " + std::to_string(panel.mesh.vertex_count()) +
           " vertices: one per vertex is needed");
  }
}

}  // namespace

void detail::check_request(std::span<const Panel> panels, const RenderOptions& options) {
  constexpr int kSmallest = 16, kLargest = 16384, kMostSamples = 8;
  if (panels.empty()) refuse("nothing to show: a picture needs at least one panel");
  if (options.width < kSmallest || options.width > kLargest || options.height < kSmallest ||
      options.height > kLargest) {
    refuse("a picture of " + std::to_string(options.width) + " x " + std::to_string(options.height) +
           " pixels: width and height lie between 16 and 16384");
  }
  if (static_cast<std::size_t>(options.width) * panels.size() > kLargest) {
    refuse(std::to_string(panels.size()) + " panels of " + std::to_string(options.width) +
           " pixels are wider than 16384");
  }
  if (options.samples < 1 || options.samples > kMostSamples) refuse("samples per pixel lie between 1 and 8");
  if (!(options.camera.zoom > 0) || !std::isfinite(options.camera.zoom)) refuse("the zoom must be > 0");
  if (options.low.has_value() && options.high.has_value() && !(*options.low < *options.high)) {
    refuse("the range of colours is empty: its low end must be below its high end");
  }
  for (const Panel& p : panels) {
    if (!p.mesh.has_positions()) refuse("a mesh from lengths has no positions and cannot be drawn");
    check_size(p.scalar.size(), p, "values");
    check_size(p.labels.size(), p, "labels");
    if (!std::is_sorted(p.isolines.begin(), p.isolines.end())) refuse("isoline levels must ascend");
  }
}

namespace {

Image blank(int width, int height, bool transparent) {
  Image picture(width, height);
  if (!transparent) std::fill(picture.rgba.begin(), picture.rgba.end(), std::uint8_t{255});
  return picture;
}

}  // namespace

Image render(std::span<const Panel> panels, const RenderOptions& options) {
  detail::check_request(panels, options);
  const detail::Font font(options.font);
  const detail::ScalarRange range = detail::range_of(panels, options);
  const detail::Layout layout = detail::lay_out(panels, options, range, font);
  Image picture = blank(layout.width, layout.height, options.transparent);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    detail::paint_panel(panels[i], options, range, layout.panels[i], true, picture);
  }
  detail::paint(layout, options, font, picture);
  return picture;
}

}  // namespace brushfire
