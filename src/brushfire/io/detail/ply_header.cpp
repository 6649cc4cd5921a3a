// The header of a PLY file.
#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/ply.h>
#include <brushfire/io/detail/text.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace brushfire::detail {

namespace ply {

namespace {

std::optional<Type> type_of(std::string_view name) {
  struct Name {
    std::string_view name;
    Type type;
  };
  static constexpr Name kNames[]{{"char", Type::Int8},       {"int8", Type::Int8},      {"uchar", Type::UInt8},
                                 {"uint8", Type::UInt8},     {"short", Type::Int16},    {"int16", Type::Int16},
                                 {"ushort", Type::UInt16},   {"uint16", Type::UInt16},  {"int", Type::Int32},
                                 {"int32", Type::Int32},     {"uint", Type::UInt32},    {"uint32", Type::UInt32},
                                 {"int64", Type::Int64},     {"uint64", Type::UInt64},  {"float", Type::Float32},
                                 {"float32", Type::Float32}, {"double", Type::Float64}, {"float64", Type::Float64}};
  for (const Name& n : kNames) {
    if (n.name == name) return n.type;
  }
  return std::nullopt;
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

Type read_type(TextCursor& text) {
  if (!text.to_word_on_line()) text.fail_word("a type");
  TextCursor here = text;
  const std::optional<Type> type = type_of(text.word_here());
  if (!type) here.fail_word("a type (char, uchar, short, ushort, int, uint, float, double)");
  return *type;
}

std::string read_name(TextCursor& text, const char* what) {
  if (!text.to_word_on_line()) text.fail_word(what);
  return std::string(text.word_here());
}

Property read_property(TextCursor& text) {
  Property p;
  TextCursor ahead = text;
  if (ahead.to_word_on_line() && ahead.word_here() == "list") {
    text = ahead;
    p.is_list = true;
    p.count_type = read_type(text);
    if (!is_integer(p.count_type)) text.fail("the length of a list cannot be a floating-point number");
  }
  p.type = read_type(text);
  p.name = read_name(text, "a property's name");
  return p;
}

Encoding read_encoding(TextCursor& text) {
  TextCursor here = text;
  const std::string name = read_name(text, "ascii, binary_little_endian or binary_big_endian");
  if (name == "ascii") return Encoding::Ascii;
  if (name == "binary_little_endian") return Encoding::Little;
  if (name == "binary_big_endian") return Encoding::Big;
  here.to_word_on_line();
  here.fail_word("ascii, binary_little_endian or binary_big_endian");
}

// How long the line end behind the header is, of which `left` bytes are left. Where lines end in CR alone, a line feed
// behind the last one is data.
std::size_t line_end_size(std::string_view bytes, std::size_t left) {
  const std::size_t first = bytes.find_first_of("\r\n");
  const bool ends_in_cr_lf = first != std::string_view::npos && bytes.substr(first, 2) == "\r\n";
  return std::min<std::size_t>(left, ends_in_cr_lf ? 2 : 1);
}

}  // namespace

const Property* Element::find(std::string_view property) const {
  for (const Property& p : properties) {
    if (p.name == property) return &p;
  }
  // Some programs write X, Y, Z and the like.
  for (const Property& p : properties) {
    if (lower(p.name) == property) return &p;
  }
  return nullptr;
}

Header read_header(const Input& input) {
  TextCursor text(input, input.bytes());
  if (text.word() != "ply") input.fail_line(1, "the file does not start with 'ply'");
  Header header;
  bool has_format = false;
  while (true) {
    if (!text.next_line()) text.fail("the file ends within the header: no end_header");
    if (!text.to_word_on_line()) continue;
    TextCursor here = text;
    const std::string_view keyword = text.word_here();
    if (keyword == "format") {
      header.encoding = read_encoding(text);
      has_format = true;
    } else if (keyword == "element") {
      Element e;
      e.line = text.line();
      e.name = read_name(text, "an element's name");
      const std::int64_t count = text.integer("the number of rows");
      if (count < 0) text.fail("element " + quote(e.name) + " has " + std::to_string(count) + " rows");
      e.count = static_cast<std::uint64_t>(count);
      header.elements.push_back(std::move(e));
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before the first element");
      header.elements.back().properties.push_back(read_property(text));
    } else if (keyword == "end_header") {
      break;
    } else if (keyword != "comment" && keyword != "obj_info") {
      here.fail_word("a keyword of a PLY header");
    }
  }
  if (!has_format) text.fail("the header has no format line");
  text.skip_to_end_of_line();
  header.size =
      static_cast<std::size_t>(text.position() - input.bytes().data()) + line_end_size(input.bytes(), text.left());
  header.lines = text.line();
  return header;
}

}  // namespace ply

}  // namespace brushfire::detail
