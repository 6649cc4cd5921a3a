// Wavefront OBJ: v and f lines; texture coordinates, normals, groups and materials are passed over.
#include <brushfire/io/detail/colours.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>

namespace brushfire::detail {

namespace {

class ObjReader {
 public:
  explicit ObjReader(const Input& input) : text_(input, input.bytes(), 1, '#') {}

  MeshParts read() {
    parts_.counts_from = 1;
    while (true) {
      if (text_.to_word_on_line()) read_line();
      if (!text_.next_line()) break;
    }
    if (is_planar_) parts_.remarks.emplace_back(kPlanarRemark);
    if (lines_ != 0)
      parts_.remarks.push_back(counted(lines_, "line or point element", "line and point elements") + " left out");
    return std::move(parts_);
  }

 private:
  void read_line() {
    const std::string_view keyword = text_.word_here();
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f" || keyword == "fo") {
      read_face();
    } else if (keyword == "l" || keyword == "p") {
      ++lines_;
    }
  }

  // What follows the three coordinates is a weight for curves or a colour. Vertices of two coordinates lie in the
  // plane, where all of them do; a single one is a line that was cut.
  void read_vertex() {
    double c[3]{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!to_word_of_statement() && k == 2 && (is_planar_ || parts_.positions.empty())) {
        is_planar_ = true;
        break;
      }
      c[k] = text_.coordinate_here();
      if (k == 2 && is_planar_) text_.fail("three coordinates, but the vertices before have two");
    }
    parts_.positions.push_back({c[0], c[1], c[2]});
  }

  void read_face() {
    const std::size_t line = text_.line();
    corners_.clear();
    while (to_word_of_statement()) {
      corners_.push_back(vertex_of(text_.digits_here("a vertex number")));
      // "7", "7/1", "7/1/3", "7//3": what follows the vertex has the same form and does not matter here.
      for (int k = 0; k < 2 && text_.accept('/'); ++k) {
        if (!text_.at_end() && text_.peek() != '/' && !TextCursor::is_space(text_.peek()))
          text_.digits_here("an index");
      }
      if (!text_.at_end() && !TextCursor::is_space(text_.peek())) text_.fail_word("a vertex number");
    }
    parts_.faces.add(corners_, line);
  }

  // A backslash at the end of a line continues the statement on the next.
  bool to_word_of_statement() {
    while (text_.to_word_on_line()) {
      if (text_.peek() != '\\') return true;
      text_.accept('\\');
      if (text_.to_word_on_line()) text_.fail("a backslash within a line");
      if (!text_.next_line()) return false;
    }
    return false;
  }

  // Numbers count from 1, or backwards from the latest vertex.
  Index vertex_of(std::int64_t number) {
    const auto so_far = static_cast<std::int64_t>(parts_.positions.size());
    if (number == 0) text_.fail("vertex number 0, but they count from 1");
    if (number < -so_far) {
      text_.fail("vertex number " + std::to_string(number) + " reaches back beyond the " + std::to_string(so_far) +
                 " vertices so far");
    }
    if (number > static_cast<std::int64_t>(kNoIndex)) {
      text_.fail("vertex number " + std::to_string(number) + " is beyond 32 bits");
    }
    return static_cast<Index>(number > 0 ? number - 1 : so_far + number);
  }

  TextCursor text_;
  MeshParts parts_;
  std::vector<Index> corners_;
  std::size_t lines_ = 0;
  bool is_planar_ = false;
};

}  // namespace

MeshParts read_obj(const Input& input) {
  MeshParts parts = ObjReader(input).read();
  if (parts.positions.empty() && parts.faces.count() == 0 && input.size() != 0) {
    input.fail("has neither a vertex nor a face: no OBJ file");
  }
  return parts;
}

// Colours behind the coordinates, as MeshLab, Blender and others read them.
void write_obj(Output& out, const Mesh& mesh, const FieldView& field) {
  const ColourScale scale(field.values);
  out.write("# " + counted(mesh.vertex_count(), "vertex", "vertices") + ", " +
            counted(mesh.face_count(), "face", "faces") + "\n");
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3& p = mesh.positions()[v];
    out.write('v');
    for (const double x : {p.x, p.y, p.z}) {
      out.write(' ');
      out.number(x);
    }
    if (!field.values.empty()) {
      for (const std::uint8_t c : scale(field.values[v])) {
        out.write(' ');
        out.number(static_cast<float>(c) / 255.0f);
      }
    }
    out.write('\n');
  }
  for (const Face& f : mesh.faces()) {
    out.write('f');
    for (const Index v : f) {
      out.write(' ');
      out.number(std::int64_t{v} + 1);
    }
    out.write('\n');
  }
}

}  // namespace brushfire::detail
