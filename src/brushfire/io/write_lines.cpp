// Writers of curves.
#include <brushfire/io/write_lines.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/drawing.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/names.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/formats.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brushfire {
namespace {

using detail::Drawing, detail::Output, detail::write_svg, detail::write_dxf;

void write_point(Output& out, const SurfacePoint& p, const Vec3* position) {
  out.write("{\"face\": ");
  out.number(p.face);
  out.write(", \"weights\": [");
  out.numbers({p.weights[0], p.weights[1], p.weights[2]}, ',');
  out.write("]");
  if (position) {
    out.write(", \"position\": [");
    out.numbers({position->x, position->y, position->z}, ',');
    out.write("]");
  }
  out.write("}");
}

void write_json_line(Output& out, const Drawing& d, std::size_t i, const char* indent) {
  const SurfacePath& line = d.lines[i];
  out.write("\"" + d.value_name + "\": ");
  if (std::isfinite(d.value(i))) {
    out.number(d.value(i));
  } else {
    out.write("null");
  }
  out.write(line.closed ? ", \"closed\": true,\n" : ", \"closed\": false,\n");
  out.write(indent);
  out.write("\"points\": [");
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    out.write(k == 0 ? "\n" : ",\n");
    out.write(indent);
    out.write(" ");
    write_point(out, line.points[k], d.mesh.has_positions() ? &d.positions[i][k] : nullptr);
  }
  out.write("]");
}

void write_json(Output& out, const Drawing& d) {
  out.write("{\"schema\": 1,\n ");
  if (d.lines.size() == 1) {
    write_json_line(out, d, 0, " ");
    out.write("}\n");
    return;
  }
  out.write("\"lines\": [");
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    out.write(i == 0 ? "\n  {" : ",\n  {");
    write_json_line(out, d, i, "   ");
    out.write("}");
  }
  out.write("]}\n");
}

void write_obj(Output& out, const Drawing& d) {
  std::size_t first = 1;
  for (const auto& positions : d.positions) {
    for (const Vec3& p : positions) {
      out.write("v ");
      out.numbers({p.x, p.y, p.z}, ' ');
      out.write('\n');
    }
  }
  for (const SurfacePath& line : d.lines) {
    out.write(line.points.size() > 1 ? "l" : "p");
    for (std::size_t k = 0; k < line.points.size(); ++k) {
      out.write(' ');
      out.number(static_cast<std::int64_t>(first + k));
    }
    if (line.closed && line.points.size() > 1) {
      out.write(' ');
      out.number(static_cast<std::int64_t>(first));
    }
    out.write('\n');
    first += line.points.size();
  }
}

std::size_t segment_count(const SurfacePath& line) {
  const std::size_t n = line.points.size();
  return n < 2 ? 0 : line.closed ? n : n - 1;
}

void write_ply(Output& out, const Drawing& d) {
  std::size_t segments = 0, first = 0;
  for (const SurfacePath& line : d.lines) segments += segment_count(line);
  out.write("ply\nformat ascii 1.0\nelement vertex " + std::to_string(d.point_count()) +
            "\nproperty double x\nproperty double y\nproperty double z\nelement edge " + std::to_string(segments) +
            "\nproperty int vertex1\nproperty int vertex2\nend_header\n");
  for (const auto& positions : d.positions) {
    for (const Vec3& p : positions) {
      out.numbers({p.x, p.y, p.z}, ' ');
      out.write('\n');
    }
  }
  for (const SurfacePath& line : d.lines) {
    const std::size_t n = line.points.size();
    for (std::size_t k = 0; k < segment_count(line); ++k) {
      out.number(static_cast<std::int64_t>(first + k));
      out.write(' ');
      out.number(static_cast<std::int64_t>(first + (k + 1) % n));
      out.write('\n');
    }
    first += n;
  }
}

void open_array(Output& out, const char* type, const std::string& name, int components = 1) {
  out.write(std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"ascii\"" +
            (components > 1 ? " NumberOfComponents=\"" + std::to_string(components) + "\"" : "") + ">\n");
}

void write_vtp(Output& out, const Drawing& d) {
  const char* const close = "</DataArray>\n";
  out.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(d.point_count()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(d.lines.size()) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n");
  open_array(out, "Float64", "Points", 3);
  for (const auto& positions : d.positions) {
    for (const Vec3& p : positions) {
      out.numbers({p.x, p.y, p.z}, ' ');
      out.write('\n');
    }
  }
  out.write(std::string(close) + "</Points>\n<PointData>\n");
  open_array(out, "Int64", "face");
  for (const SurfacePath& line : d.lines) {
    for (const SurfacePoint& p : line.points) {
      out.number(p.face);
      out.write('\n');
    }
  }
  out.write(std::string(close) + "</PointData>\n<CellData Scalars=\"" + d.value_name + "\">\n");
  open_array(out, "Float64", d.value_name);
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    out.number(d.value(i));
    out.write('\n');
  }
  out.write(std::string(close) + "</CellData>\n<Lines>\n");
  open_array(out, "Int64", "connectivity");
  std::size_t first = 0;
  for (const SurfacePath& line : d.lines) {
    for (std::size_t k = 0; k < line.points.size(); ++k) {
      out.number(static_cast<std::int64_t>(first + k));
      out.write(' ');
    }
    if (line.closed && !line.points.empty()) out.number(static_cast<std::int64_t>(first));
    out.write('\n');
    first += line.points.size();
  }
  out.write(close);
  open_array(out, "Int64", "offsets");
  std::size_t end = 0;
  for (const SurfacePath& line : d.lines) {
    end += line.points.size() + (line.closed && !line.points.empty() ? 1 : 0);
    out.number(static_cast<std::int64_t>(end));
    out.write('\n');
  }
  out.write(std::string(close) + "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

void write_csv(Output& out, const Drawing& d) {
  out.write("line," + d.value_name + ",point,x,y,z,face,w0,w1,w2,closed\n");
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    for (std::size_t k = 0; k < d.lines[i].points.size(); ++k) {
      const SurfacePoint& s = d.lines[i].points[k];
      const Vec3& p = d.positions[i][k];
      out.number(static_cast<std::int64_t>(i));
      out.write(',');
      out.number(d.value(i));
      out.write(',');
      out.number(static_cast<std::int64_t>(k));
      out.write(',');
      out.numbers({p.x, p.y, p.z}, ',');
      out.write(',');
      out.number(s.face);
      out.write(',');
      out.numbers({s.weights[0], s.weights[1], s.weights[2]}, ',');
      out.write(d.lines[i].closed ? ",1\n" : ",0\n");
    }
  }
}

struct Writer {
  const char* name;
  std::string_view extension;
  bool needs_positions;
  void (*write)(Output& out, const Drawing& drawing);
};

// A new format is one line here.
constexpr Writer kWriters[]{{"JSON", "json", false, write_json}, {"OBJ", "obj", true, write_obj},
                            {"PLY", "ply", true, write_ply},     {"VTP", "vtp", true, write_vtp},
                            {"CSV", "csv", true, write_csv},     {"SVG", "svg", true, write_svg},
                            {"DXF", "dxf", true, write_dxf}};

const Writer& writer_for(const std::string& path, const std::string& format) {
  const std::string extension = detail::extension_or(format, path);
  const auto writer =
      std::find_if(std::begin(kWriters), std::end(kWriters), [&](const Writer& w) { return w.extension == extension; });
  if (writer == std::end(kWriters)) {
    throw Error(ErrorCode::UnknownFormat,
                path + ": curves are written as json, obj, ply, vtp, csv, svg or dxf, not as '" + extension + "'");
  }
  return *writer;
}

}  // namespace

std::vector<FileFormat> lines_written() {
  std::vector<FileFormat> formats;
  for (const Writer& w : kWriters) formats.push_back({w.name, {std::string(w.extension)}});
  return formats;
}

void check_lines_format(const std::string& path, const std::string& format, const LinesOptions& options) {
  writer_for(path, format);
  if (!options.view.empty()) detail::check_view(options.view);
  if (!(options.millimetres > 0) || options.millimetres == kInfinity) {
    throw Error(ErrorCode::InvalidArgument, "a unit of the mesh must be some millimetres long");
  }
}

namespace {

void write_lines_to(const detail::Destination& to, const Mesh& mesh, std::span<const SurfacePath> lines,
                    const std::string& value_name, const std::string& format, const LinesOptions& options) {
  check_lines_format(to.name, format, options);
  if (!options.values.empty() && options.values.size() != lines.size()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(options.values.size()) + " values for " +
                                                std::to_string(lines.size()) + " curves: one each is needed");
  }
  const Writer& writer = writer_for(to.name, format);
  if (writer.needs_positions && !mesh.has_positions()) {
    throw Error(ErrorCode::InvalidArgument, to.name + ": a mesh without positions has no place in ." +
                                                std::string(writer.extension) + " files: write json");
  }
  Drawing drawing{mesh, lines, value_name, options, {}};
  Poll poll;
  if (mesh.has_positions()) {
    for (const SurfacePath& line : lines) {
      auto& positions = drawing.positions.emplace_back();
      for (const SurfacePoint& p : line.points) {
        poll();
        positions.push_back(position(mesh, p));
      }
    }
  }
  Output out(to);
  writer.write(out, drawing);
  out.commit();
}

}  // namespace

void write_lines(const std::string& path, const Mesh& mesh, std::span<const SurfacePath> lines,
                 const std::string& value_name, const std::string& format, const LinesOptions& options) {
  write_lines_to({path}, mesh, lines, value_name, format, options);
}

std::vector<std::uint8_t> encode_lines(const Mesh& mesh, std::span<const SurfacePath> lines,
                                       const std::string& value_name, const std::string& format,
                                       const LinesOptions& options) {
  std::vector<std::uint8_t> bytes;
  write_lines_to({"lines." + format, &bytes}, mesh, lines, value_name, format, options);
  return bytes;
}

}  // namespace brushfire
