// Masks, labels and lists from files become barriers.
#include "walls.h"

#include "fields.h"

#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::tool {
namespace {

// Open where the value is above 0: masks, label keys, anything measured. A FreeSurfer label lists the vertices that it
// means, whatever their values.
std::vector<std::uint8_t> open_by_mask(const std::string& file, Index count) {
  LoadedField field = read_field(file);
  if (field.format == "FreeSurfer label") std::fill(field.values.begin(), field.values.end(), 1.0);
  if (field.vertices.empty() && field.values.size() != count) {
    refuse("--mask " + file + ": " + counted(field.values.size(), "value", "values") + ", but the mesh has " +
           std::to_string(count) + " vertices");
  }
  std::vector<std::uint8_t> open;
  for (const double value : values_on_vertices(field, count, 0)) open.push_back(value > 0);
  return open;
}

// FILE:LABEL,LABEL,...: where the value is one of these keys, or the key of one of these names.
std::vector<std::uint8_t> open_by_region(const std::string& text, Index count) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
    refuse("--region takes FILE:LABEL,... (cortex.annot:precentral,postcentral), not " + in_quotes(text));
  }
  const std::string file = text.substr(0, colon);
  const LoadedField field = read_field(file);
  const std::vector<double> keys = keys_named(field, std::string_view(text).substr(colon + 1), file, "--region");
  std::vector<std::uint8_t> open;
  for (const double value : values_of(field, file, count, "the mesh")) {
    open.push_back(std::find(keys.begin(), keys.end(), value) != keys.end());
  }
  if (std::find(open.begin(), open.end(), 1) == open.end()) refuse("--region: no vertex has " + in_quotes(text));
  return open;
}

Index number_below(double value, Index count, const std::string& file, const char* what) {
  if (value >= 0 && value < count && value == std::floor(value)) return static_cast<Index>(value);
  refuse(file + ": there is no " + what + " " + exact(value) + ", the mesh has " + std::to_string(count));
}

// Faces, or vertices: their numbers; or a mask, with a 0 or 1 for each of all; or the vertices that a file lists with
// values, a FreeSurfer label with any, others with one that is not 0.
std::vector<Index> blocked(const std::string& file, Index count, const char* what) {
  const LoadedField field = read_field(file);
  std::vector<Index> numbers;
  for (std::size_t i = 0; i < field.vertices.size(); ++i) {
    if (field.values[i] == 0 && field.format != "FreeSurfer label") continue;
    numbers.push_back(number_below(field.vertices[i], count, file, what));
  }
  if (!field.vertices.empty()) return numbers;
  const auto is_bit = [](double v) { return v == 0 || v == 1; };
  const bool is_mask =
      field.values.size() == count && count > 2 && std::all_of(field.values.begin(), field.values.end(), is_bit);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (!is_mask) {
      numbers.push_back(number_below(field.values[i], count, file, what));
    } else if (field.values[i] == 1) {
      numbers.push_back(static_cast<Index>(i));
    }
  }
  return numbers;
}

// Pairs of vertices: (k, 2) in .npy, one pair to a line in text.
std::vector<std::array<Index, 2>> blocked_edges(const std::string& file, Index count) {
  std::vector<double> ends;
  if (file.ends_with(".npy")) {
    NpyArray array = read_npy(file);
    if (array.shape.size() != 2 || array.shape[1] != 2) refuse(file + ": edges are an array of k x 2 vertex numbers");
    ends = std::move(array.values);
  } else {
    const LoadedField field = read_field(file);
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      // Of a table the first column is taken for vertices.
      if (!field.vertices.empty()) ends.push_back(field.vertices[i]);
      ends.push_back(field.values[i]);
    }
    if (ends.size() % 2 != 0) refuse(file + ": " + std::to_string(ends.size()) + " numbers are no pairs of vertices");
  }
  std::vector<std::array<Index, 2>> edges;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    edges.push_back({number_below(ends[i], count, file, "vertex"), number_below(ends[i + 1], count, file, "vertex")});
  }
  return edges;
}

// On the vertices of the mesh: open where all that were joined are.
std::vector<std::uint8_t> on_mesh(const std::vector<std::uint8_t>& open, Index count, std::span<const Index> map) {
  if (map.empty()) return open;
  std::vector<std::uint8_t> joined(count, 1);
  for (std::size_t v = 0; v < open.size(); ++v) joined[map[v]] = joined[map[v]] && open[v];
  return joined;
}

}  // namespace

Walls walls_of(const SharedArguments& a, const Mesh& file, const Mesh& mesh, std::span<const Index> vertex_map) {
  Walls walls;
  Barriers& barriers = walls.barriers;
  const Index count = file.vertex_count();
  const auto close = [&](const std::vector<std::uint8_t>& open) {
    const std::vector<std::uint8_t> joined = on_mesh(open, mesh.vertex_count(), vertex_map);
    const std::vector<Index> faces = closed_faces(mesh, joined);
    barriers.faces.insert(barriers.faces.end(), faces.begin(), faces.end());
    if (walls.mask.empty()) walls.mask.assign(joined.size(), 1);
    for (std::size_t v = 0; v < joined.size(); ++v) walls.mask[v] = walls.mask[v] && joined[v];
  };
  if (!a.mask_file.empty()) close(open_by_mask(a.mask_file, count));
  if (!a.region.empty()) close(open_by_region(a.region, count));
  if (!a.faces_file.empty()) {
    const std::vector<Index> faces = blocked(a.faces_file, mesh.face_count(), "face");
    barriers.faces.insert(barriers.faces.end(), faces.begin(), faces.end());
  }
  if (!a.edges_file.empty()) {
    for (auto edge : blocked_edges(a.edges_file, count)) {
      for (Index& v : edge) v = vertex_map.empty() ? v : vertex_map[v];
      barriers.edges.push_back(edge);
    }
  }
  if (!a.vertices_file.empty()) {
    for (const Index v : blocked(a.vertices_file, count, "vertex")) {
      barriers.vertices.push_back(vertex_map.empty() ? v : vertex_map[v]);
    }
  }
  return walls;
}

}  // namespace brushfire::tool
