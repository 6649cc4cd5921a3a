// Gmsh .msh: the surface triangles and quadrangles of versions 2 and 4.1, ascii and binary.
#include <brushfire/core/detail/sort.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/numbers.h>
#include <brushfire/io/detail/text.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace brushfire::detail {

namespace {

// Nodes of each element type, from 1: lines, triangles, quadrangles, solids, and their curved relatives.
constexpr int kNodes[]{0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                       8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

// How many corners a surface element has; 0 for everything else. The corners stand before the nodes along edges.
std::size_t corners_of(std::int64_t type) {
  constexpr std::int64_t kTriangles[]{2, 9, 20, 21, 22, 23, 24, 25}, kQuads[]{3, 10, 16};
  if (std::find(std::begin(kTriangles), std::end(kTriangles), type) != std::end(kTriangles)) return 3;
  return std::find(std::begin(kQuads), std::end(kQuads), type) != std::end(kQuads) ? 4 : 0;
}

class GmshReader {
 public:
  explicit GmshReader(const Input& input) : input_(&input), text_(input, input.bytes()) {}

  MeshParts read() {
    bool has_nodes = false;
    read_format();
    while (text_.to_word()) {
      const std::string section(text_.word_here());
      if (section == "$Nodes") {
        if (has_nodes) text_.fail("a second section of nodes");
        version4_ ? read_nodes_4() : read_nodes_2();
        has_nodes = true;
        end_section("$EndNodes");
      } else if (section == "$Elements") {
        if (!has_nodes) text_.fail("elements before the nodes");
        sort_tags();
        version4_ ? read_elements_4() : read_elements_2();
        end_section("$EndElements");
      } else if (section.size() > 1 && section[0] == '$') {
        skip_section("$End" + section.substr(1));
      } else {
        fail(quote(section) + " where a section is expected");
      }
    }
    if (!has_nodes) fail("the file has no $Nodes");
    if (left_out_ != 0)
      parts_.remarks.push_back(counted(left_out_, "element that is no face", "elements that are no faces") +
                               " left out");
    if (curved_ != 0)
      parts_.remarks.push_back(counted(curved_, "curved face", "curved faces") + " read as flat, by the corners");
    return std::move(parts_);
  }

 private:
  void read_format() {
    if (text_.word() != "$MeshFormat") text_.fail("the file does not start with $MeshFormat");
    const double version = text_.number("a version");
    binary_ = text_.integer("0 or 1") == 1;
    const std::int64_t size = text_.integer("the size of numbers");
    version4_ = version == 4.1;
    if (!version4_ && !(version >= 2 && version < 3))
      text_.fail("version " + std::to_string(version).substr(0, 4) + " is not read, only 2 and 4.1");
    if (size != 8) text_.fail("numbers of " + std::to_string(size) + " bytes are not read, only 8");
    parts_.places_are_lines = !binary_;
    if (binary_) {
      begin_binary();
      order_ = std::endian::little;
      const char* one = raw(1, 4, "the byte order");
      if (load<std::int32_t>(one, order_) != 1) order_ = std::endian::big;
      if (load<std::int32_t>(one, order_) != 1) fail("the byte order is marked by neither 1 nor its reverse");
    }
    end_section("$EndMeshFormat");
  }

  void end_section(const std::string& word) {
    const std::string_view found = text_.word();
    if (found != word) fail(quote(found) + " where " + word + " is expected");
  }

  // What a section holds that is not needed may be binary, without a line end before its mark.
  void skip_section(const std::string& end) {
    if (binary_) {
      const std::string_view rest(text_.position(), text_.left());
      const std::size_t found = rest.find(end);
      if (found == std::string_view::npos) fail("the file ends before " + end);
      text_.take(found + end.size(), 1);
      return;
    }
    do {
      if (!text_.next_line()) fail("the file ends before " + end);
    } while (text_.rest_of_line() != end);
  }

  // Numbers, in text or binary.
  std::int64_t whole(std::size_t size, const char* what) {
    if (!binary_) return text_.integer(what);
    const char* p = raw(1, size, what);
    return size == 8 ? load<std::int64_t>(p, order_) : load<std::int32_t>(p, order_);
  }
  double real(const char* what) { return binary_ ? load<double>(raw(1, 8, what), order_) : text_.number(what); }
  Vec3 point() {
    const double x = real("a coordinate"), y = real("a coordinate"), z = real("a coordinate");
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
      fail("node " + std::to_string(parts_.positions.size()) + " has a coordinate that is not finite");
    }
    return {x, y, z};
  }
  std::size_t count(std::size_t size, std::size_t bytes_each, const char* what) {
    const std::int64_t n = whole(size, what);
    if (n < 0 || static_cast<std::uint64_t>(n) > text_.left() / (binary_ ? bytes_each : 2) + 1) {
      fail(std::string(what) + " is " + std::to_string(n) + ", but " + std::to_string(text_.left()) + " bytes follow");
    }
    return static_cast<std::size_t>(n);
  }
  const char* raw(std::size_t n, std::size_t size, const char* what) {
    const std::string_view bytes = text_.take(n, size);
    if (bytes.size() != n * size) fail(std::string("the file ends within ") + what);
    return bytes.data();
  }
  // Binary data starts behind the line.
  void begin_binary() {
    if (!text_.next_line()) fail("the file ends where numbers are expected");
  }

  void add_node(std::int64_t tag, const Vec3& p) {
    tags_.push_back({tag, static_cast<Index>(parts_.positions.size())});
    parts_.positions.push_back(p);
  }

  void read_nodes_2() {
    const std::size_t n = text_.count("the number of nodes", 2);
    if (binary_) begin_binary();
    for (std::size_t k = 0; k < n; ++k) {
      const std::int64_t tag = whole(4, "a node's number");
      add_node(tag, point());
    }
  }

  void read_nodes_4() {
    if (binary_) begin_binary();
    const std::size_t blocks = count(8, 20, "the number of blocks");
    for (int k = 0; k < 3; ++k) whole(8, "a count");
    std::vector<std::int64_t> tags;
    for (std::size_t b = 0; b < blocks; ++b) {
      for (int k = 0; k < 2; ++k) whole(4, "an entity");
      const bool parametric = whole(4, "parametric") != 0;
      const std::size_t n = count(8, 8, "the number of nodes");
      if (parametric) fail("parametric nodes are not read");
      tags.resize(n);
      for (std::int64_t& tag : tags) tag = whole(8, "a node's number");
      for (const std::int64_t tag : tags) add_node(tag, point());
    }
  }

  // Nodes have numbers of their own: in order where the file counts on, found by bisection otherwise.
  void sort_tags() {
    const auto by_tag = [](const Tag& a, const Tag& b) { return a.tag < b.tag; };
    if (!std::is_sorted(tags_.begin(), tags_.end(), by_tag)) detail::sort(tags_.begin(), tags_.end(), by_tag);
    for (std::size_t k = 1; k < tags_.size(); ++k) {
      if (tags_[k].tag == tags_[k - 1].tag) fail("two nodes have the number " + std::to_string(tags_[k].tag));
    }
  }

  Index node(std::int64_t tag) const {
    if (!tags_.empty() && tag >= tags_[0].tag) {
      const auto ahead = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(tags_[0].tag);
      const std::size_t place = as_size(ahead);
      if (place < tags_.size() && tags_[place].tag == tag) return tags_[place].index;
    }
    const auto found =
        std::lower_bound(tags_.begin(), tags_.end(), tag, [](const Tag& a, std::int64_t t) { return a.tag < t; });
    if (found == tags_.end() || found->tag != tag)
      fail("an element names node " + std::to_string(tag) + ", which does not exist");
    return found->index;
  }

  std::size_t nodes_of(std::int64_t type) const {
    if (type < 1 || type >= static_cast<std::int64_t>(std::size(kNodes)))
      fail("an element of type " + std::to_string(type) + " is not known");
    return static_cast<std::size_t>(kNodes[type]);
  }

  void read_element(std::int64_t type, std::size_t size) {
    const std::size_t nodes = nodes_of(type), corners = corners_of(type), place = this->place();
    if (corners != 0 && nodes > corners) ++curved_;
    if (corners == 0) ++left_out_;
    Index v[4];
    for (std::size_t k = 0; k < nodes; ++k) {
      const std::int64_t tag = whole(size, "a node's number");
      if (k < corners) v[k] = node(tag);
    }
    if (corners != 0) parts_.faces.add(std::span<const Index>(v, corners), place);
  }

  void read_elements_2() {
    const std::size_t n = text_.count("the number of elements", 2);
    if (!binary_) {
      for (std::size_t e = 0; e < n; ++e) {
        text_.integer("an element's number");
        const std::int64_t type = text_.integer("an element's type");
        const std::size_t tags = text_.count("the number of tags", 2);
        for (std::size_t k = 0; k < tags; ++k) text_.integer("a tag");
        read_element(type, 4);
      }
      return;
    }
    begin_binary();
    for (std::size_t done = 0; done < n;) {
      const std::int64_t type = whole(4, "an element's type");
      const std::size_t follow = count(4, 4, "the number of elements"), tags = count(4, 4, "the number of tags");
      if (follow == 0 || follow > n - done)
        fail("a block of " + std::to_string(follow) + " elements does not fit the " + std::to_string(n - done) +
             " that are left");
      for (std::size_t e = 0; e < follow; ++e) {
        raw(1 + tags, 4, "the elements");
        read_element(type, 4);
      }
      done += follow;
    }
  }

  void read_elements_4() {
    if (binary_) begin_binary();
    const std::size_t blocks = count(8, 20, "the number of blocks");
    for (int k = 0; k < 3; ++k) whole(8, "a count");
    for (std::size_t b = 0; b < blocks; ++b) {
      for (int k = 0; k < 2; ++k) whole(4, "an entity");
      const std::int64_t type = whole(4, "an element's type");
      const std::size_t n = count(8, 8, "the number of elements");
      for (std::size_t e = 0; e < n; ++e) {
        whole(8, "an element's number");
        read_element(type, 8);
      }
    }
  }

  std::size_t place() const {
    return binary_ ? static_cast<std::size_t>(text_.position() - input_->bytes().data()) : text_.line();
  }
  [[noreturn]] void fail(const std::string& cause) const {
    if (binary_) input_->fail_byte(place(), cause);
    input_->fail_line(place(), cause);
  }

  struct Tag {
    std::int64_t tag;
    Index index;
  };

  const Input* input_;
  TextCursor text_;
  MeshParts parts_;
  std::vector<Tag> tags_;
  bool binary_ = false, version4_ = false;
  std::endian order_ = std::endian::little;
  std::size_t left_out_ = 0, curved_ = 0;
};

}  // namespace

MeshParts read_gmsh(const Input& input) { return GmshReader(input).read(); }

}  // namespace brushfire::detail
