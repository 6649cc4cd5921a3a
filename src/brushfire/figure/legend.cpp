// Layout of the picture around its panels.
#include <brushfire/figure/detail/legend.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace brushfire::detail {
namespace {

constexpr Color kInk{0.12F, 0.12F, 0.14F};
constexpr int kPad = 12;

double text_height(const RenderOptions& options) {
  constexpr double kSmallest = 17, kShareOfHeight = 0.032;  // still read where the picture is shown at half its size
  return std::max(kSmallest, kShareOfHeight * options.height);
}

// 1, 2 or 5 times a power of ten: the step that gives about `count` ticks.
double nice_step(double span, int count) {
  const double raw = span / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

std::string number(double x, double step) {
  char text[64];
  const double magnitude = std::max(std::abs(x), step);
  constexpr double kLargePlain = 1e5, kSmallPlain = 1e-4;
  if (magnitude >= kLargePlain || step < kSmallPlain) {
    std::snprintf(text, sizeof text, "%.3g", x);
  } else {
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    std::snprintf(text, sizeof text, "%.*f", decimals, x == 0 ? 0.0 : x);
  }
  return text;
}

struct Tick {
  double value;
  std::string text;
};

std::vector<Tick> ticks_of(ScalarRange range) {
  const double span = range.high - range.low;
  if (!(span > 0)) return {{range.low, number(range.low, std::max(std::abs(range.low), 1e-4))}};
  constexpr int kTicks = 6;
  const double step = nice_step(span, kTicks);
  std::vector<Tick> ticks;
  for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * span; ++k) {
    ticks.push_back({k * step, number(k * step, step)});
  }
  return ticks;
}

// Whether no panel after the first of these has the first one's scale: its bar follows it.
bool last_of_its_scale(std::span<const Panel> panels) {
  const auto coloured = [&](const Panel& p) {
    return !p.scalar.empty() && p.labels.empty() && p.scale == panels.front().scale;
  };
  return coloured(panels.front()) && std::none_of(panels.begin() + 1, panels.end(), coloured);
}

// Whether a face is drawn without a value in a panel of this scale.
bool lacks_values(std::span<const Panel> panels, std::size_t scale) {
  return std::any_of(panels.begin(), panels.end(), [&](const Panel& p) {
    if (p.scalar.empty() || !p.labels.empty() || p.scale != scale) return false;
    return std::any_of(p.mesh.faces().begin(), p.mesh.faces().end(), [&](const Face& t) {
      return !(std::isfinite(p.scalar[t[0]]) && std::isfinite(p.scalar[t[1]]) && std::isfinite(p.scalar[t[2]]));
    });
  });
}

// Of the finite values of one scale; (0, 0) where there are none.
ScalarRange extent_of(std::span<const Panel> panels, std::size_t scale) {
  ScalarRange all{kInfinity, -kInfinity};
  for (const Panel& p : panels) {
    if (p.scale != scale) continue;
    for (const double x : p.scalar) {
      if (!std::isfinite(x)) continue;
      all.low = std::min(all.low, x);
      all.high = std::max(all.high, x);
    }
  }
  return all.low > all.high ? ScalarRange{0, 0} : all;
}

struct LegendEntry {
  Color color;
  std::string name;
};

// The labels in use. Where colours serve for several labels, which name no label: none.
std::vector<LegendEntry> legend_entries(std::span<const Panel> panels) {
  std::set<Index> used, colors;
  for (const Panel& p : panels) used.insert(p.labels.begin(), p.labels.end());
  used.erase(kNoIndex);
  std::vector<LegendEntry> entries;
  for (const Index label : used) {
    LegendEntry entry{label_color(label), std::to_string(label)};
    for (const Panel& p : panels) {
      if (label < p.label_names.size()) entry.name = p.label_names[label];
      if (label >= p.label_colors.size()) continue;
      if (!colors.insert(p.label_colors[label]).second && panels.size() == 1) return {};
      entry.color = label_color(p.label_colors[label]);
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

class Builder {
 public:
  Builder(std::span<const Panel> panels, const RenderOptions& options, const Font& font)
      : options_(options), font_(font), size_(text_height(options)) {
    const bool titled = std::any_of(panels.begin(), panels.end(), [](const Panel& p) { return !p.title.empty(); });
    top_ = titled ? static_cast<int>(1.9 * size_) : 0;
    layout_.height = options.height + top_;
  }

  void add_panel(const Panel& panel) {
    layout_.panels.push_back({layout_.width, top_, options_.width, options_.height});
    add_title(panel.title, layout_.width);
    layout_.width += options_.width;
  }

  // `extent` is that of the values, which may go beyond the range of the colours.
  void add_bar(const ColorScale& scale, ScalarRange range, ScalarRange extent, std::span<const double> levels,
               bool with_no_value) {
    const int x = layout_.width + kPad, width = static_cast<int>(std::max(14.0, 0.9 * size_));
    const int point = static_cast<int>(1.3 * size_);  // tall enough for what is written beside it
    const int above = extent.high > range.high ? point : 0, below = extent.low < range.low ? point : 0;
    const int unit_room = (scale.unit.empty() ? 0 : static_cast<int>(1.6 * size_)) + above;
    const int height = std::max(16, static_cast<int>(0.82 * options_.height) - unit_room - below);
    const Rectangle at{x, top_ + unit_room + (options_.height - height - unit_room - below) / 2, width, height};
    Bar& bar = layout_.bars.emplace_back(Bar{at, bar_rows(scale, range, levels, height), above, below, {}});
    double right = at.x + width;
    const double span = range.high - range.low;
    for (const Tick& tick : ticks_of(range)) {
      const double share = span > 0 ? (tick.value - range.low) / span : 0.5;
      const double row = at.y + (1 - share) * (at.height - 1);
      bar.ticks.push_back(row);
      right = std::max(right, add_text(at.x + width + 7, row + 0.32 * size_, tick.text));
    }
    const auto beyond = [&](double value, double baseline) {
      right = std::max(right, add_text(at.x + width + 7, baseline, "to " + number(value, 0.1 * std::abs(value))));
    };
    if (above > 0) beyond(extent.high, at.y - 0.75 * size_);
    if (below > 0) beyond(extent.low, at.y + height + 1.4 * size_);
    if (!scale.unit.empty()) right = std::max(right, add_text(x, at.y - above - 0.6 * size_, scale.unit));
    if (with_no_value) {
      const int side = static_cast<int>(0.75 * size_), y = at.y + at.height + below + static_cast<int>(0.6 * size_);
      layout_.swatches.push_back({{x, y, side, side}, kNoValueColor});
      right = std::max(right, add_text(x + side + 7, y + 0.88 * side, "no value"));
    }
    layout_.width = static_cast<int>(std::ceil(right)) + kPad;
  }

  void add_legend(const std::vector<LegendEntry>& entries) {
    const int x = layout_.width + kPad, side = static_cast<int>(size_);
    const double row_height = 1.45 * size_;
    const auto room = static_cast<std::size_t>(std::max(1.0, (options_.height - 2 * kPad) / row_height));
    double right = x + side, y = top_ + kPad;
    for (std::size_t i = 0; i < entries.size(); ++i, y += row_height) {
      if (i + 1 == room && entries.size() > room) {
        right = std::max(right, add_text(x, y + 0.85 * size_, "+ " + std::to_string(entries.size() - i) + " more"));
        break;
      }
      layout_.swatches.push_back({{x, static_cast<int>(y), side, side}, entries[i].color});
      right = std::max(right, add_text(x + side + 7, y + 0.85 * size_, entries[i].name));
    }
    layout_.width = static_cast<int>(std::ceil(right)) + kPad;
  }

  Layout take() { return std::move(layout_); }

 private:
  // Colours of the bar from the top, bands as they are on the surface.
  std::vector<Color> bar_rows(const ColorScale& scale, ScalarRange range, std::span<const double> levels,
                              int height) const {
    std::vector<Color> rows;
    for (int row = 0; row < height; ++row) {
      const double share = 1 - static_cast<double>(row) / std::max(1, height - 1);
      rows.push_back(
          value_color(range.low + share * (range.high - range.low), range, scale.colormap, options_.fill, levels));
    }
    return rows;
  }

  // Returns where the text ends.
  double add_text(double x, double y, const std::string& text) {
    layout_.texts.push_back({x, y, size_, text});
    return x + font_.width(text, size_);
  }

  void add_title(const std::string& title, int panel_x) {
    if (title.empty()) return;
    // Too long for its panel: smaller, so that nothing is cut.
    const double wide = font_.width(title, size_ * 1.15);
    const double fit = std::min(1.0, (options_.width - 2.0 * kPad) / std::max(wide, 1.0));
    const double size = size_ * 1.15 * fit;
    const double x = panel_x + 0.5 * (options_.width - font_.width(title, size));
    layout_.texts.push_back({x, 0.72 * top_, size, title});
  }

  const RenderOptions& options_;
  const Font& font_;
  double size_;
  int top_ = 0;
  Layout layout_;
};

}  // namespace

std::vector<ScalarRange> ranges_of(std::span<const Panel> panels, const RenderOptions& options) {
  std::vector<ScalarRange> ranges(options.scales.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const ScalarRange all = extent_of(panels, i);
    ranges[i] = {options.scales[i].low.value_or(all.low), options.scales[i].high.value_or(all.high)};
  }
  return ranges;
}

Layout lay_out(std::span<const Panel> panels, const RenderOptions& options, std::span<const ScalarRange> ranges,
               const Font& font) {
  Builder builder(panels, options, font);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    builder.add_panel(panels[i]);
    const std::size_t scale = panels[i].scale;
    if (options.colour_bar && last_of_its_scale(panels.subspan(i))) {
      builder.add_bar(options.scales[scale], ranges[scale], extent_of(panels, scale), panels[i].isolines,
                      lacks_values(panels, scale));
    }
  }
  if (options.colour_bar) {
    const auto entries = legend_entries(panels);
    if (!entries.empty()) builder.add_legend(entries);
  }
  return builder.take();
}

namespace {

void fill(Image& picture, Rectangle r, Color c) {
  for (int y = std::max(0, r.y); y < std::min(picture.height, r.y + r.height); ++y) {
    for (int x = std::max(0, r.x); x < std::min(picture.width, r.x + r.width); ++x) {
      blend_over(picture.pixel(x, y), c, 1);
    }
  }
}

void paint_bar(const Bar& bar, Image& picture) {
  const Rectangle& at = bar.at;
  for (int row = 0; row < at.height; ++row) {
    fill(picture, {at.x, at.y + row, at.width, 1}, bar.rows[static_cast<std::size_t>(row)]);
  }
  const auto point_row = [&](int y, int step, int steps, Color color) {
    const int inset = (step + 1) * at.width / (2 * steps);
    fill(picture, {at.x + inset, y, at.width - 2 * inset, 1}, color);
  };
  for (int i = 0; i < bar.point_above; ++i) point_row(at.y - 1 - i, i, bar.point_above, bar.rows.front());
  for (int i = 0; i < bar.point_below; ++i) point_row(at.y + at.height + i, i, bar.point_below, bar.rows.back());
  for (const double row : bar.ticks) {
    constexpr int kTickLength = 4;
    fill(picture, {at.x + at.width, static_cast<int>(std::lround(row)), kTickLength, 1}, kInk);
  }
}

}  // namespace

void paint(const Layout& layout, const Font& font, Image& picture) {
  for (const Bar& bar : layout.bars) paint_bar(bar, picture);
  for (const Swatch& s : layout.swatches) fill(picture, s.at, s.color);
  for (const TextAt& t : layout.texts) font.write(picture, t.x, t.y, t.height, t.text, kInk);
}

}  // namespace brushfire::detail
