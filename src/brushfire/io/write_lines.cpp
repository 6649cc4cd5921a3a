// Writers of curves.
#include <brushfire/io/write_lines.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/names.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/formats.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brushfire {
namespace {

using detail::Output;

// What every writer is given: the curves with their positions.
struct Drawing {
  const Mesh& mesh;
  std::span<const SurfacePath> lines;
  const std::string& value_name;
  const LinesOptions& options;
  std::vector<std::vector<Vec3>> positions;  // [lines][points]

  std::size_t point_count() const {
    std::size_t n = 0;
    for (const SurfacePath& l : lines) n += l.points.size();
    return n;
  }
  double value(std::size_t line) const { return options.values.empty() ? lines[line].length : options.values[line]; }
};

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

// Millimetres on paper: to the right and down.
using PaperPoint = std::array<double, 2>;

struct Box2 {
  PaperPoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  void add(const PaperPoint& p) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
};

double along(const Vec3& p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// An orthographic view: which way is right, and which way is up.
struct View {
  const char* name;
  Vec3 right, up;
};
constexpr View kViews[]{{"front", {1, 0, 0}, {0, 0, 1}}, {"back", {-1, 0, 0}, {0, 0, 1}},
                        {"left", {0, -1, 0}, {0, 0, 1}}, {"right", {0, 1, 0}, {0, 0, 1}},
                        {"top", {1, 0, 0}, {0, 1, 0}},   {"bottom", {1, 0, 0}, {0, -1, 0}}};

// Along the shortest side of the box around the curves; of equal ones from above.
const View& flattest_view(const Drawing& d) {
  Box box;
  for (const auto& positions : d.positions) {
    for (const Vec3& p : positions) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  }
  const auto side = [&](std::size_t axis) { return along(box.high, axis) - along(box.low, axis); };
  std::size_t thin = 2;
  if (d.point_count() != 0) {
    for (const std::size_t axis : {std::size_t{1}, std::size_t{0}}) {
      if (side(axis) < side(thin)) thin = axis;
    }
  }
  return kViews[thin == 2 ? 4 : thin == 1 ? 0 : 3];
}

const View& view_named(const std::string& name) {
  std::string known;
  for (const View& v : kViews) {
    if (v.name == name) return v;
    known += std::string(known.empty() ? "" : ", ") + v.name;
  }
  throw Error(ErrorCode::InvalidArgument, detail::quote(name) + " is no view (known: " + known + ")");
}

// Edges of the mesh that bound it: those of one face, and, seen along `towards`, those between faces that look towards
// the viewer and away. Without `towards` the former only.
std::vector<std::array<Vec3, 2>> outline(const Mesh& mesh, const Vec3* towards) {
  const auto opposite = mesh.opposite();
  const auto positions = mesh.positions();
  const auto looks_here = [&](Index h) {
    const Face& f = mesh.faces()[Mesh::face_of(h)];
    return dot(cross(positions[f[1]] - positions[f[0]], positions[f[2]] - positions[f[0]]), *towards) > 0;
  };
  std::vector<std::array<Vec3, 2>> edges;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (!mesh.is_face_usable(Mesh::face_of(h))) continue;
    const Index g = opposite[h];
    const bool is_boundary = g == h;
    const bool is_mirrored = mesh.from(g) == mesh.from(h);  // the other face is oriented the other way round
    const bool is_silhouette = towards != nullptr && g > h && looks_here(h) != (looks_here(g) != is_mirrored);
    if (is_boundary || is_silhouette) edges.push_back({positions[mesh.from(h)], positions[mesh.to(h)]});
  }
  return edges;
}

// Real size: one unit of the drawing is a millimetre.
void write_svg(Output& out, const Drawing& d) {
  const View& view = d.options.view.empty() ? flattest_view(d) : view_named(d.options.view);
  const double scale = d.options.millimetres;
  // 0.0 - : no minus zero.
  const auto on_paper = [&](const Vec3& p) -> PaperPoint {
    return {scale * dot(p, view.right), 0.0 - scale * dot(p, view.up)};
  };
  std::vector<std::array<PaperPoint, 2>> edges;
  Box2 box;
  if (d.options.outline) {
    const Vec3 towards = cross(view.right, view.up);
    for (const auto& [a, b] : outline(d.mesh, &towards)) {
      edges.push_back({on_paper(a), on_paper(b)});
      for (const PaperPoint& p : edges.back()) box.add(p);
    }
  }
  for (const auto& positions : d.positions) {
    for (const Vec3& p : positions) box.add(on_paper(p));
  }
  if (!(box.low[0] <= box.high[0])) box = {{0, 0}, {0, 0}};
  const double width = box.high[0] - box.low[0], height = box.high[1] - box.low[1];
  const double stroke = 0.002 * std::max(width, height), pad = 2 * stroke;
  out.write("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"");
  out.number(width + 2 * pad);
  out.write("mm\" height=\"");
  out.number(height + 2 * pad);
  out.write("mm\" viewBox=\"");
  out.numbers({box.low[0] - pad, box.low[1] - pad, width + 2 * pad, height + 2 * pad}, ' ');
  out.write("\" fill=\"none\" stroke=\"black\" stroke-linejoin=\"round\" stroke-width=\"");
  out.number(stroke);
  out.write("\">\n");
  const auto move_to = [&](char command, const PaperPoint& p) {
    out.write(command);
    out.numbers({p[0], p[1]}, ' ');
  };
  if (!edges.empty()) {
    out.write("<path id=\"outline\" stroke=\"gray\" d=\"");
    for (const auto& [a, b] : edges) {
      move_to('M', a);
      move_to('L', b);
    }
    out.write("\"/>\n");
  }
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    if (d.positions[i].empty()) continue;
    out.write("<path data-" + d.value_name + "=\"");
    out.number(d.value(i));
    out.write("\" d=\"");
    for (std::size_t k = 0; k < d.positions[i].size(); ++k) move_to(k == 0 ? 'M' : 'L', on_paper(d.positions[i][k]));
    out.write(d.lines[i].closed ? "Z\"/>\n" : "\"/>\n");
  }
  out.write("</svg>\n");
}

// DXF of release 12, which every CAD program reads: lines of a group code and a value.
class Dxf {
 public:
  explicit Dxf(Output& out) : out_(&out) {}
  void group(int code, std::string_view value) {
    out_->number(static_cast<std::int64_t>(code));
    out_->write("\n");
    out_->write(value);
    out_->write("\n");
  }
  void number(int code, double value) {
    out_->number(static_cast<std::int64_t>(code));
    out_->write("\n");
    out_->number(value);
    out_->write("\n");
  }
  void point(const Vec3& p) {
    number(10, p.x);
    number(20, p.y);
    number(30, p.z);
  }
  void polyline(const std::string& layer, std::span<const Vec3> points, bool closed) {
    constexpr const char *kSpatial = "8", *kSpatialClosed = "9", *kSpatialVertex = "32";
    group(0, "POLYLINE");
    group(8, layer);
    group(66, "1");  // vertices follow
    point({0, 0, 0});
    group(70, closed ? kSpatialClosed : kSpatial);
    for (const Vec3& p : points) {
      group(0, "VERTEX");
      group(8, layer);
      point(p);
      group(70, kSpatialVertex);
    }
    group(0, "SEQEND");
    group(8, layer);
  }

 private:
  Output* out_;
};

void write_dxf(Output& out, const Drawing& d) {
  Dxf dxf(out);
  for (const char* text : {"SECTION", "HEADER"}) dxf.group(text[0] == 'S' ? 0 : 2, text);
  dxf.group(9, "$ACADVER");
  dxf.group(1, "AC1009");
  dxf.group(9, "$INSUNITS");
  dxf.group(70, "4");  // millimetres
  dxf.group(0, "ENDSEC");
  for (const char* text : {"SECTION", "ENTITIES"}) dxf.group(text[0] == 'S' ? 0 : 2, text);
  const double scale = d.options.millimetres;
  if (d.options.outline) {
    for (const auto& [a, b] : outline(d.mesh, nullptr)) {
      const Vec3 ends[]{scale * a, scale * b};
      dxf.polyline("outline", ends, false);
    }
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < d.lines.size(); ++i) {
    if (d.positions[i].empty()) continue;
    points.clear();
    for (const Vec3& p : d.positions[i]) points.push_back(scale * p);
    dxf.polyline(d.value_name, points, d.lines[i].closed);
  }
  dxf.group(0, "ENDSEC");
  dxf.group(0, "EOF");
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
  if (!options.view.empty()) view_named(options.view);
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
