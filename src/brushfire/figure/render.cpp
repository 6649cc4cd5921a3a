// Validation, panels, frame.
#include <brushfire/figure/render.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/memory.h>
#include <brushfire/core/error.h>
#include <brushfire/figure/detail/legend.h>
#include <brushfire/figure/detail/panel.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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
  // The pixels, and what a PNG makes of them on its way to a file.
  constexpr std::uint64_t kBytesPerPixel = 4 + 4 + 4;
  require_memory(kBytesPerPixel * panels.size() * static_cast<std::uint64_t>(options.width) *
                     static_cast<std::uint64_t>(options.height),
                 0,
                 "a picture of " + std::to_string(panels.size()) + " x " + std::to_string(options.width) + " x " +
                     std::to_string(options.height) + " pixels",
                 "ask for a smaller one");
  if (options.samples < 1 || options.samples > kMostSamples) refuse("samples per pixel lie between 1 and 8");
  if (!std::isfinite(options.camera.azimuth) || !std::isfinite(options.camera.elevation)) {
    refuse("azimuth and elevation are finite angles");
  }
  for (const double size : {options.line_width, options.path_width, options.dot_size}) {
    if (!(size >= 0 && size <= kLargest)) refuse("widths of lines and paths and sizes of dots lie between 0 and 16384");
  }
  if (!(options.camera.zoom > 0) || !std::isfinite(options.camera.zoom)) refuse("the zoom must be > 0");
  for (const ColorScale& scale : options.scales) {
    if (scale.low.has_value() && scale.high.has_value() && !(*scale.low < *scale.high)) {
      refuse("the range of colours is empty: its low end must be below its high end");
    }
  }
  for (const Panel& p : panels) {
    if (!p.mesh.has_positions()) refuse("a mesh from lengths has no positions and cannot be drawn");
    check_size(p.scalar.size(), p, "values");
    check_size(p.labels.size(), p, "labels");
    if (p.scale >= options.scales.size()) {
      refuse("scale " + std::to_string(p.scale) + " of " + std::to_string(options.scales.size()) + " (from 0 on)");
    }
    if (!p.openness.empty() && p.openness.size() != p.mesh.halfedge_count()) {
      refuse(std::to_string(p.openness.size()) + " values of openness for a mesh of " +
             std::to_string(p.mesh.halfedge_count()) + " corners: one per corner is needed");
    }
    if (!std::is_sorted(p.isolines.begin(), p.isolines.end())) refuse("isoline levels must ascend");
  }
}

namespace {

Image blank(int width, int height, bool transparent) {
  Image picture;
  picture.width = width;
  picture.height = height;
  const std::size_t bytes = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  picture.rgba.reserve(bytes);
  in_pieces(bytes, [&](std::size_t, std::size_t end) { picture.rgba.resize(end, transparent ? 0 : 255); });
  return picture;
}

}  // namespace

Image render(std::span<const Panel> panels, const RenderOptions& options) {
  detail::check_request(panels, options);
  const detail::Font font(options.font);
  const std::vector<detail::ScalarRange> ranges = detail::ranges_of(panels, options);
  const detail::Layout layout = detail::lay_out(panels, options, ranges, font);
  Image picture = blank(layout.width, layout.height, options.transparent);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    detail::paint_panel(panels[i], options, ranges[panels[i].scale], layout.panels[i], true, picture);
  }
  detail::paint(layout, font, picture);
  return picture;
}

}  // namespace brushfire
