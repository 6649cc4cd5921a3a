// MEDIT .mesh (ascii): vertices, triangles and quadrangles; everything else is passed over.
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>

#include <array>

namespace brushfire::detail {

namespace {

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

class MeditReader {
 public:
  explicit MeditReader(const Input& input) : text_(input, input.bytes(), 1, '#') {}

  MeshParts read() {
    parts_.counts_from = 1;
    if (text_.word() != "MeshVersionFormatted") text_.fail("the file does not start with MeshVersionFormatted");
    text_.integer("a version");
    while (text_.to_word()) {
      TextCursor here = text_;
      const std::string_view keyword = text_.word_here();
      if (keyword == "End") break;
      if (keyword == "Dimension") {
        dimension_ = text_.integer("2 or 3");
        if (dimension_ != 2 && dimension_ != 3)
          text_.fail("dimension " + std::to_string(dimension_) + " is not read, only 2 and 3");
      } else if (keyword == "Vertices") {
        read_vertices();
      } else if (keyword == "Triangles" || keyword == "Quadrilaterals") {
        read_faces(keyword == "Triangles" ? 3 : 4);
      } else if (is_letter(keyword[0])) {
        skip_to_keyword();
      } else {
        here.fail_word("a keyword");
      }
    }
    if (!has_vertices_) text_.fail("the file has no Vertices");
    return std::move(parts_);
  }

 private:
  void read_vertices() {
    const std::size_t n = text_.count("the number of vertices", 4);
    parts_.positions.reserve(parts_.positions.size() + n);
    for (std::size_t v = 0; v < n; ++v) {
      Vec3 p;
      p.x = text_.coordinate();
      p.y = text_.coordinate();
      if (dimension_ == 3) p.z = text_.coordinate();
      parts_.positions.push_back(p);
      text_.number("a reference");
    }
    has_vertices_ = true;
  }

  void read_faces(std::size_t corners) {
    const std::size_t n = text_.count("the number of faces", 2 * corners);
    std::array<Index, 4> v{};
    for (std::size_t f = 0; f < n; ++f) {
      for (std::size_t k = 0; k < corners; ++k) v[k] = text_.index(1);
      parts_.faces.add(std::span<const Index>(v).first(corners), text_.line());
      text_.number("a reference");
    }
  }

  void skip_to_keyword() {
    while (text_.to_word() && !is_letter(text_.peek())) text_.word_here();
  }

  TextCursor text_;
  MeshParts parts_;
  std::int64_t dimension_ = 3;
  bool has_vertices_ = false;
};

}  // namespace

MeshParts read_medit(const Input& input) { return MeditReader(input).read(); }

}  // namespace brushfire::detail
