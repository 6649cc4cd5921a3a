// VTK XML: PolyData (.vtp) and the faces of UnstructuredGrid (.vtu), with the arrays of vtk_xml_arrays.h.
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/vtk_cells.h>
#include <brushfire/io/detail/vtk_xml_arrays.h>
#include <brushfire/io/detail/xml.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace brushfire::detail {

namespace {

// One <Piece>: arrays by the element that holds them.
struct Piece {
  std::uint64_t points = 0;
  std::size_t line = 0;
  std::optional<ArrayPlace> positions, poly_connectivity, poly_offsets, strip_connectivity, strip_offsets;
  std::optional<ArrayPlace> cell_connectivity, cell_offsets, cell_types;  // of an unstructured grid
  std::optional<ArrayPlace> line_connectivity, line_offsets;
  std::vector<ArrayPlace> point_data, cell_data;
  std::uint64_t vertices = 0, lines = 0;
};

class VtpReader {
 public:
  explicit VtpReader(const Input& input) : input_(&input), arrays_(input) {
    const std::size_t appended =
        parse_xml(input, "AppendedData", [this](std::span<const XmlElement> path) { element(path); });
    if (type_.empty()) input.fail("has no <VTKFile>");
    if (pieces_.empty()) input.fail("has no <Piece>");
    arrays_.find_appended(appended);
  }

  MeshParts read() {
    MeshParts parts;
    VtkCells cells;
    for (const Piece& piece : pieces_) read_piece(piece, cells, parts);
    if (pieces_.size() > 1) parts.remarks.push_back(std::to_string(pieces_.size()) + " pieces merged");
    cells.remark(parts);
    return parts;
  }

  LoadedField field(const std::string& wanted, ValuesOn on) {
    const bool on_cells = on == ValuesOn::Faces;
    LoadedField field;
    bool found = false;
    for (const Piece& piece : pieces_) {
      for (const ArrayPlace& array : on_cells ? piece.cell_data : piece.point_data) {
        if (array.components != 1 || (wanted.empty() ? found && array.name != field.name : array.name != wanted))
          continue;
        const std::vector<double> values = on_cells ? arrays_.numbers(array) : arrays_.numbers(array, piece.points);
        field.values.insert(field.values.end(), values.begin(), values.end());
        field.name = array.name;
        found = true;
        break;
      }
    }
    if (!found)
      input_->fail("has no scalars" + (wanted.empty() ? std::string() : " " + quote(wanted)) +
                   (on_cells ? " on its cells" : " on its points"));
    return field;
  }

  // The values of lines stand behind those of vertices, in the first scalar of the cells.
  LoadedLines lines() {
    LoadedLines loaded;
    for (const Piece& piece : pieces_) {
      MeshParts parts;
      check_points(piece);
      read_points(piece, parts);
      const std::size_t first_line = loaded.lines.size();
      read_cells(piece.line_connectivity, piece.line_offsets, piece, 0,
                 [&](std::span<const double> corners, std::size_t) {
                   LoadedLine& line = loaded.lines.emplace_back();
                   line.value = std::nan("");
                   line.closed = corners.size() > 2 && corners.front() == corners.back();
                   for (const double v : line.closed ? corners.first(corners.size() - 1) : corners) {
                     if (v != std::floor(v)) input_->fail_line(piece.line, "a line names point " + std::to_string(v));
                     line.positions.push_back(parts.positions[static_cast<std::size_t>(v)]);
                   }
                 });
      const auto scalar = std::find_if(piece.cell_data.begin(), piece.cell_data.end(),
                                       [](const ArrayPlace& a) { return a.components == 1; });
      if (scalar == piece.cell_data.end()) continue;
      loaded.value_name = scalar->name;
      const std::vector<double> values = arrays_.numbers(*scalar);
      for (std::size_t k = first_line; k < loaded.lines.size(); ++k) {
        const std::size_t at = as_size(piece.vertices + k - first_line);
        if (at < values.size()) loaded.lines[k].value = values[at];
      }
    }
    return loaded;
  }

 private:
  void element(std::span<const XmlElement> path) {
    const XmlElement& e = path.back();
    const XmlElement& root = path.front();
    if (path.size() == 1 || e.name == "AppendedData") read_root(root);
    if (e.name == "AppendedData") arrays_.read_encoding(e);
    if (e.name == "Piece") finish_piece(e);
    if (e.name != "DataArray" || path.size() < 3) return;
    const std::string& section = path[path.size() - 2].name;
    const std::string_view name = e.attribute("Name");
    struct Slot {
      std::string_view section, name;
      std::optional<ArrayPlace> Piece::* array;
    };
    static constexpr Slot kSlots[]{{"Polys", "connectivity", &Piece::poly_connectivity},
                                   {"Polys", "offsets", &Piece::poly_offsets},
                                   {"Strips", "connectivity", &Piece::strip_connectivity},
                                   {"Strips", "offsets", &Piece::strip_offsets},
                                   {"Lines", "connectivity", &Piece::line_connectivity},
                                   {"Lines", "offsets", &Piece::line_offsets},
                                   {"Cells", "connectivity", &Piece::cell_connectivity},
                                   {"Cells", "offsets", &Piece::cell_offsets},
                                   {"Cells", "types", &Piece::cell_types}};
    for (const Slot& slot : kSlots) {
      if (section == slot.section && name == slot.name) piece_.*slot.array = arrays_.place_of(e);
    }
    if (section == "Points") {
      piece_.positions = arrays_.place_of(e);
    } else if (section == "PointData" && has_numbers(e)) {  // strings and bits are passed over
      piece_.point_data.push_back(arrays_.place_of(e));
    } else if (section == "CellData" && has_numbers(e)) {
      piece_.cell_data.push_back(arrays_.place_of(e));
    }
  }

  void read_root(const XmlElement& root) {
    if (root.name != "VTKFile") return;
    type_ = root.attribute("type");
    if (type_ != "PolyData" && type_ != "UnstructuredGrid") {
      input_->fail_line(root.line,
                        "VTK XML of type " + quote(type_) + " is not read, only PolyData and UnstructuredGrid");
    }
    arrays_.read_root(root);
  }

  void finish_piece(const XmlElement& e) {
    piece_.points = e.count(*input_, "NumberOfPoints");
    piece_.vertices = e.count(*input_, "NumberOfVerts");
    piece_.lines = e.count(*input_, "NumberOfLines");
    piece_.line = e.line;
    if (e.count(*input_, "NumberOfPolys") == 0) piece_.poly_connectivity.reset();
    if (e.count(*input_, "NumberOfStrips") == 0) piece_.strip_connectivity.reset();
    if (e.count(*input_, "NumberOfCells") == 0) piece_.cell_connectivity.reset();
    constexpr std::size_t kMostPieces = 65536;
    if (pieces_.size() == kMostPieces) input_->fail_line(e.line, "more than 65536 pieces");
    pieces_.push_back(std::move(piece_));
    piece_ = {};
  }

  void read_piece(const Piece& piece, VtkCells& cells, MeshParts& parts) {
    check_points(piece);
    const std::size_t first = parts.positions.size();
    read_points(piece, parts);
    const auto first_point = static_cast<double>(first);
    read_cells(
        piece.poly_connectivity, piece.poly_offsets, piece, first_point,
        [&](std::span<const double> corners, std::size_t line) { cells.add_polygon(*input_, corners, line, parts); });
    read_cells(
        piece.strip_connectivity, piece.strip_offsets, piece, first_point,
        [&](std::span<const double> corners, std::size_t line) { cells.add_strip(*input_, corners, line, parts); });
    cells.leave_out(VtkCells::kVertices, as_size(piece.vertices));
    cells.leave_out(VtkCells::kPolyline, as_size(piece.lines));
    if (!piece.cell_connectivity) return;
    if (!piece.cell_types) input_->fail_line(piece.line, "cells without an array of types");
    const std::vector<double> types = arrays_.numbers(*piece.cell_types);
    std::vector<double> offset{0}, connectivity;
    read_cells(piece.cell_connectivity, piece.cell_offsets, piece, first_point,
               [&](std::span<const double> corners, std::size_t) {
                 connectivity.insert(connectivity.end(), corners.begin(), corners.end());
                 offset.push_back(static_cast<double>(connectivity.size()));
               });
    cells.add_grid(*input_, offset, connectivity, types, piece.cell_connectivity->line, parts);
  }

  void check_points(const Piece& piece) const {
    if (piece.points > input_->inflate_budget()) {
      input_->fail_line(piece.line,
                        "NumberOfPoints is " + std::to_string(piece.points) + ", beyond what the file can hold");
    }
  }

  void read_points(const Piece& piece, MeshParts& parts) {
    const std::size_t first = parts.positions.size();
    if (piece.positions) {
      const std::vector<double> xyz = arrays_.numbers(*piece.positions, 3 * piece.points);
      parts.positions.reserve(first + as_size(piece.points));
      for (std::size_t v = 0; v < piece.points; ++v) {
        const Vec3 p{xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]};
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
          input_->fail_line(piece.positions->line,
                            "point " + std::to_string(v) + " has a coordinate that is not finite");
        }
        parts.positions.push_back(p);
      }
    } else if (piece.points != 0) {
      input_->fail_line(piece.line, "the piece has no <Points>");
    }
  }

  template <class Use>
  void read_cells(const std::optional<ArrayPlace>& connectivity, const std::optional<ArrayPlace>& offsets,
                  const Piece& piece, double first_point, Use use) {
    if (!connectivity) return;
    if (!offsets) input_->fail_line(connectivity->line, "cells without an array of offsets");
    std::vector<double> corners = arrays_.numbers(*connectivity);
    const std::vector<double> ends = arrays_.numbers(*offsets);
    for (double& v : corners) {
      if (!(v >= 0) || v >= static_cast<double>(piece.points)) {
        input_->fail_line(connectivity->line, "a cell names point " + printable(std::to_string(v)) +
                                                  ", but there are " + std::to_string(piece.points));
      }
      v += first_point;
    }
    std::size_t begin = 0;
    for (const double e : ends) {
      if (!(e >= static_cast<double>(begin)) || e != std::floor(e) || e > static_cast<double>(corners.size())) {
        input_->fail_line(offsets->line, "offsets do not fit the " + std::to_string(corners.size()) + " corners");
      }
      const auto end = static_cast<std::size_t>(e);
      use(std::span<const double>(corners).subspan(begin, end - begin), connectivity->line);
      begin = end;
    }
  }

  const Input* input_;
  VtkXmlArrays arrays_;
  std::string type_;
  Piece piece_;
  std::vector<Piece> pieces_;
};

}  // namespace

MeshParts read_vtp(const Input& input) { return VtpReader(input).read(); }

LoadedField read_vtp_field(const Input& input, const std::string& name) {
  return VtpReader(input).field(name, ValuesOn::Vertices);
}
LoadedField read_vtp_face_field(const Input& input, const std::string& name) {
  return VtpReader(input).field(name, ValuesOn::Faces);
}

LoadedLines read_vtp_lines(const Input& input) { return VtpReader(input).lines(); }

// Appended raw data, each array behind its size in 64 bits.
void write_vtp(Output& out, const Mesh& mesh, const FieldView& field) {
  constexpr std::endian kOrder = std::endian::little;
  const std::uint64_t vertices = mesh.vertex_count(), faces = mesh.face_count();
  std::uint64_t offset = 0;
  const auto array = [&](const std::string& type, const std::string& attributes, std::uint64_t size) {
    out.write("<DataArray type=\"" + type + "\" " + attributes + " format=\"appended\" offset=\"" +
              std::to_string(offset) + "\"/>\n");
    offset += sizeof(std::uint64_t) + size;
  };
  out.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n");
  out.write("<PolyData>\n<Piece NumberOfPoints=\"" + std::to_string(vertices) +
            "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(faces) +
            "\">\n<Points>\n");
  array("Float64", "NumberOfComponents=\"3\"", 24 * vertices);
  out.write("</Points>\n<Polys>\n");
  array("Int32", "Name=\"connectivity\"", 12 * faces);
  array("Int32", "Name=\"offsets\"", 4 * faces);
  out.write("</Polys>\n<PointData");
  if (!field.values.empty()) out.write(" Scalars=\"" + field.name + "\"");
  out.write(">\n");
  if (!field.values.empty()) array("Float64", "Name=\"" + field.name + "\"", 8 * vertices);
  if (!field.labels.empty()) array("Int32", "Name=\"" + field.label_name + "\"", 4 * vertices);
  out.write("</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
  out.value(24 * vertices, kOrder);
  for (const Vec3& p : mesh.positions()) {
    for (const double x : {p.x, p.y, p.z}) out.value(x, kOrder);
  }
  out.value(12 * faces, kOrder);
  for (const Face& f : mesh.faces()) {
    for (const Index v : f) out.value(v, kOrder);
  }
  out.value(4 * faces, kOrder);
  for (std::uint64_t f = 0; f < faces; ++f) out.value(static_cast<std::int32_t>(3 * (f + 1)), kOrder);
  if (!field.values.empty()) {
    out.value(8 * vertices, kOrder);
    out.values(field.values, kOrder);
  }
  if (!field.labels.empty()) {
    out.value(4 * vertices, kOrder);
    out.values(field.labels, kOrder);
  }
  out.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace brushfire::detail
