// Pictures: meshes with fields, lines and dots, as pixels, SVG or frames.
#include "interrupt.h"
#include "options.h"

#include <brushfire/core/error.h>
#include <brushfire/figure/ambient_occlusion.h>
#include <brushfire/figure/render.h>

#include <nanobind/stl/pair.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace brushfire::python {
namespace {

template <class T>
T value_or(const nb::dict& given, const char* key, T otherwise) {
  return given.contains(key) ? nb::cast<T>(given[key]) : otherwise;
}

Axis axis_named(const std::string& name) {
  if (name == "x") return Axis::X;
  if (name == "y") return Axis::Y;
  if (name == "z") return Axis::Z;
  throw Error(ErrorCode::InvalidArgument, "unknown axis '" + name + "': it is x, y or z");
}

Camera camera_from(const nb::dict& given) {
  Camera camera;
  camera.up = axis_named(value_or<std::string>(given, "up", "y"));
  if (given.contains("view")) camera = named_view(nb::cast<std::string>(given["view"]), camera);
  camera.azimuth = value_or(given, "azimuth", camera.azimuth) + value_or(given, "turn", 0.0);
  camera.elevation = value_or(given, "elevation", camera.elevation);
  camera.perspective = value_or(given, "perspective", camera.perspective);
  camera.zoom = value_or(given, "zoom", camera.zoom);
  return camera;
}

ColorScale scale_from(const nb::dict& given) {
  require_known(given, {"colormap", "low", "high", "bar_title"});
  ColorScale scale;
  if (given.contains("colormap")) scale.colormap = colormap_named(nb::cast<std::string>(given["colormap"]));
  if (given.contains("low")) scale.low = nb::cast<double>(given["low"]);
  if (given.contains("high")) scale.high = nb::cast<double>(given["high"]);
  scale.unit = value_or<std::string>(given, "bar_title", "");
  return scale;
}

RenderOptions render_options_from(const nb::dict& given) {
  require_known(given,
                {"up",          "view",       "azimuth",    "turn",     "elevation", "perspective", "zoom",
                 "width",       "height",     "scales",     "bands",    "bar",       "wireframe",   "silhouettes",
                 "transparent", "line_width", "path_width", "dot_size", "samples",   "threads",     "font"});
  RenderOptions o;
  o.width = value_or(given, "width", o.width);
  o.height = value_or(given, "height", o.height);
  o.camera = camera_from(given);
  o.scales.clear();
  for (const nb::handle scale : given["scales"]) o.scales.push_back(scale_from(nb::cast<nb::dict>(scale)));
  o.fill = value_or(given, "bands", false) ? Fill::Bands : Fill::Smooth;
  o.colour_bar = value_or(given, "bar", o.colour_bar);
  o.wireframe = value_or(given, "wireframe", o.wireframe);
  o.silhouettes = value_or(given, "silhouettes", o.silhouettes);
  o.transparent = value_or(given, "transparent", o.transparent);
  o.line_width = value_or(given, "line_width", o.line_width);
  o.path_width = value_or(given, "path_width", o.path_width);
  o.dot_size = value_or(given, "dot_size", o.dot_size);
  o.samples = value_or(given, "samples", o.samples);
  o.threads = value_or(given, "threads", o.threads);
  o.font = value_or<std::string>(given, "font", "");
  return o;
}

std::vector<Vec3> points_of(const Triples<double>& xyz) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < xyz.shape(0); ++k) {
    points.push_back({xyz.data()[3 * k], xyz.data()[3 * k + 1], xyz.data()[3 * k + 2]});
  }
  return points;
}

std::vector<Polyline> polylines_from(const nb::dict& given, const char* key) {
  std::vector<Polyline> lines;
  if (!given.contains(key)) return lines;
  for (const nb::handle entry : given[key]) {
    const auto [xyz, closed] = nb::cast<std::pair<Triples<double>, bool>>(entry);
    lines.push_back({points_of(xyz), closed});
  }
  return lines;
}

using OpennessArray = nb::ndarray<const float, nb::shape<-1, 3, 2>, nb::c_contig, nb::device::cpu>;

Panel panel_from(const Mesh& mesh, const nb::dict& given) {
  require_known(given, {"scalar", "isolines", "labels", "label_names", "scale", "front", "title", "dots", "paths",
                        "lines", "openness"});
  Panel panel;
  panel.mesh = mesh;
  const auto doubles = [&](const char* key) {
    if (!given.contains(key)) return std::vector<double>{};
    const auto array = nb::cast<Vector<double>>(given[key]);
    return std::vector<double>(array.data(), array.data() + array.shape(0));
  };
  panel.scalar = doubles("scalar");
  panel.isolines = doubles("isolines");
  panel.scale = value_or(given, "scale", panel.scale);
  panel.front = value_or(given, "front", panel.front);
  panel.title = value_or<std::string>(given, "title", "");
  if (given.contains("labels")) {
    const auto array = nb::cast<Vector<std::int64_t>>(given["labels"]);
    for (std::size_t k = 0; k < array.shape(0); ++k) {
      panel.labels.push_back(array.data()[k] < 0 ? kNoIndex : static_cast<Index>(array.data()[k]));
    }
  }
  if (given.contains("label_names")) {
    for (const nb::handle name : given["label_names"]) panel.label_names.push_back(nb::cast<std::string>(name));
  }
  if (given.contains("dots")) panel.dots = points_of(nb::cast<Triples<double>>(given["dots"]));
  panel.paths = polylines_from(given, "paths");
  if (given.contains("openness")) {
    const auto array = nb::cast<OpennessArray>(given["openness"]);
    for (std::size_t k = 0; k < 3 * array.shape(0); ++k) {
      panel.openness.push_back({array.data()[2 * k], array.data()[2 * k + 1]});
    }
  }
  return panel;
}

// A list of (mesh, what is shown on it).
std::vector<Panel> panels_from(const nb::list& given) {
  std::vector<Panel> panels;
  for (const nb::handle entry : given) {
    const auto [mesh, shown] = nb::cast<std::pair<Mesh, nb::dict>>(entry);
    panels.push_back(panel_from(mesh, shown));
  }
  return panels;
}

// [height, width, 4] uint8.
Result<std::uint8_t> picture(const nb::list& given, const nb::dict& look) {
  const std::vector<Panel> panels = panels_from(given);
  const RenderOptions options = render_options_from(look);
  Image image = listening(false, [&] { return render(panels, options); });
  const auto height = static_cast<std::size_t>(image.height), width = static_cast<std::size_t>(image.width);
  return to_numpy(std::move(image.rgba), {height, width, 4});
}

// The panels' isolines come as their `lines`.
std::string svg(const nb::list& given, const nb::dict& look) {
  const std::vector<Panel> panels = panels_from(given);
  std::vector<std::vector<Polyline>> lines;
  for (const nb::handle entry : given) {
    lines.push_back(polylines_from(nb::cast<std::pair<Mesh, nb::dict>>(entry).second, "lines"));
  }
  const RenderOptions options = render_options_from(look);
  return listening(false, [&] { return render_svg(panels, lines, options); });
}

using Pixels = nb::ndarray<const std::uint8_t, nb::shape<-1, -1, 4>, nb::c_contig, nb::device::cpu>;

Image image_from(const Pixels& rgba) {
  Image image(static_cast<int>(rgba.shape(1)), static_cast<int>(rgba.shape(0)));
  std::copy(rgba.data(), rgba.data() + rgba.size(), image.rgba.begin());
  return image;
}

nb::bytes to_bytes(const std::vector<std::uint8_t>& bytes) {
  return nb::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

nb::bytes png(const Pixels& rgba) {
  const Image image = image_from(rgba);
  return to_bytes(listening(false, [&] { return encode_png(image); }));
}

nb::bytes webp(const nb::list& frames, int milliseconds) {
  std::vector<Image> images;
  for (const nb::handle frame : frames) images.push_back(image_from(nb::cast<Pixels>(frame)));
  return to_bytes(listening(false, [&] { return encode_webp(images, milliseconds); }));
}

// [face_count, 3, 2] float32.
Result<float> openness(const Mesh& mesh, int directions, double reach, unsigned threads, nb::object progress) {
  Computation computation(std::move(progress));
  AmbientOcclusionOptions options;
  options.directions = directions;
  options.reach = reach;
  options.threads = threads;
  options.progress = computation.progress();
  options.cancel = computation.cancel();
  const auto found = computation.run(false, [&] { return ambient_occlusion(mesh, options); });
  std::vector<float> flat;
  flat.reserve(2 * found.size());
  for (const auto& [front, back] : found) flat.insert(flat.end(), {front, back});
  return to_numpy(std::move(flat), {found.size() / 3, 3, 2});
}

}  // namespace

void bind_figure(nb::module_& m) {
  m.def("render", picture, nb::arg("panels"), nb::arg("look"));
  m.def("render_svg", svg, nb::arg("panels"), nb::arg("look"));
  m.def("encode_png", png, nb::arg("rgba").noconvert());
  m.def("encode_webp", webp, nb::arg("frames"), nb::arg("milliseconds"));
  m.def("ambient_occlusion", openness, nb::arg("mesh"), nb::arg("directions"), nb::arg("reach"), nb::arg("threads"),
        nb::arg("progress").none());
}

}  // namespace brushfire::python
