// Files: meshes from bytes; fields and curves out, in all formats that the library writes.
#include "bind.h"

#include <brushfire/core/error.h>
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

// A mesh without anything on it, in the formats of meshes; others know it as a field without values, and say what is
// missing.
void write_bare(const std::string& path, const Mesh& mesh, const std::string& structure, const std::string& format) {
  const nb::gil_scoped_release release;
  try {
    check_mesh_format(path, format);
  } catch (const Error&) {
    return write_field(path, mesh, {}, format);
  }
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
                  const std::string& format) {
  std::vector<SurfaceLine> lines;
  for (const nb::handle curve : curves) {
    const auto c = nb::cast<nb::tuple>(curve);
    lines.push_back({points_from(mesh, {nb::cast<Vector<std::int64_t>>(c[0]), nb::cast<Triples<double>>(c[1])}),
                     nb::cast<bool>(c[2]), nb::cast<double>(c[3])});
  }
  const nb::gil_scoped_release release;
  write_lines(path, mesh, lines, value_name, format);
}

}  // namespace

void bind_files(nb::module_& m) {
  m.def("write_field", write_values, nb::arg("path"), nb::arg("mesh"), nb::arg("values").noconvert().none(),
        nb::arg("labels").noconvert().none(), nb::arg("name"), nb::arg("label_name"), nb::arg("structure"),
        nb::arg("format"));
  m.def("write_lines", write_curves, nb::arg("path"), nb::arg("mesh"), nb::arg("curves"), nb::arg("value_name"),
        nb::arg("format"));
}

}  // namespace brushfire::python
