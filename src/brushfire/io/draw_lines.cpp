// Curves as drawings: SVG and DXF, in millimetres.
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/csv.h>
#include <brushfire/io/detail/drawing.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brushfire::detail {
namespace {

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

}  // namespace

void check_view(const std::string& name) { view_named(name); }

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

namespace {

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

}  // namespace

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

}  // namespace brushfire::detail
