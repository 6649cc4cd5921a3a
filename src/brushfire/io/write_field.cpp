// Which writer a name asks for, and the formats that hold numbers only.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/write_field.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

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
  out.write("}\n");
}

namespace {

struct Writer {
  std::string_view extension;
  bool needs_positions;
  void (*write)(Output& out, const Mesh& mesh, const FieldView& field);
};

// A new writer is one line here.
constexpr Writer kWriters[]{
    {"ply", true, write_ply},  {"vtk", true, write_vtk},    {"vtp", true, write_vtp},
    {"obj", true, write_obj},  {"gii", false, write_gifti}, {"curv", false, write_freesurfer_curv},
    {"csv", false, write_csv}, {"json", false, write_json},
};

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

// The extension that decides; throws where nothing is written as that.
std::string known_extension(const std::string& path, const std::string& format) {
  const std::string extension = format.empty() && path != "-" ? extension_of(path) : format;
  std::string known = "npy";
  if (extension == known) return extension;
  for (const Writer& w : kWriters) {
    if (w.extension == extension) return extension;
    known += ", " + std::string(w.extension);
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

void write_npy_field(const std::string& path, const FieldView& field) {
  if (!field.values.empty() || field.labels.empty()) {
    write_npy(path, field.values);
  } else {
    write_npy(path, field.labels);
  }
}

}  // namespace

}  // namespace detail

void check_field_format(const std::string& path, const std::string& format) { detail::known_extension(path, format); }

void write_field(const std::string& path, const Mesh& mesh, const FieldView& field, const std::string& format) {
  using namespace detail;
  check_size(field.values.size(), mesh, "values");
  check_size(field.labels.size(), mesh, "labels");
  check_name(field.name);
  check_name(field.label_name);
  const std::string extension = known_extension(path, format);
  if (extension == "npy") return write_npy_field(path, field);
  for (const Writer& w : kWriters) {
    if (w.extension != extension) continue;
    if (w.needs_positions && !mesh.has_positions()) {
      throw Error(ErrorCode::InvalidArgument, "a mesh from lengths has no positions to write as " + extension);
    }
    Output out(path);
    w.write(out, mesh, field);
    return out.commit();
  }
}

}  // namespace brushfire
