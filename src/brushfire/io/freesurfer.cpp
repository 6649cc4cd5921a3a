// FreeSurfer: triangle and quadrangle surfaces; curvature, annotation and label files.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace brushfire::detail {

namespace {

// Big-endian numbers in a row; what is not there is an error with its place.
class Bytes {
 public:
  explicit Bytes(const Input& input) : input_(&input) {}

  std::size_t place() const { return at_; }
  std::size_t left() const { return input_->size() - at_; }

  const char* take(std::size_t size, const char* what) {
    if (size > left()) input_->fail_byte(input_->size(), std::string("the file ends within ") + what);
    at_ += size;
    return input_->bytes().data() + at_ - size;
  }
  std::int32_t int32(const char* what) { return load<std::int32_t>(take(4, what), std::endian::big); }
  std::uint32_t int24(const char* what) {
    const char* p = take(3, what);
    return static_cast<std::uint32_t>(load<std::uint8_t>(p, std::endian::big)) << 16 |
           load<std::uint16_t>(p + 1, std::endian::big);
  }

  // A count of items of `bytes_each`, all of which must be there.
  std::size_t count(std::int64_t n, std::size_t bytes_each, const char* what) const {
    if (n < 0 || static_cast<std::uint64_t>(n) > left() / bytes_each) {
      input_->fail_byte(at_, std::string("the number of ") + what + " is " + std::to_string(n) + ", but " +
                                 std::to_string(left()) + " bytes follow");
    }
    return static_cast<std::size_t>(n);
  }

  void skip_line() {
    const std::size_t newline = input_->bytes().find('\n', at_);
    if (newline == std::string_view::npos) input_->fail_byte(input_->size(), "the file ends within the comment");
    at_ = newline + 1;
  }

  std::string name(const char* what) {
    const std::size_t size = count(int32(what), 1, what);
    const std::string text(take(size, what), size);
    return text.substr(0, text.find('\0'));
  }

  [[noreturn]] void fail(std::size_t place, const std::string& cause) const { input_->fail_byte(place, cause); }

 private:
  const Input* input_;
  std::size_t at_ = 0;
};

constexpr std::uint32_t kTriangles = 0xfffffe, kQuads = 0xffffff, kFloatQuads = 0xfffffd, kNewCurv = 0xffffff;

void add_point(Bytes& bytes, MeshParts& parts, std::size_t place, const Vec3& p) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
    bytes.fail(place, "vertex " + std::to_string(parts.positions.size()) + " has a coordinate that is not finite");
  }
  parts.positions.push_back(p);
}

void read_float_points(Bytes& bytes, std::size_t n, MeshParts& parts) {
  parts.positions.reserve(n);
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t place = bytes.place();
    const char* p = bytes.take(12, "the vertices");
    add_point(
        bytes, parts, place,
        {load<float>(p, std::endian::big), load<float>(p + 4, std::endian::big), load<float>(p + 8, std::endian::big)});
  }
}

void read_triangles(Bytes& bytes, MeshParts& parts) {
  bytes.skip_line();  // "created by ..."
  bytes.skip_line();
  const std::size_t vertices = bytes.count(bytes.int32("the number of vertices"), 1, "vertices");
  const std::int32_t faces_promised = bytes.int32("the number of faces");
  bytes.count(static_cast<std::int64_t>(vertices), 12, "vertices");
  read_float_points(bytes, vertices, parts);
  const std::size_t faces = bytes.count(faces_promised, 12, "faces");
  parts.faces.reserve(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t place = bytes.place();
    Index corner[3];
    for (Index& v : corner) {
      const std::int32_t number = bytes.int32("the faces");
      if (number < 0) bytes.fail(place, "face " + std::to_string(f) + " names vertex " + std::to_string(number));
      v = static_cast<Index>(number);
    }
    parts.faces.add_triangle(corner[0], corner[1], corner[2], place);
  }
}

// Quadrangles are split the way FreeSurfer does, by the parity of their first vertex.
void read_quads(Bytes& bytes, bool are_floats, MeshParts& parts) {
  const std::size_t vertices = bytes.int24("the number of vertices");
  const std::uint32_t quads_promised = bytes.int24("the number of faces");
  bytes.count(static_cast<std::int64_t>(vertices), are_floats ? 12 : 6, "vertices");
  if (are_floats) {
    read_float_points(bytes, vertices, parts);
  } else {
    constexpr double kHundredths = 100;
    for (std::size_t v = 0; v < vertices; ++v) {
      const char* p = bytes.take(6, "the vertices");
      const auto c = [&](std::size_t k) { return load<std::int16_t>(p + 2 * k, std::endian::big) / kHundredths; };
      parts.positions.push_back({c(0), c(1), c(2)});
    }
  }
  const std::size_t quads = bytes.count(quads_promised, 12, "faces");
  for (std::size_t q = 0; q < quads; ++q) {
    const std::size_t place = bytes.place();
    Index v[4];
    for (Index& corner : v) corner = bytes.int24("the faces");
    if (v[0] % 2 == 0) {
      parts.faces.add_triangle(v[0], v[1], v[3], place);
      parts.faces.add_triangle(v[2], v[3], v[1], place);
    } else {
      parts.faces.add_triangle(v[0], v[1], v[2], place);
      parts.faces.add_triangle(v[0], v[2], v[3], place);
    }
  }
}

}  // namespace

MeshParts read_freesurfer(const Input& input) {
  Bytes bytes(input);
  MeshParts parts;
  parts.places_are_lines = false;
  const std::uint32_t magic = bytes.int24("the magic number");
  if (magic == kTriangles) {
    read_triangles(bytes, parts);
  } else if (magic == kQuads || magic == kFloatQuads) {
    read_quads(bytes, magic == kFloatQuads, parts);
  } else {
    bytes.fail(0, "the file does not start with the magic number of a FreeSurfer surface");
  }
  return parts;
}

// Text of mris_convert: a comment, the numbers of vertices and faces, "x y z 0" and "a b c 0" each.
MeshParts read_freesurfer_text(const Input& input) {
  TextCursor text(input, input.bytes(), 1, '#');
  constexpr std::size_t kShortestRow = 8;  // "0 0 0 0\n"
  const std::size_t vertices = text.count("the number of vertices", kShortestRow);
  const std::size_t faces = text.count("the number of faces", kShortestRow);
  MeshParts parts;
  parts.positions.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    parts.positions.push_back(text.point());
    text.number("a mark");
  }
  parts.faces.reserve(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const Index a = text.index(0), b = text.index(0), c = text.index(0);
    parts.faces.add_triangle(a, b, c, text.line());
    text.number("a mark");
  }
  return parts;
}

// New files: magic, vertices, faces, values per vertex, floats. Old ones: vertices, faces, hundredths in 16 bits.
LoadedField read_freesurfer_curv(const Input& input, const std::string&) {
  Bytes bytes(input);
  LoadedField field;
  const std::uint32_t magic = bytes.int24("the magic number");
  if (magic == kNewCurv) {
    const std::int32_t vertices = bytes.int32("the number of vertices");
    bytes.int32("the number of faces");
    const std::size_t place = bytes.place();
    const std::int32_t each = bytes.int32("the number of values per vertex");
    if (each != 1) bytes.fail(place, std::to_string(each) + " values per vertex are not read, only one");
    field.values.resize(bytes.count(vertices, 4, "vertices"));
    for (double& v : field.values) v = load<float>(bytes.take(4, "the values"), std::endian::big);
    return field;
  }
  bytes.int24("the number of faces");
  constexpr double kHundredths = 100;
  field.values.resize(bytes.count(magic, 2, "vertices"));
  for (double& v : field.values) v = load<std::int16_t>(bytes.take(2, "the values"), std::endian::big) / kHundredths;
  if (bytes.left() != 0)
    bytes.fail(bytes.place(), counted(bytes.left(), "byte is", "bytes are") + " left: no curvature file");
  return field;
}

// Vertices carry the colour of their structure; the table gives colours names. Values are rows of the table, -1 where a
// colour is not in it.
LoadedField read_freesurfer_annot(const Input& input, const std::string&) {
  Bytes bytes(input);
  const std::size_t vertices = bytes.count(bytes.int32("the number of vertices"), 8, "vertices");
  std::vector<std::int32_t> colour(vertices, 0);
  for (std::size_t k = 0; k < vertices; ++k) {
    const std::size_t place = bytes.place();
    const std::int32_t v = bytes.int32("the vertices");
    if (v < 0 || static_cast<std::size_t>(v) >= vertices) {
      bytes.fail(place, "entry " + std::to_string(k) + " names vertex " + std::to_string(v) + ", but there are " +
                            std::to_string(vertices));
    }
    colour[static_cast<std::size_t>(v)] = bytes.int32("the vertices");
  }
  LoadedField field;
  std::unordered_map<std::int32_t, std::int64_t> row_of_colour;
  const auto add_row = [&](std::int64_t row) {
    std::string name = bytes.name("the colour table");
    std::uint32_t rgb = 0;
    for (int shift = 0; shift < 32; shift += 8) {
      const std::int32_t channel = bytes.int32("the colour table");
      if (shift < 24) rgb |= (static_cast<std::uint32_t>(channel) & 255u) << shift;
    }
    row_of_colour.emplace(static_cast<std::int32_t>(rgb), row);
    field.label_names.push_back({row, std::move(name)});
  };
  if (bytes.left() == 0 || bytes.int32("the colour table") != 1) bytes.fail(bytes.place(), "has no colour table");
  const std::int32_t version = bytes.int32("the colour table");
  if (version > 0) {  // the old layout: the number of rows stands first
    const std::size_t rows = bytes.count(version, 20, "rows");
    bytes.name("the colour table");
    for (std::size_t row = 0; row < rows; ++row) add_row(static_cast<std::int64_t>(row));
  } else {
    if (version != -2)
      bytes.fail(bytes.place(), "a colour table of version " + std::to_string(version) + " is not read");
    bytes.int32("the colour table");  // the largest row, which need not be filled
    bytes.name("the colour table");
    const std::size_t rows = bytes.count(bytes.int32("the colour table"), 24, "rows");
    for (std::size_t k = 0; k < rows; ++k) add_row(bytes.int32("the colour table"));
  }
  field.values.reserve(vertices);
  for (const std::int32_t c : colour) {
    const auto row = row_of_colour.find(c);
    field.values.push_back(row == row_of_colour.end() ? -1 : static_cast<double>(row->second));
  }
  return field;
}

// Text: a comment, the number of lines, then "vertex x y z value" each.
LoadedField read_freesurfer_label(const Input& input, const std::string&) {
  TextCursor text(input, input.bytes());
  if (!text.accept('#') || !text.next_line()) text.fail("the file does not start with a comment");
  constexpr std::size_t kShortestLine = 10;  // "0 0 0 0 0\n"
  const std::size_t n = text.count("the number of vertices", kShortestLine);
  LoadedField field;
  field.values.reserve(n);
  field.vertices.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    field.vertices.push_back(text.index(0));
    for (int axis = 0; axis < 3; ++axis) text.number("a coordinate");
    field.values.push_back(text.number("a value"));
  }
  return field;
}

void write_freesurfer_curv(Output& out, const Mesh& mesh, const FieldView& field) {
  if (field.values.empty()) throw Error(ErrorCode::InvalidArgument, "a FreeSurfer curvature file needs values");
  out.write("\xff\xff\xff");
  out.value(mesh.vertex_count(), std::endian::big);
  out.value(mesh.face_count(), std::endian::big);
  out.value(std::int32_t{1}, std::endian::big);
  for (const double v : field.values) out.value(static_cast<float>(v), std::endian::big);
}

}  // namespace brushfire::detail
