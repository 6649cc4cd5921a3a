// Which writer a name asks for, and the formats that hold numbers only.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/names.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/write_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace brushfire {

namespace detail {

void write_csv(Output& out, const Mesh& mesh, const FieldView& field) {
  out.write("vertex");
  if (!field.values.empty()) out.write("," + field.name);
  if (!field.labels.empty()) out.write("," + field.label_name);
  out.write('\n');
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    out.number(v);
    if (!field.values.empty()) {
      out.write(',');
      out.number(field.values[v]);
    }
    if (!field.labels.empty()) {
      out.write(',');
      out.number(static_cast<std::int32_t>(field.labels[v]));
    }
    out.write('\n');
  }
}

void write_json(Output& out, const Mesh& mesh, const FieldView& field) {
  out.write("{\"schema\": 1, \"vertices\": ");
  out.number(mesh.vertex_count());
  const auto list = [&](const std::string& name, std::size_t n, auto&& write_one) {
    out.write(",\n \"" + name + "\": [");
    for (std::size_t v = 0; v < n; ++v) {
      if (v != 0) out.write(v % 16 == 0 ? ",\n  " : ", ");
      write_one(v);
    }
    out.write("]");
  };
  if (!field.values.empty()) {
    list(field.name, field.values.size(), [&](std::size_t v) {
      if (std::isfinite(field.values[v])) {
        out.number(field.values[v]);
      } else {
        out.write("null");
      }
    });
  }
  if (!field.labels.empty()) {
    list(field.label_name, field.labels.size(),
         [&](std::size_t v) { out.number(static_cast<std::int32_t>(field.labels[v])); });
  }
  if (!field.not_visited.empty()) {
    std::vector<Index> vertices;
    for (Index v = 0; v < field.not_visited.size(); ++v) {
      if (field.not_visited[v] != 0) vertices.push_back(v);
    }
    list(kNotVisited, vertices.size(), [&](std::size_t i) { out.number(vertices[i]); });
  }
  out.write("}\n");
}

namespace {

struct Writer {
  const char* name;
  std::string_view extension;
  bool needs_positions;
  void (*write)(Output& out, const Mesh& mesh, const FieldView& field);
};

// A new writer is one line here.
constexpr Writer kWriters[]{
    {"PLY", "ply", true, write_ply},      {"VTK", "vtk", true, write_vtk},
    {"VTP", "vtp", true, write_vtp},      {"OBJ (colours)", "obj", true, write_obj},
    {"GIFTI", "gii", false, write_gifti}, {"FreeSurfer curvature", "curv", false, write_freesurfer_curv},
    {"CSV", "csv", false, write_csv},     {"JSON", "json", false, write_json},
};

// The extension that decides; throws where nothing is written as that.
std::string known_extension(const std::string& path, const std::string& format) {
  const std::string extension = extension_or(format, path);
  std::string known = "npy";
  if (extension == known) return extension;
  for (const Writer& w : kWriters) {
    if (w.extension == extension) return extension;
    known += ", " + std::string(w.extension);
  }
  if (extension == "nii") {
    throw Error(ErrorCode::UnknownFormat,
                printable(path) +
                    ": CIFTI-2 is not written here: write .shape.gii for each hemisphere and join them with "
                    "wb_command -cifti-create-dense-scalar, or use brushfire.write of the Python package");
  }
  throw Error(ErrorCode::UnknownFormat,
              printable(path) + ": nothing is written as " + quote(extension) + " (known: " + known + ")");
}

void check_size(std::size_t size, const Mesh& mesh, const char* what) {
  if (size == 0 || size == mesh.vertex_count()) return;
  throw Error(ErrorCode::InvalidArgument, std::to_string(size) + " " + what + " for a mesh of " +
                                              std::to_string(mesh.vertex_count()) + " vertices");
}

// Names go into headers of many grammars: letters, digits and a few marks are at home in all of them.
void check_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  if (!name.empty() && std::all_of(name.begin(), name.end(), is_plain)) return;
  throw Error(ErrorCode::InvalidArgument, quote(name) + " is no name for an array: letters, digits, _ - . only");
}

// The field with nothing outside its mask.
struct Masked {
  explicit Masked(const FieldView& given) : field(given) {
    if (given.mask.empty()) return;
    values.assign(given.values.begin(), given.values.end());
    labels.assign(given.labels.begin(), given.labels.end());
    for (std::size_t v = 0; v < given.mask.size(); ++v) {
      if (given.mask[v] != 0) continue;
      if (!values.empty()) values[v] = std::numeric_limits<double>::quiet_NaN();
      if (!labels.empty()) labels[v] = kNoIndex;
    }
    field.values = values;
    field.labels = labels;
  }
  FieldView field;
  std::vector<double> values;
  std::vector<Index> labels;
};

void write_npy_field(const Destination& to, const FieldView& field) {
  if (!field.values.empty() || field.labels.empty()) {
    write_npy_to(to, field.values);
  } else {
    write_npy_to(to, field.labels);
  }
}

}  // namespace

}  // namespace detail

std::vector<FileFormat> fields_written() {
  std::vector<FileFormat> formats{{"NPY", {"npy"}}};
  for (const detail::Writer& w : detail::kWriters) formats.push_back({w.name, {std::string(w.extension)}});
  return formats;
}

void check_field_format(const std::string& path, const std::string& format) { detail::known_extension(path, format); }

namespace detail {
namespace {

void write_field_to(const Destination& to, const Mesh& mesh, const FieldView& given, const std::string& format) {
  check_size(given.values.size(), mesh, "values");
  check_size(given.labels.size(), mesh, "labels");
  check_size(given.mask.size(), mesh, "entries of the mask");
  check_size(given.not_visited.size(), mesh, "entries of not_visited");
  check_name(given.name);
  check_name(given.label_name);
  const std::string extension = known_extension(to.name, format);
  const Masked masked(given);
  const FieldView& field = masked.field;
  if (extension == "npy") return write_npy_field(to, field);
  for (const Writer& w : kWriters) {
    if (w.extension != extension) continue;
    if (w.needs_positions && !mesh.has_positions()) {
      throw Error(ErrorCode::InvalidArgument, "a mesh from lengths has no positions to write as " + extension);
    }
    Output out(to);
    w.write(out, mesh, field);
    return out.commit();
  }
}

}  // namespace
}  // namespace detail

void write_field(const std::string& path, const Mesh& mesh, const FieldView& field, const std::string& format) {
  detail::write_field_to({path}, mesh, field, format);
}

std::vector<std::uint8_t> encode_field(const Mesh& mesh, const FieldView& field, const std::string& format) {
  std::vector<std::uint8_t> bytes;
  detail::write_field_to({"field." + format, &bytes}, mesh, field, format);
  return bytes;
}

}  // namespace brushfire
