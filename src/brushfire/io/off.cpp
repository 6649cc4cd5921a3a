// Object File Format: OFF and its relatives (C, N, ST: colours, normals, texture coordinates), text and binary.
#include <brushfire/io/detail/binary.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>

#include <cmath>
#include <optional>

namespace brushfire::detail {

namespace {

// "OFF" with optional prefixes that say what else stands with a vertex. 4OFF and nOFF are other spaces.
struct Header {
  bool has_normals = false, has_colours = false, has_texture = false;
  std::size_t size = 0;  // characters; the counts may be glued to it
};

std::optional<Header> header_of(std::string_view word) {
  Header header;
  const auto take = [&](std::string_view prefix) {
    const bool is_there = word.substr(header.size, prefix.size()) == prefix;
    if (is_there) header.size += prefix.size();
    return is_there;
  };
  header.has_texture = take("ST");
  header.has_colours = take("C");
  header.has_normals = take("N");
  return take("OFF") ? std::optional(header) : std::nullopt;
}

// Whether the vertices lie in the plane, which the first one's line tells.
bool has_two_coordinates(TextCursor text) {
  text.coordinate();
  if (!text.to_word_on_line()) return false;
  text.coordinate_here();
  return !text.to_word_on_line();
}

Vec3 planar_point(TextCursor& text) {
  const double x = text.coordinate();
  if (!text.to_word_on_line()) text.fail_word("a coordinate");
  const double y = text.coordinate_here();
  if (text.to_word_on_line()) text.fail("three coordinates, but the vertices before have two");
  return {x, y, 0};
}

MeshParts read_text(TextCursor& text) {
  constexpr std::size_t kShortestVertex = 4, kShortestFace = 2;  // "0 0\n", "0\n"
  MeshParts parts;
  const std::size_t vertices = text.count("the number of vertices", kShortestVertex);
  const std::size_t faces = text.count("the number of faces", kShortestFace);
  // The number of edges may be missing, and is of no use.
  if (text.to_word_on_line()) text.integer("the number of edges");

  const bool is_planar = vertices != 0 && has_two_coordinates(text);
  if (is_planar) parts.remarks.emplace_back(kPlanarRemark);
  parts.positions.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    parts.positions.push_back(is_planar ? planar_point(text) : text.point());
    text.skip_to_end_of_line();
  }
  parts.faces.reserve(faces);
  std::vector<Index> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t n = text.count("the number of corners", 2);
    const std::size_t line = text.line();
    corners.resize(n);
    for (Index& v : corners) v = text.index(0);
    parts.faces.add(corners, line);
    text.skip_to_end_of_line();  // a colour
  }
  return parts;
}

// Geomview's binary files: big-endian 32-bit integers and floats.
class BinaryOff {
 public:
  BinaryOff(const Input& input, std::size_t begin, const Header& header)
      : input_(&input), at_(begin), header_(header) {}

  MeshParts read() {
    parts_.places_are_lines = false;
    const std::size_t vertices = count("vertices", 12), faces = count("faces", 8);
    number();  // edges
    read_vertices(vertices);
    std::vector<Index> corners;
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t place = at_;
      corners.resize(count("corners", 4));
      for (Index& v : corners) {
        const std::int32_t n = number();
        if (n < 0) input_->fail_byte(at_ - 4, "face " + std::to_string(f) + " names vertex " + std::to_string(n));
        v = static_cast<Index>(n);
      }
      parts_.faces.add(corners, place);
      take(4 * count("components of a colour", 4));
    }
    return std::move(parts_);
  }

 private:
  void read_vertices(std::size_t vertices) {
    const std::size_t more =
        (header_.has_normals ? 3 : 0) + (header_.has_colours ? 4 : 0) + (header_.has_texture ? 2 : 0);
    for (std::size_t v = 0; v < vertices; ++v) {
      const std::size_t place = at_;
      const char* p = take(4 * (3 + more));
      const auto c = [&](std::size_t k) { return static_cast<double>(load<float>(p + 4 * k, std::endian::big)); };
      const Vec3 position{c(0), c(1), c(2)};
      if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
        input_->fail_byte(place, "vertex " + std::to_string(v) + " has a coordinate that is not finite");
      }
      parts_.positions.push_back(position);
    }
  }

  const char* take(std::size_t size) {
    if (size > input_->size() - at_) input_->fail_byte(input_->size(), "the file ends early");
    at_ += size;
    return input_->bytes().data() + at_ - size;
  }
  std::int32_t number() { return load<std::int32_t>(take(4), std::endian::big); }
  std::size_t count(const char* what, std::size_t bytes_each) {
    const std::int32_t n = number();
    if (n < 0 || static_cast<std::size_t>(n) > (input_->size() - at_) / bytes_each) {
      input_->fail_byte(at_ - 4, std::string("the number of ") + what + " is " + std::to_string(n) + ", but only " +
                                     std::to_string(input_->size() - at_) + " bytes follow");
    }
    return static_cast<std::size_t>(n);
  }

  const Input* input_;
  std::size_t at_;
  Header header_;
  MeshParts parts_;
};

}  // namespace

MeshParts read_off(const Input& input) {
  TextCursor text(input, input.bytes(), 1, '#');
  if (!text.to_word()) text.fail("the file is empty");
  TextCursor ahead = text;
  const std::string_view word = ahead.word_here();
  const std::optional<Header> header = header_of(word);
  if (!header) {
    if (word.find_first_not_of("0123456789") != std::string_view::npos) {
      text.fail(quote(word) + " where OFF is expected");
    }
    return read_text(text);
  }
  text.take(header->size, 1);
  ahead = text;
  if (!ahead.to_word_on_line() || ahead.word_here() != "BINARY") return read_text(text);
  if (!ahead.next_line()) ahead.fail_end("a number");
  return BinaryOff(input, input.size() - ahead.left(), *header).read();
}

}  // namespace brushfire::detail
