// A name that cannot be written is the user's slip and not a bad input file, which is what the library's code says.
#include "output.h"

#include <brushfire/core/error.h>
#include <brushfire/io/write_field.h>

namespace brushfire::tool {
namespace {

template <class Check>
void as_usage_error(const std::string& path, Check&& check) {
  if (path.empty() || path == "-") return;
  try {
    check();
  } catch (const Error& e) {
    throw Error(ErrorCode::InvalidArgument, e.what());
  }
}

// Words of the formats, broken into lines that fit beside the options' names.
template <class Word>
std::string wrapped(const std::vector<FileFormat>& formats, const char* separator, Word&& word) {
  constexpr std::size_t kLine = 64;
  std::string text;
  std::size_t line = 0;
  for (const FileFormat& f : formats) {
    const std::string next = word(f);
    if (!text.empty()) text += separator;
    line += next.size() + 2;
    if (line > kLine) {
      text.back() = '\n';
      line = next.size();
    }
    text += next;
  }
  return text;
}

}  // namespace

void check_output(const std::string& path) {
  as_usage_error(path, [&] { check_field_format(path); });
}

void check_output(const std::string& path, Columns::Kind kind) {
  as_usage_error(path, [&] { check_columns_format(path, kind); });
}

std::string names_of(const std::vector<FileFormat>& formats) {
  return wrapped(formats, ", ", [](const FileFormat& f) { return f.name; });
}

std::string extensions_of(const std::vector<FileFormat>& formats) {
  return wrapped(formats, " ", [](const FileFormat& f) { return "." + f.extensions.front(); });
}

void add_drawing(Verb& verb, DrawingArguments& drawing) {
  verb.option("--view", drawing.view, "NAME", "For .svg: front, back, left, right, top or bottom");
  verb.flag("--outline", drawing.outline, "For .svg and .dxf: the outline of the mesh too");
}

void add_lines_output(Verb& verb, std::string& output, DrawingArguments& drawing) {
  verb.option("-o,--output", output, "FILE", ("Write the curves: " + extensions_of(lines_written())).c_str());
  add_drawing(verb, drawing);
}

LinesOptions lines_options(const std::string& output, const DrawingArguments& drawing, const SharedArguments& shared) {
  const LinesOptions options{millimetres(shared), drawing.view, drawing.outline};
  as_usage_error(output, [&] { check_lines_format(output, "", options); });
  return options;
}

}  // namespace brushfire::tool
