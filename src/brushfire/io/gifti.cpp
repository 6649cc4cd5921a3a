// GIFTI (.gii): surfaces, and functional, shape and label data; ascii, base64, zlib and external binary.
//
// Based on: GIFTI Surface Data Format, version 1.0 (NITRC 2008).
#include <brushfire/core/detail/base64.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/inflate.h>
#include <brushfire/io/detail/numbers.h>
#include <brushfire/io/detail/text.h>
#include <brushfire/io/detail/xml.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

namespace brushfire::detail {

namespace {

struct GiftiArray {
  std::string intent, encoding, external_file, name;
  NumberType type = NumberType::Float32;
  std::endian order = std::endian::little;
  bool column_major = false;
  std::uint64_t rows = 0, columns = 1, external_offset = 0;
  std::size_t line = 0, begin = 0, end = 0;
  bool has_data = false;
};

struct GiftiFile {
  std::string structure;  // AnatomicalStructurePrimary, of the file or its points
  std::vector<GiftiArray> arrays;
  std::vector<LoadedField::Label> labels;
};

class GiftiParser {
 public:
  explicit GiftiParser(const Input& input) : input_(&input) {
    bool is_gifti = false;
    parse_xml(input, "", [&](std::span<const XmlElement> path) {
      is_gifti = path.front().name == "GIFTI";
      element(path);
    });
    if (!is_gifti) input.fail("has no <GIFTI>");
  }
  GiftiFile file;

 private:
  void element(std::span<const XmlElement> path) {
    const XmlElement& e = path.back();
    const std::string_view parent = path.size() > 1 ? std::string_view(path[path.size() - 2].name) : std::string_view();
    if (e.name == "DataArray") {
      finish_array(e);
    } else if (e.name == "Data" && parent == "DataArray") {
      array_.begin = e.text_begin;
      array_.end = e.text_end;
      array_.has_data = true;
    } else if (e.name == "Name" && parent == "MD") {
      key_ = text(e);
    } else if (e.name == "Value" && parent == "MD") {
      const bool is_of_array = path.size() > 3 && path[path.size() - 4].name == "DataArray";
      if (key_ == "Name" && is_of_array) array_.name = text(e);
      if (key_ == "AnatomicalStructurePrimary") file.structure = text(e);
    } else if (e.name == "Label" && parent == "LabelTable") {
      add_label(e);
    }
  }

  // The text of an element, without CDATA's brackets.
  std::string_view text(const XmlElement& e) const {
    std::string_view t = input_->bytes().substr(e.text_begin, e.text_end - e.text_begin);
    constexpr std::string_view kOpen = "<![CDATA[", kClose = "]]>";
    const std::size_t open = t.find(kOpen);
    if (open != std::string_view::npos) {
      t.remove_prefix(open + kOpen.size());
      t = t.substr(0, t.find(kClose));
    }
    return t;
  }

  void add_label(const XmlElement& e) {
    std::string_view key = e.attribute("Key");
    if (key.empty()) key = e.attribute("Index");
    std::int64_t value = 0;
    const auto result = std::from_chars(key.data(), key.data() + key.size(), value);
    if (result.ec != std::errc() || result.ptr != key.data() + key.size()) {
      input_->fail_line(e.line, "a label's key is " + quote(key) + ", not a number");
    }
    file.labels.push_back({value, std::string(text(e))});
  }

  void finish_array(const XmlElement& e) {
    GiftiArray a = std::move(array_);
    array_ = {};
    a.line = e.line;
    a.intent = e.attribute("Intent");
    a.encoding = e.attribute("Encoding");
    a.external_file = e.attribute("ExternalFileName");
    a.external_offset = e.count(*input_, "ExternalFileOffset");
    a.order = e.attribute("Endian") == "BigEndian" ? std::endian::big : std::endian::little;
    a.column_major = e.attribute("ArrayIndexingOrder") == "ColumnMajorOrder";
    a.type = type_of(e);
    const std::uint64_t dimensions = e.count(*input_, "Dimensionality", 1);
    if (dimensions < 1 || dimensions > 2) {
      input_->fail_line(e.line, "arrays of " + std::to_string(dimensions) + " dimensions are not read");
    }
    a.rows = e.count(*input_, "Dim0");
    a.columns = dimensions == 2 ? e.count(*input_, "Dim1") : 1;
    file.arrays.push_back(std::move(a));
  }

  NumberType type_of(const XmlElement& e) const {
    struct Name {
      std::string_view name;
      NumberType type;
    };
    static constexpr Name kNames[]{
        {"NIFTI_TYPE_UINT8", NumberType::UInt8},     {"NIFTI_TYPE_INT8", NumberType::Int8},
        {"NIFTI_TYPE_INT16", NumberType::Int16},     {"NIFTI_TYPE_UINT16", NumberType::UInt16},
        {"NIFTI_TYPE_INT32", NumberType::Int32},     {"NIFTI_TYPE_UINT32", NumberType::UInt32},
        {"NIFTI_TYPE_INT64", NumberType::Int64},     {"NIFTI_TYPE_UINT64", NumberType::UInt64},
        {"NIFTI_TYPE_FLOAT32", NumberType::Float32}, {"NIFTI_TYPE_FLOAT64", NumberType::Float64}};
    for (const Name& n : kNames) {
      if (n.name == e.attribute("DataType")) return n.type;
    }
    input_->fail_line(e.line, "numbers of type " + quote(e.attribute("DataType")) + " are not read");
  }

  const Input* input_;
  GiftiArray array_;
  std::string key_;  // of the metadata at hand
};

// A matrix of so many rows and columns, in row order, turned.
std::vector<double> transposed(const std::vector<double>& values, std::size_t rows, std::size_t columns) {
  std::vector<double> turned(values.size());
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) turned[c * rows + r] = values[r * columns + c];
  }
  return turned;
}

// The values of an array in row order.
std::vector<double> values_of(const Input& input, const GiftiArray& a) {
  const std::size_t budget = input.inflate_budget();
  if (a.columns != 0 && a.rows > budget / a.columns / size_of(a.type)) {
    input.fail_line(a.line, "an array of " + std::to_string(a.rows) + " times " + std::to_string(a.columns) +
                                " numbers is beyond what the file can hold");
  }
  const std::size_t count = as_size(a.rows * a.columns), size = count * size_of(a.type);
  const std::string_view text = input.bytes().substr(a.begin, a.end - a.begin);
  const auto short_of = [&](std::size_t have) {
    input.fail_line(
        a.line, "the array has " + std::to_string(have) + " bytes, but its dimensions ask for " + std::to_string(size));
  };
  std::vector<double> values;
  const auto take = [&](const char* p) {
    values.resize(count);
    load_numbers(a.type, p, a.order, count, values.data());
  };
  if (a.encoding == "ASCII") {
    TextCursor cursor(input, text, a.line);
    cursor.check_count(count, "the number of values", 2);
    values.reserve(count);
    for (std::size_t k = 0; k < count; ++k) values.push_back(cursor.number("a number"));
  } else if (a.encoding == "Base64Binary" || a.encoding == "GZipBase64Binary") {
    const Base64Result decoded = decode_base64(text);
    if (!decoded.ok) input.fail_byte(a.begin + decoded.consumed, "the data is not base64");
    if (a.encoding == "Base64Binary") {
      if (decoded.bytes.size() != size) short_of(decoded.bytes.size());
      take(decoded.bytes.data());
    } else {
      const std::string_view compressed(decoded.bytes.data(), decoded.bytes.size());
      if (!can_inflate_to(size, compressed)) short_of(compressed.size());
      std::vector<char> raw(size);
      const std::string error = inflate_exactly(compressed, raw.data(), size);
      if (!error.empty()) input.fail_line(a.line, "the array " + error);
      take(raw.data());
    }
  } else if (a.encoding == "ExternalFileBinary") {
    const Input data = input.companion(a.external_file, a.line);
    if (a.external_offset > data.size() || size > data.size() - a.external_offset) short_of(data.size());
    take(data.bytes().data() + a.external_offset);
  } else {
    input.fail_line(a.line, "data of encoding " + quote(a.encoding) + " is not read");
  }
  if (a.column_major && a.columns > 1) {
    values = transposed(values, as_size(a.columns), as_size(a.rows));
  }
  return values;
}

void need_columns(const Input& input, const GiftiArray& a, std::uint64_t columns) {
  if (a.columns != columns) {
    input.fail_line(a.line, "an array of " + a.intent + " has " + std::to_string(a.columns) + " columns, not " +
                                std::to_string(columns));
  }
}

// Points and triangles: three to a row. Some programs write them as the columns of three rows.
std::vector<double> triples_of(const Input& input, GiftiArray a, bool are_columns) {
  std::vector<double> values = values_of(input, a);
  if (are_columns && a.rows == 3) {
    values = transposed(values, as_size(a.rows), as_size(a.columns));
    std::swap(a.rows, a.columns);
  }
  need_columns(input, a, 3);
  return values;
}

bool has_three_rows_only(const GiftiArray& a) { return a.rows == 3 && a.columns != 3; }

}  // namespace

MeshParts read_gifti(const Input& input) {
  const GiftiFile file = GiftiParser(input).file;
  const GiftiArray* points = nullptr;
  const GiftiArray* triangles = nullptr;
  MeshParts parts;
  bool others = false;
  for (const GiftiArray& a : file.arrays) {
    const GiftiArray*& slot = a.intent == "NIFTI_INTENT_POINTSET" ? points : triangles;
    if (a.intent != "NIFTI_INTENT_POINTSET" && a.intent != "NIFTI_INTENT_TRIANGLE") continue;
    others = others || slot != nullptr;
    if (slot == nullptr) slot = &a;
  }
  if (points == nullptr) input.fail("has no array of points: no surface");
  if (triangles == nullptr) input.fail("has no array of triangles: no surface");
  if (others) parts.remarks.emplace_back("several surfaces, of which the first was read");
  parts.structure = file.structure;
  const bool are_columns = has_three_rows_only(*points) || has_three_rows_only(*triangles);
  const std::vector<double> xyz = triples_of(input, *points, are_columns);
  parts.positions.resize(xyz.size() / 3);
  for (std::size_t v = 0; v < parts.positions.size(); ++v) {
    parts.positions[v] = {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]};
    if (!std::isfinite(xyz[3 * v]) || !std::isfinite(xyz[3 * v + 1]) || !std::isfinite(xyz[3 * v + 2])) {
      input.fail_line(points->line, "point " + std::to_string(v) + " has a coordinate that is not finite");
    }
  }
  const std::vector<double> corners = triples_of(input, *triangles, are_columns);
  parts.faces.reserve(corners.size() / 3);
  for (std::size_t f = 0; f + 2 < corners.size(); f += 3) {
    for (std::size_t k = f; k < f + 3; ++k) {
      if (!(corners[k] >= 0) || corners[k] >= static_cast<double>(kNoIndex) || corners[k] != std::floor(corners[k])) {
        input.fail_line(triangles->line,
                        "triangle " + std::to_string(f / 3) + " names point " + std::to_string(corners[k]));
      }
    }
    parts.faces.add_triangle(static_cast<Index>(corners[f]), static_cast<Index>(corners[f + 1]),
                             static_cast<Index>(corners[f + 2]), triangles->line);
  }
  return parts;
}

LoadedField read_gifti_field(const Input& input, const std::string& name) {
  GiftiFile file = GiftiParser(input).file;
  for (const GiftiArray& a : file.arrays) {
    if (a.intent == "NIFTI_INTENT_POINTSET" || a.intent == "NIFTI_INTENT_TRIANGLE") continue;
    if (!name.empty() && a.name != name) continue;
    if (a.rows != 1) need_columns(input, a, 1);
    LoadedField field;
    field.values = values_of(input, a);
    field.name = a.name;
    field.label_names = std::move(file.labels);
    return field;
  }
  input.fail(name.empty() ? "has no data on vertices" : "has no array " + quote(name));
}

namespace {

std::string metadata(const std::string& name, const std::string& value) {
  return "<MD><Name><![CDATA[" + name + "]]></Name><Value><![CDATA[" + value + "]]></Value></MD>";
}

// What the surface calls itself; nothing where that would end the CDATA section it stands in.
std::string structure_metadata(const std::string& structure) {
  if (structure.empty() || structure.find("]]>") != std::string::npos) return {};
  return metadata("AnatomicalStructurePrimary", printable(structure));
}

void write_gifti_start(Output& out, int arrays, const std::string& metadata) {
  out.write(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE GIFTI SYSTEM "
      "\"http://www.nitrc.org/frs/download.php/115/gifti.dtd\">\n");
  out.write("<GIFTI Version=\"1.0\" NumberOfDataArrays=\"" + std::to_string(arrays) + "\">\n<MetaData>" + metadata +
            "</MetaData>\n<LabelTable/>\n");
}

// `columns` 0: one dimension.
template <class T>
void write_gifti_array(Output& out, const std::string& metadata, const char* intent, const char* type,
                       std::span<const T> values, std::size_t columns = 0) {
  std::string raw(values.size() * sizeof(T), '\0');
  for (std::size_t k = 0; k < values.size(); ++k) store(values[k], raw.data() + k * sizeof(T), std::endian::little);
  const std::string compressed = deflate(raw);
  const std::string dimensions = columns == 0 ? "\"1\" Dim0=\"" + std::to_string(values.size()) + "\""
                                              : "\"2\" Dim0=\"" + std::to_string(values.size() / columns) +
                                                    "\" Dim1=\"" + std::to_string(columns) + "\"";
  out.write("<DataArray Intent=\"" + std::string(intent) + "\" DataType=\"" + type +
            "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=" + dimensions + " Encoding=\"" +
            (compressed.empty() ? "Base64Binary" : "GZipBase64Binary") +
            "\" Endian=\"LittleEndian\" ExternalFileName=\"\" ExternalFileOffset=\"\">\n<MetaData>" + metadata +
            "</MetaData>\n");
  if (columns == 3 && std::string_view(intent) == "NIFTI_INTENT_POINTSET") {
    out.write(
        "<CoordinateSystemTransformMatrix><DataSpace><![CDATA[NIFTI_XFORM_UNKNOWN]]></DataSpace><TransformedSpace>"
        "<![CDATA[NIFTI_XFORM_UNKNOWN]]></TransformedSpace><MatrixData>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</MatrixData>"
        "</CoordinateSystemTransformMatrix>\n");
  }
  out.write("<Data>");
  out.write(encode_base64(compressed.empty() ? raw : compressed));
  out.write("</Data>\n</DataArray>\n");
}

}  // namespace

void write_gifti(Output& out, const Mesh&, const FieldView& field) {
  write_gifti_start(out, (field.values.empty() ? 0 : 1) + (field.labels.empty() ? 0 : 1),
                    structure_metadata(field.structure));
  if (!field.values.empty()) {
    const std::vector<float> narrow(field.values.begin(), field.values.end());
    write_gifti_array<float>(out, metadata("Name", field.name), "NIFTI_INTENT_NONE", "NIFTI_TYPE_FLOAT32", narrow);
  }
  if (!field.labels.empty()) {
    const std::vector<std::int32_t> keys(field.labels.begin(), field.labels.end());
    write_gifti_array<std::int32_t>(out, metadata("Name", field.label_name), "NIFTI_INTENT_NONE", "NIFTI_TYPE_INT32",
                                    keys);
  }
  out.write("</GIFTI>\n");
}

void write_gifti_surface(Output& out, const Mesh& mesh, const std::string& structure) {
  std::vector<float> points;
  for (const Vec3& p : mesh.positions()) {
    for (const double x : {p.x, p.y, p.z}) points.push_back(static_cast<float>(x));
  }
  std::vector<std::int32_t> corners;
  for (const Face& f : mesh.faces()) corners.insert(corners.end(), f.begin(), f.end());
  write_gifti_start(out, 2, "");
  write_gifti_array<float>(out, structure_metadata(structure), "NIFTI_INTENT_POINTSET", "NIFTI_TYPE_FLOAT32", points,
                           3);
  write_gifti_array<std::int32_t>(out, "", "NIFTI_INTENT_TRIANGLE", "NIFTI_TYPE_INT32", corners, 3);
  out.write("</GIFTI>\n");
}

}  // namespace brushfire::detail
