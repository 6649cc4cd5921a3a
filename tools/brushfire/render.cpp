// brushfire render: pictures of distance fields, isolines and paths.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "render_panels.h"
#include "sources.h"
#include "surface.h"
#include "weights.h"

#include <brushfire/core/detail/memory.h>
#include <brushfire/figure/ambient_occlusion.h>
#include <brushfire/figure/render.h>
#include <brushfire/io/write_bytes.h>
#include <brushfire/queries/isolines.h>
#include <brushfire/solvers/distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire render bunny.ply --source 0 -o bunny.png
  brushfire render bunny.ply --source 0 --isolines 30 --colormap magma --view iso -o bunny.svg
  brushfire render bunny.ply --source 0 --path 12000 --path 300 --bands --isolines 40 -o paths.png
  brushfire render bunny.ply --scalar error.npy --range 0,0.01 --bar-title "relative error" -o error.png
  brushfire render bunny.ply --source 0 --method kimmel-sethian --method exact --error -o side-by-side.png
  brushfire render bunny.ply --source drawn.obj --signed --isolines 24 -o sides.png
  brushfire render bunny.ply --source 0 --isolines 20 --ambient-occlusion -o crevices.png
  brushfire render bunny.ply --source 0 --wave 60 -o brushfire.webp
  brushfire render bunny.ply --source 0 --isolines 20 --turntable 72 -o turntable.webp

The extension of -o decides: .png, .svg (lines as vectors over the shaded surface), .webp (animations).
Places (--source, --path) are written as for brushfire distance.)";

struct Arguments {
  std::string file, labels_file, output, view, size = "1024x768", range, error_range, bar_title, title;
  std::string colormap = "viridis", up = "y", font;
  SharedArguments shared;
  std::vector<std::string> paths;
  std::optional<double> azimuth, elevation, zoom;
  std::optional<int> isolines, samples, turntable, wave, frame_ms;
  bool bands = false, labels = false, perspective = false, transparent = false, wireframe = false, no_bar = false;
  bool error = false, ambient_occlusion = false, is_signed = false;
};

// "1024x768", "0,2.5": two numbers and what stands between them.
std::pair<double, double> two_numbers(const std::string& text, char between, const char* what) {
  const std::optional<std::vector<double>> values = decimals(text, between);
  if (!values || values->size() != 2) refuse(in_quotes(text) + ": " + what);
  return {(*values)[0], (*values)[1]};
}

void set_range(const std::string& text, const char* what, ColorScale& scale) {
  if (text.empty()) return;
  const auto [low, high] = two_numbers(text, ',', what);
  scale.low = low;
  scale.high = high;
}

// What the colours are: as said, or "distance, mm", or the name of the values' file.
std::string bar_title(const Arguments& a) {
  if (!a.bar_title.empty()) return a.bar_title;
  const std::string what =
      a.shared.scalar_file.empty() ? "distance" : std::filesystem::path(a.shared.scalar_file).stem().string();
  return a.shared.unit.empty() ? what : what + ", " + a.shared.unit;
}

RenderOptions options_of(const Arguments& a) {
  RenderOptions options;
  const auto [width, height] = two_numbers(a.size, 'x', "a size is written as 1024x768");
  if (width != std::floor(width) || height != std::floor(height)) refuse("a size is written as 1024x768");
  constexpr double kAnyInt = 1e6;  // render() itself says what it takes
  if (std::abs(width) > kAnyInt || std::abs(height) > kAnyInt) refuse("'" + a.size + "' is too large a picture");
  options.width = static_cast<int>(width);
  options.height = static_cast<int>(height);
  options.scales.resize(2);
  options.scales[kValues].colormap = colormap_named(a.colormap);
  options.scales[kValues].unit = bar_title(a);
  set_range(a.range, "a range is written as 0,2.5", options.scales[kValues]);
  options.scales[kErrors].colormap = Colormap::Magma;
  options.scales[kErrors].unit = "error, %";
  options.scales[kErrors].low = 0;
  set_range(a.error_range, "a range of errors is written in percent, as 0,2.5", options.scales[kErrors]);
  options.fill = a.bands ? Fill::Bands : Fill::Smooth;
  options.colour_bar = !a.no_bar;
  options.transparent = a.transparent;
  options.wireframe = a.wireframe;
  options.font = a.font;
  options.samples = a.samples.value_or(options.samples);
  options.camera.up = a.up == "x" ? Axis::X : a.up == "z" ? Axis::Z : Axis::Y;
  if (!a.view.empty()) options.camera = named_view(a.view, options.camera);
  options.camera.azimuth = a.azimuth.value_or(options.camera.azimuth);
  options.camera.elevation = a.elevation.value_or(options.camera.elevation);
  options.camera.zoom = a.zoom.value_or(1);
  options.camera.perspective = a.perspective;
  return options;
}

enum class Output { Png, Svg, Webp };

Output output_of(const Arguments& a) {
  std::string extension = std::filesystem::path(a.output).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  const bool animated = a.turntable.has_value() || a.wave.has_value();
  if (extension == ".webp") {
    if (!animated) refuse("a .webp needs --turntable or --wave; still pictures are .png or .svg");
    return Output::Webp;
  }
  if (animated) refuse("--turntable and --wave write an animation: name the output .webp");
  if (extension == ".svg") return Output::Svg;
  if (extension == ".png") return Output::Png;
  refuse(a.output.empty() ? "where to? give -o picture.png, .svg or .webp"
                          : "'" + a.output + "': pictures are written as .png, .svg or .webp");
}

void check(const Arguments& a) {
  const bool has_source = given(a.shared, {Shared::Source, Shared::Sources}) != nullptr;
  const char* const computing = given(a.shared, kComputing);
  if (has_source || !a.shared.scalar_file.empty()) check_scalar_or_source(a.shared);
  if (!has_source && !a.paths.empty()) refuse("--path needs a --source to come from");
  if (!has_source && a.labels) refuse("--labels colours by the nearest --source: give some");
  if (const char* name = given(a.shared, kWeights); name != nullptr && !has_source) {
    refuse(std::string(name) + " needs a --source");
  }
  if (!has_source && computing) refuse(std::string(computing) + " needs a --source");
  if (a.is_signed && !has_source) refuse("--signed needs curves as --source");
  if (a.is_signed) check_signed(a.shared);
  if (a.error && a.shared.methods.size() < 2) refuse("--error compares with the last --method: give at least two");
  if (!a.error_range.empty() && !a.error) refuse("--error-range is the range of the colours of --error");
  if (a.ambient_occlusion && !has_ambient_occlusion()) {
    refuse(
        "--ambient-occlusion needs Embree, which this brushfire was built without: install Embree 3 or 4 (Debian: "
        "libembree-dev) and build again");
  }
  if (a.wave && a.turntable) refuse("--wave and --turntable are two animations: give one");
  if (a.wave && !has_source && a.shared.scalar_file.empty()) refuse("--wave needs a --source or a --scalar");
}

Panel read_panel(const Arguments& a, const Surface& surface) {
  Panel panel;
  panel.mesh = surface.mesh();
  const std::string& file = a.shared.scalar_file;
  if (!file.empty()) panel.scalar = values_on(surface, file, a.shared.array_name);
  if (!a.labels_file.empty()) panel.labels = labels_of(a.labels_file, surface, panel);
  return panel;
}

// One for each method.
std::vector<Panel> solved_panels(const Arguments& a, const Surface& surface, PlaceFinder& places,
                                 RenderOptions& options, const Talk& talk) {
  std::vector<DistanceOptions> methods =
      a.shared.methods.empty() ? std::vector{computation(a.shared, a.is_signed ? Method::Exact : Method::Windows)}
                               : computations(a.shared, {});
  methods.front().keep_paths = a.is_signed;
  weigh(methods.front(), a.shared, surface);
  Shown shown{sources_on(surface, places, parse_sources(a.shared)), parse_places(a.paths, "the end of a path"), {}};
  find_paths(surface, places, methods.front(), shown);
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    panels.push_back(solved_panel(surface.domain(), shown, methods[i], talk));
    if (methods.size() > 1) panels.back().title = a.shared.methods[i];
  }
  if (a.labels) add_cells(surface, shown, methods.front(), panels);
  if (!shown.sources.empty() && a.view.empty() && !a.azimuth && !a.elevation) {
    options.camera = turned_to(outward_at(surface.mesh(), shown.sources.front()), options.camera);
  }
  return panels;
}

std::vector<Panel> panels_of(const Arguments& a, const Surface& surface, PlaceFinder& places, RenderOptions& options,
                             const Talk& talk) {
  std::vector<Panel> panels;
  if (given(a.shared, {Shared::Source, Shared::Sources})) {
    panels = solved_panels(a, surface, places, options, talk);
  } else {
    panels.push_back(read_panel(a, surface));
  }
  if (a.error) {
    ColorScale& scale = options.scales[kErrors];
    const double high = add_errors(panels);
    if (!scale.high && high > 0) scale.high = high;
  }
  if (a.ambient_occlusion) add_ambient_occlusion(surface.mesh(), talk, panels);
  if (!a.title.empty()) panels.front().title = a.title;
  return panels;
}

// The least and the greatest value; first > second where there is none.
std::pair<double, double> extent_of(const std::vector<Panel>& panels) {
  double low = kInfinity, high = -kInfinity;
  for (const Panel& p : panels) {
    if (p.scale != kValues) continue;
    for (const double x : p.scalar) {
      if (!std::isfinite(x)) continue;
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  return {low, high};
}

// The same levels in all panels: N of them evenly between the least and the greatest value, ends left out.
void add_isolines(const Arguments& a, std::vector<Panel>& panels) {
  constexpr int kDefaultBands = 20;
  const int count = a.isolines.value_or(a.bands ? kDefaultBands : 0);
  const auto [low, high] = extent_of(panels);
  for (Panel& p : panels) {
    if (p.scale != kValues) continue;
    p.isolines = levels_between(std::array{low, high}, static_cast<Index>(count));
  }
}

std::string svg_of(const std::vector<Panel>& panels, const RenderOptions& options) {
  std::vector<std::vector<Polyline>> lines(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (panels[i].scalar.empty() || options.fill == Fill::Bands) continue;
    for (const Isoline& line : isolines(panels[i].mesh, panels[i].scalar, panels[i].isolines)) {
      Polyline& out = lines[i].emplace_back();
      out.closed = line.line.closed;
      for (const SurfacePoint& p : line.line.points) out.points.push_back(position(panels[i].mesh, p));
    }
  }
  return render_svg(panels, lines, options);
}

std::vector<std::uint8_t> animation_of(const Arguments& a, std::vector<Panel> panels, RenderOptions options,
                                       const Talk& talk) {
  const bool turning = a.turntable.has_value();
  const int count = turning ? *a.turntable : *a.wave;
  const double high = std::max(0.0, extent_of(panels).second);
  const double azimuth = options.camera.azimuth;
  const Progress progress = talk.progress("frames");
  constexpr std::uint64_t kBytesPerPixel = 4;
  require_memory(kBytesPerPixel * static_cast<std::uint64_t>(count) * panels.size() *
                     static_cast<std::uint64_t>(options.width) * static_cast<std::uint64_t>(options.height),
                 0, "an animation of " + std::to_string(count) + " frames of this size",
                 "ask for fewer or smaller ones");
  std::vector<Image> frames;
  for (int i = 0; i < count; ++i) {
    stop_if_interrupted();
    if (turning) {
      options.camera.azimuth = azimuth + 360.0 * i / count;
    } else {
      for (Panel& p : panels) {
        if (p.scale == kValues) p.front = high * (i + 1) / count;
      }
    }
    frames.push_back(render(panels, options));
    if (progress) progress((i + 1.0) / count);
  }
  talk.end_progress();
  constexpr int kFrame = 40;
  return encode_webp(frames, a.frame_ms.value_or(kFrame));
}

int render_verb(const Arguments& a, const Talk& talk) {
  check(a);
  const Output output = output_of(a);
  RenderOptions options = options_of(a);
  const Surface surface(a.file, a.shared);
  PlaceFinder places(surface.mesh(), a.shared.snap_within);
  std::vector<Panel> panels = panels_of(a, surface, places, options, talk);
  places.tell(talk);
  add_isolines(a, panels);
  switch (output) {
    case Output::Png:
      write_bytes(a.output, encode_png(render(panels, options)));
      break;
    case Output::Svg:
      write_text(a.output, svg_of(panels, options));
      break;
    case Output::Webp:
      write_bytes(a.output, animation_of(a, panels, options, talk));
      break;
  }
  if (talk.json) {
    Record record;
    record.add("file", a.file).add("output", a.output).add("panels", static_cast<std::int64_t>(panels.size()));
    places.add_to(record);
    write_stdout(record.json());
  }
  return kOk;
}

}  // namespace

void add_render(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("render", "Picture of a mesh and what was computed on it", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.option("--label-file", a->labels_file, "FIELD", "Show these labels, one per vertex");
    verb.flag("--labels", a->labels, "Colour by the nearest source");
    verb.flag("--signed", a->is_signed,
              "From curves: negative on their left, as inside of those that run counter-clockwise");
    verb.flag("--error", a->error, "One more panel for each method but the last: its error against the last");
    verb.option("--isolines", a->isolines, "N", whole_from(0, 10000), "This many isolines");
    verb.flag("--bands", a->bands, "Bands of alternating lightness between the isolines");
    verb.option("--path", a->paths, "PLACE", "Draw the shortest path from the sources to here; may be repeated");
    verb.option("--view", a->view, "NAME",
                "front, back, left, right, top, bottom or iso; the side of the source if nothing is said");
    verb.option("--azimuth", a->azimuth, "DEG", kAnyNumber, "Degrees around the up axis");
    verb.option("--elevation", a->elevation, "DEG", kAnyNumber, "Degrees above the horizon");
    verb.choice("--up", a->up, {"x", "y", "z"}, "The axis that points up");
    verb.option("--zoom", a->zoom, "F", kPositive, "Closer than what fits, by this factor");
    verb.flag("--perspective", a->perspective, "Perspective instead of orthographic");
    verb.option("--size", a->size, "WxH", "Of a panel, in pixels");
    verb.choice("--colormap", a->colormap, {"viridis", "magma", "cividis"}, "Colours");
    verb.option("--range", a->range, "LO,HI", "Range of the colours");
    verb.option("--error-range", a->error_range, "LO,HI",
                "Range of the colours of --error, in percent (0 to what 99 % stay under)");
    verb.option("--bar-title", a->bar_title, "TEXT", "Above the colour bar; what it shows, and --unit, if not given");
    verb.option("--title", a->title, "TEXT", "Above the (first) panel");
    verb.flag("--no-bar", a->no_bar, "No colour bar and no legend");
    verb.flag("--wireframe", a->wireframe, "Show the edges of the mesh");
    verb.flag("--ambient-occlusion", a->ambient_occlusion, "Darken crevices (where built with Embree)");
    verb.flag("--transparent", a->transparent, "Transparent background");
    verb.option("--samples", a->samples, "N", whole_from(1, 8), "Samples per pixel and direction, 1 to 8");
    verb.option("--font", a->font, "TTF", "A TrueType font for the text, for letters that the built-in one lacks");
    verb.option("--turntable", a->turntable, "N", whole_from(2, 720), "Animate: once around in N frames");
    verb.option("--wave", a->wave, "N", whole_from(2, 2000), "Animate: the fire spreading, in N frames");
    verb.option("--frame-ms", a->frame_ms, "MS", whole_from(10, 10000), "How long a frame of an animation is shown");
    verb.option("-o,--output", a->output, "FILE", "The picture: .png .svg .webp");
    verb.talks();
    add_shared(verb, a->shared, {.method = "windows; given several times: panels side by side"});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return render_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
