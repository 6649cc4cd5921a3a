// Files: meshes from bytes; fields and curves out, in all formats that the library writes.
#include "bind.h"
#include "interrupt.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_lines.h>
#include <brushfire/io/write_columns.h>
#include <brushfire/io/write_field.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/io/write_mesh.h>

#include <algorithm>

namespace brushfire::python {
namespace {

// Source numbers, of which -1 means none.
std::vector<Index> labels_from(const Vector<std::int32_t>& labels) {
  std::vector<Index> result(labels.shape(0));
  std::transform(labels.data(), labels.data() + labels.shape(0), result.begin(),
                 [](std::int32_t label) { return static_cast<Index>(label); });
  return result;
}

// A mesh without anything on it, in the formats of meshes; those of fields alone say what is missing.
void write_bare(const std::string& path, const Mesh& mesh, const std::string& structure, const std::string& format) {
  const nb::gil_scoped_release release;
  const auto is_known = [&](auto& check) {
    try {
      check(path, format);
    } catch (const Error&) {
      return false;
    }
    return true;
  };
  if (!is_known(check_mesh_format) && is_known(check_field_format)) return write_field(path, mesh, {}, format);
  write_mesh(path, mesh, format, structure);
}

void write_values(const std::string& path, const Mesh& mesh, const std::optional<Vector<double>>& values,
                  const std::optional<Vector<std::int32_t>>& labels, const std::string& name,
                  const std::string& label_name, const std::string& structure, const std::string& format) {
  if (!values && !labels) return write_bare(path, mesh, structure, format);
  const std::vector<Index> numbers = labels ? labels_from(*labels) : std::vector<Index>();
  FieldView field;
  if (values) field.values = {values->data(), values->shape(0)};
  field.labels = numbers;
  field.name = name;
  field.label_name = label_name;
  field.structure = structure;
  const nb::gil_scoped_release release;
  write_field(path, mesh, field, format);
}

// Each curve: (index, weights, closed, value).
void write_curves(const std::string& path, const Mesh& mesh, const nb::list& curves, const std::string& value_name,
                  const std::string& format, double millimetres, const std::string& view, bool outline) {
  std::vector<SurfacePath> lines;
  std::vector<double> values;
  for (const nb::handle curve : curves) {
    const auto c = nb::cast<nb::tuple>(curve);
    const auto value = nb::cast<double>(c[3]);
    lines.push_back({points_from(mesh, {nb::cast<Vector<std::int64_t>>(c[0]), nb::cast<Triples<double>>(c[1])}), value,
                     nb::cast<bool>(c[2])});
    values.push_back(value);
  }
  const nb::gil_scoped_release release;
  write_lines(path, mesh, lines, value_name, format, {millimetres, view, outline, values});
}

// (value name, format, [(positions, (face, weights) or None, closed, value)]).
nb::tuple to_tuple(LoadedLines&& loaded) {
  nb::list list;
  for (LoadedLine& line : loaded.lines) {
    std::vector<double> xyz;
    for (const Vec3& p : line.positions) xyz.insert(xyz.end(), {p.x, p.y, p.z});
    const std::size_t count = line.positions.size();
    list.append(nb::make_tuple(to_numpy(std::move(xyz), {count, 3}),
                               line.points.empty() ? nb::object(nb::none()) : nb::object(points_to_numpy(line.points)),
                               line.closed, line.value));
  }
  return nb::make_tuple(loaded.value_name, loaded.format, list);
}

nb::tuple lines_of_file(const std::string& path) {
  return to_tuple(listening(false, [&] { return read_lines(path); }));
}

nb::tuple lines_of_bytes(const nb::bytes& content, const std::string& name) {
  const std::span bytes(static_cast<const std::byte*>(content.data()), content.size());
  return to_tuple(listening(false, [&] { return read_lines(bytes, name); }));
}

// u, v, radius and angle of the vertices `rows`.
void write_map(const std::string& path, const Mesh& mesh, const Vector<std::int32_t>& rows,
               const Vector<double>& values, const std::string& format) {
  const std::vector<Index> numbers = labels_from(rows);
  const nb::gil_scoped_release release;
  write_columns(path, mesh,
                {.names = {"u", "v", "radius", "angle"},
                 .values = {values.data(), values.shape(0)},
                 .rows = numbers,
                 .kind = Columns::Kind::Texture,
                 .name = "log_map"},
                format);
}

}  // namespace

void bind_files(nb::module_& m) {
  m.def("write_field", write_values, nb::arg("path"), nb::arg("mesh"), nb::arg("values").noconvert().none(),
        nb::arg("labels").noconvert().none(), nb::arg("name"), nb::arg("label_name"), nb::arg("structure"),
        nb::arg("format"));
  m.def("write_lines", write_curves, nb::arg("path"), nb::arg("mesh"), nb::arg("curves"), nb::arg("value_name"),
        nb::arg("format"), nb::arg("millimetres"), nb::arg("view"), nb::arg("outline"));
  m.def("read_lines", lines_of_file, nb::arg("path"));
  m.def("read_lines_bytes", lines_of_bytes, nb::arg("content"), nb::arg("name"));
  m.def("write_map", write_map, nb::arg("path"), nb::arg("mesh"), nb::arg("rows").noconvert(),
        nb::arg("values").noconvert(), nb::arg("format"));
}

}  // namespace brushfire::python
