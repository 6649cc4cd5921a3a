// Writers of columns: numbers alone, and numbers on a mesh.
#include <brushfire/io/write_columns.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/names.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/detail/text.h>
#include <brushfire/io/npy.h>

#include <cmath>
#include <limits>
#include <string_view>

namespace brushfire {
namespace detail {
namespace {

constexpr std::endian kPly = std::endian::little, kVtk = std::endian::big;

// What a writer sees: the columns, on the part of the mesh that has some.
struct Part {
  Part(const Mesh& whole, const Columns& given) : mesh(whole), columns(given), width(given.names.size()) {}

  std::size_t rows() const { return width == 0 ? 0 : columns.values.size() / width; }
  double value(std::size_t row, std::size_t column) const { return columns.values[row * width + column]; }
  Index number(std::size_t row) const { return columns.rows.empty() ? static_cast<Index>(row) : columns.rows[row]; }
  bool is_on_faces() const { return columns.on == Columns::On::Faces; }
  bool has_vertex(Index v) const { return rank.empty() || rank[v] != kNoIndex; }
  Index vertex_count() const { return rank.empty() ? mesh.vertex_count() : static_cast<Index>(rows()); }

  // Between the vertices that have rows.
  void find_part() {
    if (columns.rows.empty()) return;
    rank.assign(mesh.vertex_count(), kNoIndex);
    for (std::size_t row = 0; row < columns.rows.size(); ++row) rank[columns.rows[row]] = static_cast<Index>(row);
  }
  std::vector<Face> faces() const {
    std::vector<Face> out;
    for (const Face& f : mesh.faces()) {
      if (!has_vertex(f[0]) || !has_vertex(f[1]) || !has_vertex(f[2])) continue;
      out.push_back(rank.empty() ? f : Face{rank[f[0]], rank[f[1]], rank[f[2]]});
    }
    return out;
  }
  const Vec3& position(Index row) const { return mesh.positions()[rank.empty() ? row : columns.rows[row]]; }

  const Mesh& mesh;
  const Columns& columns;
  std::size_t width;
  std::vector<Index> rank;  // [vertex_count] its row; empty: all vertices, in order
};

const char* element_of(const Part& part) { return part.is_on_faces() ? "face" : "vertex"; }

void write_csv(Output& out, const Part& part) {
  out.write(element_of(part));
  for (const std::string& name : part.columns.names) out.write("," + name);
  out.write('\n');
  Poll poll;
  for (std::size_t row = 0; row < part.rows(); ++row) {
    poll();
    out.number(part.number(row));
    for (std::size_t k = 0; k < part.width; ++k) {
      out.write(',');
      out.number(part.value(row, k));
    }
    out.write('\n');
  }
}

void write_json(Output& out, const Part& part) {
  const std::string element = element_of(part);
  out.write("{\"schema\": 1, \"" + std::string(part.is_on_faces() ? "faces" : "vertices") + "\": ");
  out.number(part.is_on_faces() ? part.mesh.face_count() : part.mesh.vertex_count());
  const auto list = [&](const std::string& name, auto&& write_one) {
    out.write(",\n \"" + name + "\": [");
    for (std::size_t row = 0; row < part.rows(); ++row) {
      if (row != 0) out.write(row % 16 == 0 ? ",\n  " : ", ");
      write_one(row);
    }
    out.write("]");
  };
  list(element, [&](std::size_t row) { out.number(part.number(row)); });
  for (std::size_t k = 0; k < part.width; ++k) {
    list(part.columns.names[k], [&](std::size_t row) {
      const double value = part.value(row, k);
      std::isfinite(value) ? out.number(value) : out.write("null");
    });
  }
  out.write("}\n");
}

void write_ply(Output& out, const Part& part) {
  const bool on_faces = part.is_on_faces(), has_numbers = !part.rank.empty();
  const auto properties = [&] {
    for (std::size_t k = 0; k < part.width; ++k) {
      const bool is_texture = part.columns.kind == Columns::Kind::Texture && k < 2;
      out.write("property double " +
                (is_texture ? std::string(k == 0 ? "texture_u" : "texture_v") : part.columns.names[k]) + "\n");
    }
  };
  const std::vector<Face> faces = part.faces();
  out.write("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(part.vertex_count()) +
            "\nproperty double x\nproperty double y\nproperty double z\n");
  if (!on_faces) properties();
  if (has_numbers) out.write("property int vertex\n");
  out.write("element face " + std::to_string(faces.size()) + "\nproperty list uchar int vertex_indices\n");
  if (on_faces) properties();
  out.write("end_header\n");
  const auto values = [&](std::size_t row) {
    out.values(part.columns.values.subspan(row * part.width, part.width), kPly);
  };
  for (Index row = 0; row < part.vertex_count(); ++row) {
    const Vec3& p = part.position(row);
    for (const double x : {p.x, p.y, p.z}) out.value(x, kPly);
    if (!on_faces) values(row);
    if (has_numbers) out.value(part.number(row), kPly);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    out.value(std::uint8_t{3}, kPly);
    for (const Index v : faces[f]) out.value(v, kPly);
    if (on_faces) values(f);
  }
}

void write_vtk(Output& out, const Part& part) {
  const std::vector<Face> faces = part.faces();
  out.write("# vtk DataFile Version 3.0\nbrushfire\nBINARY\nDATASET POLYDATA\nPOINTS " +
            std::to_string(part.vertex_count()) + " double\n");
  for (Index row = 0; row < part.vertex_count(); ++row) {
    const Vec3& p = part.position(row);
    for (const double x : {p.x, p.y, p.z}) out.value(x, kVtk);
  }
  out.write("\nPOLYGONS " + std::to_string(faces.size()) + " " + std::to_string(std::uint64_t{4} * faces.size()) +
            "\n");
  for (const Face& f : faces) {
    out.value(std::int32_t{3}, kVtk);
    for (const Index v : f) out.value(v, kVtk);
  }
  out.write((part.is_on_faces() ? "\nCELL_DATA " : "\nPOINT_DATA ") + std::to_string(part.rows()) + "\n");
  std::size_t first = 0;
  const auto together = [&](std::size_t count) {
    for (std::size_t row = 0; row < part.rows(); ++row) {
      out.values(part.columns.values.subspan(row * part.width, count), kVtk);
    }
    out.write('\n');
    first = count;
  };
  if (part.columns.kind == Columns::Kind::Vectors) {
    out.write("VECTORS " + part.columns.name + " double\n");
    together(3);
  } else if (part.columns.kind == Columns::Kind::Texture) {
    out.write("TEXTURE_COORDINATES " + part.columns.name + " 2 double\n");
    together(2);
  }
  for (std::size_t k = first; k < part.width; ++k) {
    out.write("SCALARS " + part.columns.names[k] + " double 1\nLOOKUP_TABLE default\n");
    for (std::size_t row = 0; row < part.rows(); ++row) out.value(part.value(row, k), kVtk);
    out.write('\n');
  }
  if (part.rank.empty()) return;
  out.write("SCALARS vertex int 1\nLOOKUP_TABLE default\n");
  for (std::size_t row = 0; row < part.rows(); ++row) out.value(part.number(row), kVtk);
  out.write('\n');
}

void write_obj(Output& out, const Part& part) {
  for (Index row = 0; row < part.vertex_count(); ++row) {
    const Vec3& p = part.position(row);
    out.write("v ");
    out.numbers({p.x, p.y, p.z}, ' ');
    out.write("\nvt ");
    out.numbers({part.value(row, 0), part.value(row, 1)}, ' ');
    out.write('\n');
  }
  for (const Face& f : part.faces()) {
    out.write('f');
    for (const Index v : f) {
      out.write(' ');
      out.number(std::int64_t{v} + 1);
      out.write('/');
      out.number(std::int64_t{v} + 1);
    }
    out.write('\n');
  }
}

void write_npy_columns(const std::string& path, const Part& part) {
  const std::size_t all = part.is_on_faces() ? part.mesh.face_count() : part.mesh.vertex_count();
  const std::vector<std::size_t> shape{all, part.width};
  if (part.columns.rows.empty()) return write_npy(path, part.columns.values, shape);
  std::vector<double> values(all * part.width, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < part.rows(); ++row) {
    for (std::size_t k = 0; k < part.width; ++k) values[part.number(row) * part.width + k] = part.value(row, k);
  }
  write_npy(path, values, shape);
}

struct Writer {
  const char* name;
  std::string_view extension;
  bool has_mesh;
  void (*write)(Output& out, const Part& part);  // null: npy, which is written elsewhere
};

// A new writer is one line here.
constexpr Writer kWriters[]{
    {"NPY", "npy", false, nullptr},  {"CSV", "csv", false, write_csv}, {"JSON", "json", false, write_json},
    {"PLY", "ply", true, write_ply}, {"VTK", "vtk", true, write_vtk},  {"OBJ (texture)", "obj", true, write_obj},
};

bool has_place(const Writer& w, Columns::Kind kind) { return w.write != write_obj || kind == Columns::Kind::Texture; }

const Writer& writer_of(const std::string& path, const std::string& format, Columns::Kind kind) {
  const std::string extension = extension_or(format, path);
  std::string known;
  for (const Writer& w : kWriters) {
    if (!has_place(w, kind)) continue;
    if (w.extension == extension) return w;
    known += (known.empty() ? "" : ", ") + std::string(w.extension);
  }
  throw Error(ErrorCode::UnknownFormat,
              printable(path) + ": these values are not written as " + quote(extension) + " (known: " + known + ")");
}

void check(const Part& part, const Writer& writer) {
  const Columns& c = part.columns;
  const std::size_t all = part.is_on_faces() ? part.mesh.face_count() : part.mesh.vertex_count();
  const std::size_t rows = c.rows.empty() ? all : c.rows.size();
  const std::size_t least = c.kind == Columns::Kind::Vectors ? 3 : c.kind == Columns::Kind::Texture ? 2 : 1;
  if (part.width < least || c.values.size() != rows * part.width) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(c.values.size()) + " values for " + std::to_string(rows) +
                                                " rows of " + std::to_string(part.width) + " columns");
  }
  for (std::size_t i = 0; i < c.rows.size(); ++i) {
    if (c.rows[i] >= all || (i > 0 && c.rows[i] <= c.rows[i - 1])) {
      throw Error(ErrorCode::InvalidArgument, "row " + std::to_string(i) + " is of " + element_of(part) + " " +
                                                  std::to_string(c.rows[i]) + ": they must ascend, and exist");
    }
  }
  if (!writer.has_mesh) return;
  if (!part.mesh.has_positions()) {
    throw Error(ErrorCode::InvalidArgument,
                "a mesh from lengths has no positions to write as " + std::string(writer.extension));
  }
  if (part.is_on_faces() && !c.rows.empty()) {
    throw Error(ErrorCode::InvalidArgument, "values of some faces only are not written as " +
                                                std::string(writer.extension) + ": npy, csv and json hold them");
  }
}

}  // namespace
}  // namespace detail

void write_columns(const std::string& path, const Mesh& mesh, const Columns& columns, const std::string& format) {
  using namespace detail;
  const Writer& writer = writer_of(path, format, columns.kind);
  Part part(mesh, columns);
  check(part, writer);
  if (writer.write == nullptr) return write_npy_columns(path, part);
  if (writer.has_mesh) part.find_part();
  Output out(path);
  writer.write(out, part);
  out.commit();
}

void check_columns_format(const std::string& path, Columns::Kind kind, const std::string& format) {
  detail::writer_of(path, format, kind);
}

std::vector<FileFormat> columns_written(Columns::Kind kind) {
  std::vector<FileFormat> formats;
  for (const detail::Writer& w : detail::kWriters) {
    if (detail::has_place(w, kind)) formats.push_back({w.name, {std::string(w.extension)}});
  }
  return formats;
}

}  // namespace brushfire
