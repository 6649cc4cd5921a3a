// Writers of curves.
#include <brushfire/io/write_lines.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/output.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace brushfire {
namespace {

using detail::Output;

// What every writer is given: the curves with their positions.
struct Drawing {
  const Mesh& mesh;
  std::span<const SurfaceLine> lines;
  const std::string& value_name;
  std::vector<std::vector<Vec3>> positions;  // [lines][points]

  std::size_t point_count() const {
    std::size_t n = 0;
    for (const SurfaceLine& l : lines) n += l.points.size();
    return n;
  }
};

void write_numbers(Output& out, std::initializer_list<double> numbers, char separator) {
  bool first = true;
  for (const double x : numbers) {
    if (!first) out.write(separator);
    out.number(x);
    first = false;
  }
}

void write_point(Output& out, const SurfacePoint& p, const Vec3* position) {
  out.write("{\"face\": ");
  out.number(p.face);
  out.write(", \"weights\": [");
  write_numbers(out, {p.weights[0], p.weights[1], p.weights[2]}, ',');
  out.write("]");
  if (position) {
    out.write(", \"position\": [");
    write_numbers(out, {position->x, position->y, position->z}, ',');
    out.write("]");
  }
  out.write("}");
}

void write_json_line(Output& out, const Drawing& d, std::size_t i, const char* indent) {
  const SurfaceLine& line = d.lines[i];
  out.write("\"" + d.value_name + "\": ");
  if (std::isfinite(line.value)) {
    out.number(line.value);
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
      write_numbers(out, {p.x, p.y, p.z}, ' ');
      out.write('\n');
    }
  }
  for (const SurfaceLine& line : d.lines) {
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

std::size_t segment_count(const SurfaceLine& line) {
  const std::size_t n = line.points.size();
  return n < 2 ? 0 : line.closed ? n : n - 1;
}

void write_ply(Output& out, const Drawing& d) {
  std::size_t segments = 0, first = 0;
  for (const SurfaceLine& line : d.lines) segments += segment_count(line);
  out.write("ply\nformat ascii 1.0\nelement vertex " + std::to_string(d.point_count()) +
            "\nproperty double x\nproperty double y\nproperty double z\nelement edge " + std::to_string(segments) +
            "\nproperty int vertex1\nproperty int vertex2\nend_header\n");
  for (const auto& positions : d.positions) {
    for (const Vec3& p : positions) {
      write_numbers(out, {p.x, p.y, p.z}, ' ');
      out.write('\n');
    }
  }
  for (const SurfaceLine& line : d.lines) {
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
      write_numbers(out, {p.x, p.y, p.z}, ' ');
      out.write('\n');
    }
  }
  out.write(std::string(close) + "</Points>\n<PointData>\n");
  open_array(out, "Int64", "face");
  for (const SurfaceLine& line : d.lines) {
    for (const SurfacePoint& p : line.points) {
      out.number(p.face);
      out.write('\n');
    }
  }
  out.write(std::string(close) + "</PointData>\n<CellData Scalars=\"" + d.value_name + "\">\n");
  open_array(out, "Float64", d.value_name);
  for (const SurfaceLine& line : d.lines) {
    out.number(line.value);
    out.write('\n');
  }
  out.write(std::string(close) + "</CellData>\n<Lines>\n");
  open_array(out, "Int64", "connectivity");
  std::size_t first = 0;
  for (const SurfaceLine& line : d.lines) {
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
  for (const SurfaceLine& line : d.lines) {
    end += line.points.size() + (line.closed && !line.points.empty() ? 1 : 0);
    out.number(static_cast<std::int64_t>(end));
    out.write('\n');
  }
  out.write(std::string(close) + "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

void write_csv(Output& out, const Drawing& d) {
  out.write("line," + d.value_name + ",point,x,y,z,face,w0,w1,w2\n");
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    for (std::size_t k = 0; k < d.lines[i].points.size(); ++k) {
      const SurfacePoint& s = d.lines[i].points[k];
      const Vec3& p = d.positions[i][k];
      out.number(static_cast<std::int64_t>(i));
      out.write(',');
      out.number(d.lines[i].value);
      out.write(',');
      out.number(static_cast<std::int64_t>(k));
      out.write(',');
      write_numbers(out, {p.x, p.y, p.z}, ',');
      out.write(',');
      out.number(s.face);
      out.write(',');
      write_numbers(out, {s.weights[0], s.weights[1], s.weights[2]}, ',');
      out.write('\n');
    }
  }
}

void write_svg(Output& out, const Drawing& d) {
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  const auto axis = [](const Vec3& p, std::size_t k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; };
  for (const auto& positions : d.positions) {
    for (const Vec3& p : positions) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], axis(p, k));
        high[k] = std::max(high[k], axis(p, k));
      }
    }
  }
  if (d.point_count() == 0) low = high = {0, 0, 0};
  std::size_t thin = 2;  // ties: seen along z
  for (const std::size_t k : {std::size_t{1}, std::size_t{0}}) {
    if (high[k] - low[k] < high[thin] - low[thin]) thin = k;
  }
  const std::size_t across = thin == 0 ? 1 : 0, up = thin == 2 ? 1 : 2;
  const double width = high[across] - low[across], height = high[up] - low[up];
  const double stroke = 0.002 * std::max(width, height), pad = 2 * stroke;
  out.write("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"");
  write_numbers(out, {low[across] - pad, -high[up] - pad, width + 2 * pad, height + 2 * pad}, ' ');
  out.write("\" fill=\"none\" stroke=\"black\" stroke-linejoin=\"round\" stroke-width=\"");
  out.number(stroke);
  out.write("\">\n");
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    if (d.positions[i].empty()) continue;
    out.write("<path data-" + d.value_name + "=\"");
    out.number(d.lines[i].value);
    out.write("\" d=\"");
    for (std::size_t k = 0; k < d.positions[i].size(); ++k) {
      out.write(k == 0 ? "M" : "L");
      write_numbers(out, {axis(d.positions[i][k], across), 0.0 - axis(d.positions[i][k], up)}, ' ');
    }
    out.write(d.lines[i].closed ? "Z\"/>\n" : "\"/>\n");
  }
  out.write("</svg>\n");
}

struct Writer {
  std::string_view extension;
  bool needs_positions;
  void (*write)(Output& out, const Drawing& drawing);
};

// A new format is one line here.
constexpr Writer kWriters[]{{"json", false, write_json}, {"obj", true, write_obj}, {"ply", true, write_ply},
                            {"vtp", true, write_vtp},    {"csv", true, write_csv}, {"svg", true, write_svg}};

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  return extension;
}

const Writer& writer_for(const std::string& path, const std::string& format) {
  const std::string extension = format.empty() ? extension_of(path) : format;
  const auto writer =
      std::find_if(std::begin(kWriters), std::end(kWriters), [&](const Writer& w) { return w.extension == extension; });
  if (writer == std::end(kWriters)) {
    throw Error(ErrorCode::UnknownFormat,
                path + ": curves are written as json, obj, ply, vtp, csv or svg, not as '" + extension + "'");
  }
  return *writer;
}

}  // namespace

void check_lines_format(const std::string& path, const std::string& format) { writer_for(path, format); }

void write_lines(const std::string& path, const Mesh& mesh, std::span<const SurfaceLine> lines,
                 const std::string& value_name, const std::string& format) {
  const Writer& writer = writer_for(path, format);
  if (writer.needs_positions && !mesh.has_positions()) {
    throw Error(ErrorCode::InvalidArgument, path + ": a mesh without positions has no place in ." +
                                                std::string(writer.extension) + " files: write json");
  }
  Drawing drawing{mesh, lines, value_name, {}};
  Poll poll;
  if (mesh.has_positions()) {
    for (const SurfaceLine& line : lines) {
      auto& positions = drawing.positions.emplace_back();
      for (const SurfacePoint& p : line.points) {
        poll();
        positions.push_back(position(mesh, p));
      }
    }
  }
  Output out(path);
  writer.write(out, drawing);
  out.commit();
}

}  // namespace brushfire
