// Object File Format: OFF and its relatives (C, N, ST: colours, normals, texture coordinates), as text.
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>

namespace brushfire::detail {

namespace {

// "OFF" with optional prefixes that say what else stands in a vertex line. 4OFF and nOFF are other spaces.
bool is_header(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

}  // namespace

MeshParts read_off(const Input& input) {
  TextCursor text(input, input.bytes(), 1, '#');
  if (!text.to_word()) text.fail("the file is empty");
  TextCursor header = text;
  const std::string_view word = header.word_here();
  if (is_header(word)) {
    text = header;
  } else if (word.find_first_not_of("0123456789") != std::string_view::npos) {
    text.fail(quote(word) + " where OFF is expected");
  }
  if (text.to_word_on_line() && text.peek() == 'B') text.fail("binary OFF is not read");

  constexpr std::size_t kShortestVertex = 6, kShortestFace = 2;  // "0 0 0\n", "0\n"
  MeshParts parts;
  const std::size_t vertices = text.count("the number of vertices", kShortestVertex);
  const std::size_t faces = text.count("the number of faces", kShortestFace);
  // The number of edges may be missing, and is of no use.
  if (text.to_word_on_line()) text.integer("the number of edges");

  parts.positions.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    parts.positions.push_back(text.point());
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

}  // namespace brushfire::detail
