// SVG: the shaded surface as a picture, everything thin as vectors, hidden parts left out.
#include <brushfire/figure/render.h>

#include <brushfire/core/detail/base64.h>
#include <brushfire/core/error.h>
#include <brushfire/figure/detail/legend.h>
#include <brushfire/figure/detail/overlay.h>
#include <brushfire/figure/detail/panel.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace brushfire {
namespace {

using detail::Projection;
using detail::Rectangle;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", x);
  return text;
}

std::string hex(Color c) {
  const auto byte = [](float x) { return static_cast<unsigned>(std::clamp(255.0F * x + 0.5F, 0.0F, 255.0F)); };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(c.r), byte(c.g), byte(c.b));
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  return detail::encode_base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// Draws polylines of one panel where they are seen, or where the surface hides them.
class VisibleLines {
 public:
  VisibleLines(const Projection& projection, Rectangle at, std::span<const float> depth)
      : projection_(projection), at_(at), depth_(depth) {}

  // The `d` attribute of an SVG path.
  std::string trace(std::span<const Polyline> lines, bool hidden = false) const {
    std::string d;
    for (const Polyline& line : lines) {
      bool pen_down = false;
      const std::size_t n = line.points.size();
      for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
        trace_segment(projection_(line.points[i]), projection_(line.points[(i + 1) % n]), hidden, pen_down, d);
      }
    }
    return d;
  }

  bool visible(const Projection::Screen& s) const {
    // The surface's own depth is known to a pixel only: within two pixels' worth of depth a point lies on it, and the
    // nearest of the pixels around it may be in front of it on a steep face.
    const int x = static_cast<int>(std::floor(s.x)), y = static_cast<int>(std::floor(s.y));
    const double slack = 2.5 / projection_.pixels_per_unit() * projection_.depth_per_unit(s.depth);
    for (int row = y - 1; row <= y + 1; ++row) {
      for (int column = x - 1; column <= x + 1; ++column) {
        if (column < 0 || row < 0 || column >= at_.width || row >= at_.height) continue;
        if (s.depth + slack >= static_cast<double>(depth_[static_cast<std::size_t>(row) * at_.width + column]))
          return true;
      }
    }
    return false;
  }

  std::string place(double x, double y) const { return number(at_.x + x) + " " + number(at_.y + y); }

 private:
  void trace_segment(const Projection::Screen& a, const Projection::Screen& b, bool hidden, bool& pen_down,
                     std::string& d) const {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y))));
    const auto along = [&](int i) {
      const double t = static_cast<double>(i) / steps;
      return Projection::Screen{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.depth + t * (b.depth - a.depth), 1};
    };
    int last_written = -1;
    for (int i = 0; i <= steps; ++i) {
      const Projection::Screen s = along(i);
      if (visible(s) != hidden) {
        if (!pen_down) {
          d += "M" + place(s.x, s.y);
          last_written = i;
        }
        pen_down = true;
      } else if (pen_down) {
        if (i > 0 && last_written != i - 1) d += "L" + place(along(i - 1).x, along(i - 1).y);
        pen_down = false;
      }
    }
    if (pen_down && last_written != steps) d += "L" + place(b.x, b.y);
  }

  const Projection& projection_;
  Rectangle at_;
  std::span<const float> depth_;
};

std::string stroke(const std::string& d, const char* color, double width, const std::string& more = {}) {
  if (d.empty()) return {};
  return "<path d=\"" + d + "\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"" + number(width) + "\"" + more +
         " stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n";
}

std::string draw_panel(const Panel& panel, std::span<const Polyline> lines, const RenderOptions& options,
                       detail::ScalarRange range, Rectangle at) {
  Image picture(at.width, at.height);
  std::vector<float> depth(static_cast<std::size_t>(at.width) * at.height);
  Panel surface = panel;
  if (options.fill == Fill::Smooth) surface.isolines.clear();
  detail::paint_panel(surface, options, range, {0, 0, at.width, at.height}, false, picture, depth);
  const Projection projection = detail::projection_of(panel, options);
  const VisibleLines visible(projection, at, depth);
  std::string out = "<image x=\"" + std::to_string(at.x) + "\" y=\"" + std::to_string(at.y) + "\" width=\"" +
                    std::to_string(at.width) + "\" height=\"" + std::to_string(at.height) +
                    "\" href=\"data:image/png;base64," + base64(encode_png(picture)) + "\"/>\n";
  out += stroke(visible.trace(lines), "#14141a", options.line_width);
  const std::string paths = visible.trace(panel.paths);
  constexpr double kCore = 0.66;  // the rest is a white seam
  if (options.hidden_paths) {
    const double dash = detail::kDashes * options.path_width;
    out += stroke(visible.trace(panel.paths, true), "#ed4229", 0.5 * kCore * options.path_width,
                  " stroke-dasharray=\"" + number(dash) + " " + number(dash) + "\" opacity=\"0.6\"");
  }
  out += stroke(paths, "#ffffff", options.path_width) + stroke(paths, "#ed4229", kCore * options.path_width);
  for (const Vec3& p : panel.dots) {
    const Projection::Screen s = projection(p);
    if (!visible.visible(s)) continue;
    out += "<circle cx=\"" + number(at.x + s.x) + "\" cy=\"" + number(at.y + s.y) + "\" r=\"" +
           number(0.43 * options.dot_size) + "\" fill=\"#ffffff\" stroke=\"#1a1a1f\" stroke-width=\"" +
           number(0.14 * options.dot_size) + "\"/>\n";
  }
  return out;
}

// The colours as runs of equal rows; each reaches under the next, lest a gap between them shows.
std::string draw_bar(const detail::Bar& bar) {
  const Rectangle& at = bar.at;
  std::string out;
  const auto box = [&](int row, int rows, Color color) {
    out += "<rect x=\"" + std::to_string(at.x) + "\" y=\"" + std::to_string(at.y + row) + "\" width=\"" +
           std::to_string(at.width) + "\" height=\"" + std::to_string(rows) + "\" fill=\"" + hex(color) + "\"/>\n";
  };
  for (int row = 0; row < at.height;) {
    const std::string color = hex(bar.rows[static_cast<std::size_t>(row)]);
    int end = row + 1;
    while (end < at.height && hex(bar.rows[static_cast<std::size_t>(end)]) == color) ++end;
    box(row, std::min(at.height, end + 1) - row, bar.rows[static_cast<std::size_t>(row)]);
    row = end;
  }
  const auto point = [&](int base, int tip, Color color) {
    out += "<path d=\"M" + std::to_string(at.x) + " " + std::to_string(base) + "h" + std::to_string(at.width) + "L" +
           number(at.x + 0.5 * at.width) + " " + std::to_string(tip) + "z\" fill=\"" + hex(color) + "\"/>\n";
  };
  if (bar.point_above > 0) point(at.y, at.y - bar.point_above, bar.rows.front());
  if (bar.point_below > 0) point(at.y + at.height, at.y + at.height + bar.point_below, bar.rows.back());
  for (const double row : bar.ticks) {
    out += "<path d=\"M" + std::to_string(at.x + at.width) + " " + number(row) + "h4\" stroke=\"#1f1f24\"/>\n";
  }
  return out;
}

std::string draw_frame(const detail::Layout& layout) {
  std::string out;
  for (const detail::Bar& bar : layout.bars) out += draw_bar(bar);
  for (const detail::Swatch& s : layout.swatches) {
    out += "<rect x=\"" + std::to_string(s.at.x) + "\" y=\"" + std::to_string(s.at.y) + "\" width=\"" +
           std::to_string(s.at.width) + "\" height=\"" + std::to_string(s.at.height) + "\" fill=\"" + hex(s.color) +
           "\"/>\n";
  }
  for (const detail::TextAt& t : layout.texts) {
    // stb's height is from ascender to descender; a font-size is the em, some 1.16 times smaller in DejaVu Sans.
    constexpr double kHeightPerEm = 1.164;
    out += "<text x=\"" + number(t.x) + "\" y=\"" + number(t.y) + "\" font-family=\"DejaVu Sans, sans-serif\"" +
           " font-size=\"" + number(t.height / kHeightPerEm) + "\" fill=\"#1f1f24\">" + escaped(t.text) + "</text>\n";
  }
  return out;
}

}  // namespace

std::string render_svg(std::span<const Panel> panels, std::span<const std::vector<Polyline>> lines,
                       const RenderOptions& options) {
  detail::check_request(panels, options);
  if (!lines.empty() && lines.size() != panels.size()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(lines.size()) + " sets of lines for " +
                                                std::to_string(panels.size()) + " panels: one per panel is needed");
  }
  const detail::Font font(options.font);
  const std::vector<detail::ScalarRange> ranges = detail::ranges_of(panels, options);
  const detail::Layout layout = detail::lay_out(panels, options, ranges, font);
  const std::string size = std::to_string(layout.width) + "\" height=\"" + std::to_string(layout.height);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" viewBox=\"0 0 " +
                    std::to_string(layout.width) + " " + std::to_string(layout.height) + "\">\n";
  if (!options.transparent) out += "<rect width=\"" + size + "\" fill=\"#ffffff\"/>\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::span<const Polyline> own = lines.empty() ? std::span<const Polyline>{} : std::span(lines[i]);
    out += draw_panel(panels[i], own, options, ranges[panels[i].scale], layout.panels[i]);
  }
  return out + draw_frame(layout) + "</svg>\n";
}

}  // namespace brushfire
