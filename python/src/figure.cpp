// Pictures: a mesh with a field, lines and dots, as pixels or SVG.
#include "bind.h"

#include <brushfire/core/error.h>
#include <brushfire/figure/render.h>

#include <nanobind/stl/pair.h>

#include <algorithm>
#include <span>
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
  camera.azimuth = value_or(given, "azimuth", camera.azimuth);
  camera.elevation = value_or(given, "elevation", camera.elevation);
  camera.perspective = value_or(given, "perspective", camera.perspective);
  camera.zoom = value_or(given, "zoom", camera.zoom);
  return camera;
}

RenderOptions render_options_from(const nb::dict& given) {
  RenderOptions o;
  o.width = value_or(given, "width", o.width);
  o.height = value_or(given, "height", o.height);
  o.camera = camera_from(given);
  ColorScale& scale = o.scales.front();
  if (given.contains("colormap")) scale.colormap = colormap_named(nb::cast<std::string>(given["colormap"]));
  if (given.contains("low")) scale.low = nb::cast<double>(given["low"]);
  if (given.contains("high")) scale.high = nb::cast<double>(given["high"]);
  scale.unit = value_or<std::string>(given, "unit", "");
  o.fill = value_or(given, "bands", false) ? Fill::Bands : Fill::Smooth;
  o.colour_bar = value_or(given, "colour_bar", o.colour_bar);
  o.wireframe = value_or(given, "wireframe", o.wireframe);
  o.silhouettes = value_or(given, "silhouettes", o.silhouettes);
  o.transparent = value_or(given, "transparent", o.transparent);
  o.line_width = value_or(given, "line_width", o.line_width);
  o.path_width = value_or(given, "path_width", o.path_width);
  o.dot_size = value_or(given, "dot_size", o.dot_size);
  o.samples = value_or(given, "samples", o.samples);
  o.threads = value_or(given, "threads", o.threads);
  return o;
}

std::vector<Vec3> points_of(const Triples<double>& xyz) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < xyz.shape(0); ++k) {
    points.push_back({xyz.data()[3 * k], xyz.data()[3 * k + 1], xyz.data()[3 * k + 2]});
  }
  return points;
}

Panel panel_from(const Mesh& mesh, const nb::dict& given) {
  Panel panel;
  panel.mesh = mesh;
  const auto doubles = [&](const char* key) {
    if (!given.contains(key)) return std::vector<double>{};
    const auto array = nb::cast<Vector<double>>(given[key]);
    return std::vector<double>(array.data(), array.data() + array.shape(0));
  };
  panel.scalar = doubles("scalar");
  panel.isolines = doubles("isolines");
  panel.front = value_or(given, "front", panel.front);
  panel.title = value_or<std::string>(given, "title", "");
  if (given.contains("labels")) {
    const auto array = nb::cast<Vector<std::int64_t>>(given["labels"]);
    for (std::size_t k = 0; k < array.shape(0); ++k) {
      panel.labels.push_back(array.data()[k] < 0 ? kNoIndex : static_cast<Index>(array.data()[k]));
    }
  }
  if (given.contains("dots")) panel.dots = points_of(nb::cast<Triples<double>>(given["dots"]));
  if (given.contains("paths")) {
    for (const nb::handle entry : given["paths"]) {
      const auto [xyz, closed] = nb::cast<std::pair<Triples<double>, bool>>(entry);
      panel.paths.push_back({points_of(xyz), closed});
    }
  }
  return panel;
}

// [height, width, 4] uint8.
Result<std::uint8_t> picture(const Mesh& mesh, const nb::dict& given) {
  const Panel panel = panel_from(mesh, given);
  const RenderOptions options = render_options_from(given);
  Image image;
  {
    const nb::gil_scoped_release release;
    image = render(std::span(&panel, 1), options);
  }
  const auto height = static_cast<std::size_t>(image.height), width = static_cast<std::size_t>(image.width);
  return to_numpy(std::move(image.rgba), {height, width, 4});
}

nb::bytes png(const nb::ndarray<const std::uint8_t, nb::shape<-1, -1, 4>, nb::c_contig, nb::device::cpu>& rgba) {
  Image image(static_cast<int>(rgba.shape(1)), static_cast<int>(rgba.shape(0)));
  std::copy(rgba.data(), rgba.data() + rgba.size(), image.rgba.begin());
  const std::vector<std::uint8_t> bytes = encode_png(image);
  return nb::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace

void bind_figure(nb::module_& m) {
  m.def("render", picture, nb::arg("mesh"), nb::arg("given"));
  m.def("encode_png", png, nb::arg("rgba").noconvert());
}

}  // namespace brushfire::python
