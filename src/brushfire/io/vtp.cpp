// VTK XML: PolyData (.vtp) and the faces of UnstructuredGrid (.vtu); ascii, base64 and appended data, raw or
// compressed.
#include <brushfire/core/detail/base64.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/inflate.h>
#include <brushfire/io/detail/numbers.h>
#include <brushfire/io/detail/text.h>
#include <brushfire/io/detail/vtk_cells.h>
#include <brushfire/io/detail/xml.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace brushfire::detail {

namespace {

// Where an array stands, before it is decoded.
struct ArrayPlace {
  std::string name, format;
  NumberType type = NumberType::Float64;
  std::size_t line = 0, begin = 0, end = 0;  // bytes of the text, or of the appended data
  std::uint64_t components = 1;
};

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

enum class Compressor : std::uint8_t { None, Zlib, Lz4, Xz };

std::optional<NumberType> type_of(const XmlElement& e) {
  struct Name {
    std::string_view name;
    NumberType type;
  };
  static constexpr Name kNames[]{{"Int8", NumberType::Int8},       {"UInt8", NumberType::UInt8},
                                 {"Int16", NumberType::Int16},     {"UInt16", NumberType::UInt16},
                                 {"Int32", NumberType::Int32},     {"UInt32", NumberType::UInt32},
                                 {"Int64", NumberType::Int64},     {"UInt64", NumberType::UInt64},
                                 {"Float32", NumberType::Float32}, {"Float64", NumberType::Float64}};
  for (const Name& n : kNames) {
    if (n.name == e.attribute("type")) return n.type;
  }
  return std::nullopt;
}

class VtpReader {
 public:
  explicit VtpReader(const Input& input) : input_(&input), budget_(input.inflate_budget()) {
    appended_ = parse_xml(input, "AppendedData", [this](std::span<const XmlElement> path) { element(path); });
    if (type_.empty()) input.fail("has no <VTKFile>");
    if (pieces_.empty()) input.fail("has no <Piece>");
    find_appended();
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
        const std::vector<double> values = on_cells ? numbers(array) : numbers(array, piece.points);
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
      const std::vector<double> values = numbers(*scalar);
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
    if (e.name == "AppendedData") appended_is_base64_ = e.attribute("encoding") == "base64";
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
      if (section == slot.section && name == slot.name) piece_.*slot.array = place_of(e);
    }
    if (section == "Points") {
      piece_.positions = place_of(e);
    } else if (section == "PointData" && type_of(e)) {  // strings and bits are passed over
      piece_.point_data.push_back(place_of(e));
    } else if (section == "CellData" && type_of(e)) {
      piece_.cell_data.push_back(place_of(e));
    }
  }

  void read_root(const XmlElement& root) {
    if (root.name != "VTKFile") return;
    type_ = root.attribute("type");
    if (type_ != "PolyData" && type_ != "UnstructuredGrid") {
      input_->fail_line(root.line,
                        "VTK XML of type " + quote(type_) + " is not read, only PolyData and UnstructuredGrid");
    }
    order_ = root.attribute("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    header_is_64_ = root.attribute("header_type") == "UInt64";
    compressor_ = compressor_of(root);
  }

  Compressor compressor_of(const XmlElement& root) const {
    const std::string_view name = root.attribute("compressor");
    if (name.empty()) return Compressor::None;
    if (name == "vtkZLibDataCompressor") return Compressor::Zlib;
    if (name == "vtkLZ4DataCompressor") return Compressor::Lz4;
    if (name == "vtkLZMADataCompressor") return Compressor::Xz;
    input_->fail_line(root.line, "compressor " + quote(name) + " is not read, only those of zlib, LZ4 and LZMA");
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

  ArrayPlace place_of(const XmlElement& e) const {
    ArrayPlace a;
    a.name = e.attribute("Name");
    a.format = e.attribute("format");
    const std::optional<NumberType> type = type_of(e);
    if (!type) input_->fail_line(e.line, "numbers of type " + quote(e.attribute("type")) + " are not read");
    a.type = *type;
    a.line = e.line;
    a.components = e.count(*input_, "NumberOfComponents", 1);
    a.begin = a.format == "appended" ? as_size(e.count(*input_, "offset")) : e.text_begin;
    a.end = e.text_end;
    return a;
  }

  // The data starts behind the underscore.
  void find_appended() {
    const std::string_view bytes = input_->bytes();
    if (appended_ >= bytes.size()) return;
    const std::size_t underscore = bytes.find('_', appended_);
    if (underscore == std::string_view::npos) input_->fail_byte(appended_, "appended data does not start with '_'");
    appended_ = underscore + 1;
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
    const std::vector<double> types = numbers(*piece.cell_types);
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
      const std::vector<double> xyz = numbers(*piece.positions, 3 * piece.points);
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
    std::vector<double> corners = numbers(*connectivity);
    const std::vector<double> ends = numbers(*offsets);
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

  // The values of an array: `expected` of them, or as many as there are.
  std::vector<double> numbers(const ArrayPlace& a, std::optional<std::uint64_t> expected = std::nullopt) {
    std::vector<double> values;
    if (a.format == "ascii" || a.format.empty()) {
      TextCursor text(*input_, input_->bytes().substr(a.begin, a.end - a.begin), a.line);
      while (text.to_word()) values.push_back(text.number_here("a number"));
    } else {
      const std::vector<char> raw = decode(a);
      spend(a, raw.size());
      values.resize(raw.size() / size_of(a.type));
      load_numbers(a.type, raw.data(), order_, values.size(), values.data());
    }
    if (expected && values.size() != *expected) {
      input_->fail_line(a.line, "the array has " + std::to_string(values.size()) + " numbers, but " +
                                    std::to_string(*expected) + " are needed");
    }
    return values;
  }

  // Many pieces may name the same appended data: what comes out altogether is bounded by the file's size.
  void spend(const ArrayPlace& a, std::size_t bytes) {
    if (bytes > budget_) input_->fail_line(a.line, "the arrays come to far more than the file's size: refused");
    budget_ -= bytes;
  }

  std::vector<char> decode(const ArrayPlace& a) {
    if (a.format == "binary") return decode_base64_block(a, input_->bytes().substr(a.begin, a.end - a.begin));
    if (a.format != "appended") input_->fail_line(a.line, "data of format " + quote(a.format) + " is not read");
    const std::string_view data = input_->bytes().substr(std::min(appended_, input_->size()));
    if (a.begin >= data.size())
      input_->fail_line(a.line, "offset " + std::to_string(a.begin) + " is beyond the appended data");
    if (appended_is_base64_) return decode_base64_block(a, data.substr(a.begin));
    return unpack(a, data.substr(a.begin));
  }

  std::size_t header_size() const { return header_is_64_ ? 8 : 4; }
  std::uint64_t header_word(std::string_view bytes, std::size_t k) const {
    const char* p = bytes.data() + k * header_size();
    return header_is_64_ ? load<std::uint64_t>(p, order_) : load<std::uint32_t>(p, order_);
  }

  // Raw bytes: [size] data, or [blocks][block size][last block size][compressed sizes...] data.
  std::vector<char> unpack(const ArrayPlace& a, std::string_view bytes) {
    if (compressor_ == Compressor::None) {
      if (bytes.size() < header_size()) fail_short(a);
      const std::uint64_t size = header_word(bytes, 0);
      bytes.remove_prefix(header_size());
      if (size > bytes.size()) fail_short(a);
      return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
    }
    const std::size_t header = compressed_header_size(a, bytes);
    return inflate_blocks(a, bytes.substr(0, header), bytes.substr(header));
  }

  std::size_t compressed_header_size(const ArrayPlace& a, std::string_view bytes) const {
    if (bytes.size() < header_size()) fail_short(a);
    const std::uint64_t blocks = header_word(bytes, 0);
    if (bytes.size() / header_size() < 3 || blocks > bytes.size() / header_size() - 3) fail_short(a);
    return as_size(3 + blocks) * header_size();
  }

  // One block of compressed data into `size` bytes at `target`; an empty string, or what is wrong.
  std::string expand(std::string_view block, char* target, std::size_t size) const {
    if (compressor_ == Compressor::Lz4) return expand_lz4(block, target, size);
    if (compressor_ == Compressor::Xz) return expand_xz(block, target, size);
    return inflate_exactly(block, target, size);
  }

  // Neither deflate nor LZ4 does better than 1032 to 1; for xz there is no such bound but what the file may inflate to.
  bool can_expand_to(std::size_t size, std::string_view block) const {
    return compressor_ == Compressor::Xz || can_inflate_to(size, block);
  }

  std::vector<char> inflate_blocks(const ArrayPlace& a, std::string_view header, std::string_view data) {
    const std::uint64_t blocks = header_word(header, 0), size = header_word(header, 1), last = header_word(header, 2);
    const std::uint64_t whole = blocks == 0 ? 0 : last == 0 ? blocks : blocks - 1;
    const bool too_large =
        (whole != 0 && size > budget_ / whole) || last > budget_ || (blocks != 0 && whole * size > budget_ - last);
    if (too_large) input_->fail_line(a.line, "the array inflates to far more than the file's size: refused");
    std::vector<char> out;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t length = as_size(header_word(header, 3 + b));
      if (length > data.size()) fail_short(a);
      const std::size_t wanted = as_size(b + 1 == blocks && last != 0 ? last : size);
      const std::size_t at = out.size();
      if (!can_expand_to(wanted, data.substr(0, length))) fail_short(a);
      out.resize(at + wanted);
      const std::string error = expand(data.substr(0, length), out.data() + at, wanted);
      if (!error.empty()) input_->fail_line(a.line, "block " + std::to_string(b) + " of the array: " + error);
      data.remove_prefix(length);
    }
    return out;
  }

  // The header of compressed data is a base64 stream of its own. What follows an array in appended data is the next
  // array or the end of the file, so only what is needed is decoded.
  std::vector<char> decode_base64_block(const ArrayPlace& a, std::string_view text) {
    const auto view = [](const std::vector<char>& bytes) { return std::string_view(bytes.data(), bytes.size()); };
    const std::vector<char> start = decode_some(a, text, header_size()).bytes;
    const std::uint64_t first = header_word(view(start), 0);
    if (first > text.size()) fail_short(a);  // bytes of data, or blocks
    if (compressor_ == Compressor::None)
      return unpack(a, view(decode_some(a, text, header_size() + as_size(first)).bytes));
    const std::size_t size = as_size((3 + first) * header_size());
    const Base64Result header = decode_some(a, text, size);
    std::size_t compressed = 0;
    for (std::size_t b = 0; b < first; ++b) {
      const std::size_t length = as_size(header_word(view(header.bytes), 3 + b));
      if (length > text.size() - compressed) fail_short(a);
      compressed += length;
    }
    const Base64Result data = decode_some(a, text.substr(header.consumed), compressed);
    return inflate_blocks(a, view(header.bytes).substr(0, size), view(data.bytes));
  }

  // At least `size` bytes from the start of the text.
  Base64Result decode_some(const ArrayPlace& a, std::string_view text, std::size_t size) const {
    Base64Result result = decode_base64(text, size);
    if (result.bytes.size() >= size) return result;
    if (!result.ok) input_->fail_line(a.line, "the array's data is not base64");
    fail_short(a);
  }

  [[noreturn]] void fail_short(const ArrayPlace& a) const { input_->fail_line(a.line, "the array's data ends early"); }

  const Input* input_;
  std::size_t budget_;
  std::size_t appended_ = 0;
  std::string type_;
  bool header_is_64_ = false, appended_is_base64_ = false;
  Compressor compressor_ = Compressor::None;
  std::endian order_ = std::endian::little;
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
