// Legacy VTK: surfaces of PolyData and UnstructuredGrid, ascii and binary, up to version 5.
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/vtk_cells.h>
#include <brushfire/io/detail/vtk_text.h>

#include <cmath>
#include <optional>

namespace brushfire::detail {

namespace {

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return out;
}

class VtkReader {
 public:
  // `wanted`: the array of points or cells to keep; nullptr for none, "" for the first of one component.
  VtkReader(const Input& input, const std::string* wanted, ValuesOn on)
      : input_(&input), in_(input), wanted_(wanted), on_points_(on == ValuesOn::Vertices) {}

  MeshParts read() {
    read_preamble();
    while (next_keyword()) read_section();
    if (!has_points_) text_.fail("the file has no POINTS");
    if (kind_ == Kind::Grid) {
      cells_.add_grid(*input_, grid_offset_, grid_connectivity_, grid_types_, grid_place_, parts_);
    }
    cells_.remark(parts_);
    return std::move(parts_);
  }

  std::optional<LoadedField> field() { return std::move(field_); }

 private:
  enum class Kind { PolyData, Grid };

  void read_preamble() {
    text_.to_word();
    const std::string_view first = text_.rest_of_line();
    if (first.substr(0, 14) != "# vtk DataFile") text_.fail("the file does not start with '# vtk DataFile'");
    text_.next_line();
    text_.next_line();  // the title
    const std::string encoding = upper(text_.word());
    if (encoding != "ASCII" && encoding != "BINARY") text_.fail(quote(encoding) + " where ASCII or BINARY is expected");
    in_.binary = encoding == "BINARY";
    parts_.places_are_lines = !in_.binary;
    if (upper(text_.word()) != "DATASET") text_.fail("DATASET is expected");
    const std::string kind = upper(text_.word());
    if (kind == "UNSTRUCTURED_GRID") {
      kind_ = Kind::Grid;
    } else if (kind != "POLYDATA") {
      text_.fail("a dataset of type " + quote(kind) + " is not read, only POLYDATA and UNSTRUCTURED_GRID");
    }
  }

  bool next_keyword() {
    if (!text_.to_word()) return false;
    keyword_ = upper(text_.word_here());
    return true;
  }

  void read_section() {
    if (keyword_ == "POINTS") {
      read_points();
    } else if (keyword_ == "POLYGONS") {
      read_cells(
          [this](std::span<const double> v, std::size_t place) { cells_.add_polygon(*input_, v, place, parts_); });
    } else if (keyword_ == "TRIANGLE_STRIPS") {
      read_cells([this](std::span<const double> v, std::size_t place) { cells_.add_strip(*input_, v, place, parts_); });
    } else if (keyword_ == "VERTICES" || keyword_ == "LINES") {
      const std::uint8_t type = keyword_ == "LINES" ? VtkCells::kPolyline : VtkCells::kVertices;
      read_cells([&](std::span<const double>, std::size_t) { cells_.leave_out(type); });
    } else if (keyword_ == "CELLS") {
      read_grid_cells();
    } else if (keyword_ == "CELL_TYPES") {
      grid_types_ = in_.read_array(NumberType::Int32, text_.count("the number of cells", 1));
    } else if (keyword_ == "POINT_DATA" || keyword_ == "CELL_DATA") {
      attributes_of_ = in_.count_of_tuples();
      point_data_ = keyword_ == "POINT_DATA";
    } else if (keyword_ == "METADATA") {
      while (text_.next_line() && text_.to_word_on_line()) {
      }
    } else {
      read_attribute();
    }
  }

  void read_points() {
    const std::size_t n = text_.count("the number of points", 1);
    const std::vector<double> xyz = in_.read_array(in_.read_type(), in_.checked_product(n, 3));
    parts_.positions.resize(n);
    for (std::size_t v = 0; v < n; ++v) {
      parts_.positions[v] = {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!std::isfinite(xyz[3 * v + k]))
          in_.fail("point " + std::to_string(v) + " has a coordinate that is not finite");
      }
    }
    has_points_ = true;
  }

  // Up to version 4 "n a b ..." per cell, from 5 on an array of offsets and one of connectivity.
  template <class Use>
  void read_cells(Use use) {
    const std::size_t place = in_.place();
    std::vector<double> offset, connectivity;
    read_connectivity(offset, connectivity);
    for (std::size_t c = 0; c + 1 < offset.size(); ++c) {
      const auto begin = static_cast<std::size_t>(offset[c]), end = static_cast<std::size_t>(offset[c + 1]);
      use(std::span<const double>(connectivity).subspan(begin, end - begin), place);
    }
  }

  void read_grid_cells() {
    grid_place_ = in_.place();
    read_connectivity(grid_offset_, grid_connectivity_);
  }

  void read_connectivity(std::vector<double>& offset, std::vector<double>& connectivity) {
    const std::size_t n = text_.count("the number of cells", 1);
    const std::size_t size = text_.count("the number of entries", 1);
    TextCursor ahead = text_;
    if (ahead.to_word() && upper(ahead.word_here()) == "OFFSETS") {
      text_ = ahead;
      offset = in_.read_array(in_.read_type(), n);
      if (!text_.to_word() || upper(text_.word_here()) != "CONNECTIVITY") in_.fail("CONNECTIVITY is expected");
      connectivity = in_.read_array(in_.read_type(), size);
      check_offsets(offset, size);
      return;
    }
    const std::vector<double> raw = in_.read_array(NumberType::Int32, size);
    connectivity.reserve(raw.size());
    offset.reserve(n + 1);
    offset.push_back(0);
    std::size_t at = 0;
    for (std::size_t c = 0; c < n; ++c) {
      if (at >= raw.size() || !(raw[at] >= 0) || raw[at] != std::floor(raw[at]) ||
          raw[at] > static_cast<double>(raw.size() - at - 1)) {
        in_.fail("cell " + std::to_string(c) + " of " + keyword_ + " reaches beyond the " + std::to_string(size) +
                 " entries");
      }
      const auto corners = static_cast<std::size_t>(raw[at++]);
      connectivity.insert(connectivity.end(), raw.begin() + static_cast<std::ptrdiff_t>(at),
                          raw.begin() + static_cast<std::ptrdiff_t>(at + corners));
      at += corners;
      offset.push_back(static_cast<double>(connectivity.size()));
    }
  }

  void check_offsets(const std::vector<double>& offset, std::size_t size) {
    double last = 0;
    for (std::size_t c = 0; c < offset.size(); ++c) {
      if (!(offset[c] >= last) || offset[c] != std::floor(offset[c]) || offset[c] > static_cast<double>(size) ||
          (c == 0 && offset[c] != 0)) {
        in_.fail("offset " + std::to_string(c) + " of " + keyword_ + " does not fit the " + std::to_string(size) +
                 " entries");
      }
      last = offset[c];
    }
  }

  // SCALARS, VECTORS and the rest behind POINT_DATA and CELL_DATA.
  void read_attribute() {
    if (keyword_ == "SCALARS") {
      const std::string name(in_.one_word("a name"));
      const std::string type = in_.type_name();
      std::size_t components = 1;
      if (text_.to_word_on_line()) components = text_.count("the number of components", 1);
      TextCursor ahead = text_;
      if (ahead.to_word() && upper(ahead.word_here()) == "LOOKUP_TABLE") {
        ahead.to_word_on_line();
        ahead.word_here();
        text_ = ahead;
      }
      keep(name, components, in_.read_attribute_array(type, in_.checked_product(attributes_of_, components)));
    } else if (keyword_ == "VECTORS" || keyword_ == "NORMALS") {
      skip_attribute(3);
    } else if (keyword_ == "TENSORS") {
      skip_attribute(9);
    } else if (keyword_ == "GLOBAL_IDS" || keyword_ == "PEDIGREE_IDS") {
      skip_attribute(1);
    } else if (keyword_ == "TEXTURE_COORDINATES") {
      in_.one_word("a name");
      const std::size_t dimension = text_.count("the dimension", 1);
      in_.read_array(in_.read_type(), in_.checked_product(attributes_of_, dimension));
    } else if (keyword_ == "COLOR_SCALARS") {
      in_.one_word("a name");
      const std::size_t components = text_.count("the number of components", 1);
      in_.read_array(in_.binary ? NumberType::UInt8 : NumberType::Float32,
                     in_.checked_product(attributes_of_, components));
    } else if (keyword_ == "LOOKUP_TABLE") {
      in_.one_word("a name");
      in_.read_array(in_.binary ? NumberType::UInt8 : NumberType::Float32,
                     in_.checked_product(text_.count("the size", 1), 4));
    } else if (keyword_ == "FIELD") {
      read_field_arrays();
    } else {
      text_.fail(quote(keyword_) + " where a keyword of legacy VTK is expected");
    }
  }

  void skip_attribute(std::size_t components) {
    in_.one_word("a name");
    const std::string type = in_.type_name();
    in_.read_attribute_array(type, in_.checked_product(attributes_of_, components));
  }

  void read_field_arrays() {
    in_.one_word("a name");
    const std::size_t arrays = text_.count("the number of arrays", 1);
    for (std::size_t a = 0; a < arrays; ++a) {
      std::string name(in_.one_word("a name"));
      while (upper(name) == "METADATA") {
        while (text_.next_line() && text_.to_word_on_line()) {
        }
        name = in_.one_word("a name");
      }
      const std::size_t components = text_.count("the number of components", 1);
      const std::size_t tuples = in_.count_of_tuples();
      const std::string type = in_.type_name();
      const std::vector<double> values = in_.read_attribute_array(type, in_.checked_product(tuples, components));
      if (tuples == attributes_of_) keep(name, components, values);
    }
  }

  void keep(const std::string& name, std::size_t components, const std::vector<double>& values) {
    if (wanted_ == nullptr || point_data_ != on_points_ || field_ || components != 1 || values.size() != attributes_of_)
      return;
    if (!wanted_->empty() && *wanted_ != name) return;
    field_.emplace();
    field_->name = name;
    field_->values = values;
  }

  const Input* input_;
  VtkText in_;
  TextCursor& text_ = in_.text;
  const std::string* wanted_;
  bool on_points_;
  MeshParts parts_;
  VtkCells cells_;
  std::optional<LoadedField> field_;
  std::string keyword_;
  Kind kind_ = Kind::PolyData;
  bool has_points_ = false, point_data_ = false;
  std::size_t attributes_of_ = 0;
  std::vector<double> grid_offset_, grid_connectivity_, grid_types_;
  std::size_t grid_place_ = 0;
};

LoadedField read_field_on(const Input& input, const std::string& name, ValuesOn on) {
  VtkReader reader(input, &name, on);
  reader.read();
  std::optional<LoadedField> field = reader.field();
  if (!field) {
    input.fail("has no scalars" + (name.empty() ? std::string() : " " + quote(name)) +
               (on == ValuesOn::Vertices ? " on its points" : " on its cells"));
  }
  return std::move(*field);
}

}  // namespace

MeshParts read_vtk(const Input& input) { return VtkReader(input, nullptr, ValuesOn::Vertices).read(); }

LoadedField read_vtk_field(const Input& input, const std::string& name) {
  return read_field_on(input, name, ValuesOn::Vertices);
}

LoadedField read_vtk_face_field(const Input& input, const std::string& name) {
  return read_field_on(input, name, ValuesOn::Faces);
}

void write_vtk(Output& out, const Mesh& mesh, const FieldView& field) {
  constexpr std::endian kOrder = std::endian::big;
  const std::string vertices = std::to_string(mesh.vertex_count());
  out.write("# vtk DataFile Version 3.0\nbrushfire\nBINARY\nDATASET POLYDATA\nPOINTS " + vertices + " double\n");
  for (const Vec3& p : mesh.positions()) {
    for (const double x : {p.x, p.y, p.z}) out.value(x, kOrder);
  }
  out.write("\nPOLYGONS " + std::to_string(mesh.face_count()) + " " +
            std::to_string(std::uint64_t{4} * mesh.face_count()) + "\n");
  for (const Face& f : mesh.faces()) {
    out.value(std::int32_t{3}, kOrder);
    for (const Index v : f) out.value(v, kOrder);
  }
  if (!field.values.empty() || !field.labels.empty()) out.write("\nPOINT_DATA " + vertices + "\n");
  if (!field.values.empty()) {
    out.write("SCALARS " + field.name + " double 1\nLOOKUP_TABLE default\n");
    out.values(field.values, kOrder);
    out.write('\n');
  }
  if (!field.labels.empty()) {
    out.write("SCALARS " + field.label_name + " int 1\nLOOKUP_TABLE default\n");
    out.values(field.labels, kOrder);
    out.write('\n');
  }
}

}  // namespace brushfire::detail
