// Which format curves have, and those that are text: CSV, JSON, OBJ.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/csv.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/json.h>
#include <brushfire/io/detail/text.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/read_lines.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire {

namespace detail {

namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

Index index_of(double number, const char* what, const Input& input, std::size_t line) {
  if (!(number >= 0) || number >= static_cast<double>(kNoIndex) || number != std::floor(number)) {
    input.fail_line(line, std::string(what) + " is no whole number from 0 up");
  }
  return static_cast<Index>(number);
}

// A closed curve as its files repeat the first point: dropped, and said otherwise.
void close_if_repeated(LoadedLine& line, bool first_is_last) {
  if (!first_is_last || line.positions.size() < 3) return;
  line.positions.pop_back();
  line.closed = true;
}

}  // namespace

LoadedLines read_csv_lines(const Input& input) {
  CsvRows rows(input);
  LoadedLines loaded;
  std::vector<std::string_view> cells;
  if (!rows.next(cells)) return loaded;
  const auto column = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(cells.begin(), cells.end(), name) - cells.begin());
  };
  const std::size_t width = cells.size(), line_column = column("line"), closed_column = column("closed");
  const std::size_t x = column("x"), y = column("y"), z = column("z"), face = column("face");
  const std::size_t w[]{column("w0"), column("w1"), column("w2")};
  const bool has_positions = std::max({x, y, z}) < width, has_points = std::max({face, w[0], w[1], w[2]}) < width;
  if (!has_positions && !has_points) rows.fail("the header names neither x, y, z nor face, w0, w1, w2");
  // The value stands behind the line's number, under a name of its own.
  const std::size_t value = line_column == 0 && width > 1 && cells[1] != "point" && cells[1] != "x" ? 1 : width;
  if (value < width) loaded.value_name = cells[value];
  double current = kNoValue;
  while (rows.next(cells)) {
    if (cells.size() != width) {
      rows.fail(counted(cells.size(), "cell", "cells") + ", but the first line has " + std::to_string(width));
    }
    const double number = line_column < width ? rows.number(cells[line_column]) : 0;
    if (loaded.lines.empty() || number != current) {
      loaded.lines.emplace_back();
      current = number;
      loaded.lines.back().value = value < width ? rows.number(cells[value]) : kNoValue;
      loaded.lines.back().closed = closed_column < width && rows.number(cells[closed_column]) != 0;
    }
    LoadedLine& line = loaded.lines.back();
    if (has_positions) {
      line.positions.push_back({rows.coordinate(cells[x]), rows.coordinate(cells[y]), rows.coordinate(cells[z])});
    }
    if (has_points) {
      const Index f = index_of(rows.number(cells[face]), "the face", input, rows.line());
      line.points.push_back(
          {f, {rows.coordinate(cells[w[0]]), rows.coordinate(cells[w[1]]), rows.coordinate(cells[w[2]])}});
    }
  }
  return loaded;
}

namespace {

LoadedLine json_line(const Input& input, const Json& object, std::string& value_name) {
  LoadedLine line;
  line.value = kNoValue;
  line.closed = object.value("closed", false);
  for (const auto& [key, value] : object.items()) {
    const bool is_value = key != "schema" && (value.is_number() || value.is_null());
    if (!is_value || !std::isnan(line.value)) continue;
    value_name = key;
    if (value.is_number()) line.value = value.get<double>();
  }
  for (const Json& point : object.at("points")) {
    if (point.contains("position")) {
      const auto p = point.at("position").get<std::array<double, 3>>();
      line.positions.push_back({p[0], p[1], p[2]});
    }
    if (point.contains("face")) {
      const Index f = index_of(point.at("face").get<double>(), "a face", input, 1);
      line.points.push_back({f, point.at("weights").get<std::array<double, 3>>()});
    }
  }
  const std::size_t points = object.at("points").size();
  if ((!line.positions.empty() && line.positions.size() != points) ||
      (!line.points.empty() && line.points.size() != points)) {
    input.fail("some points of a line have no position or face, which others have");
  }
  return line;
}

}  // namespace

LoadedLines read_json_lines(const Input& input) {
  const Json json = parse_json(input, input.bytes(), 0);
  LoadedLines loaded;
  try {
    if (!json.is_object()) input.fail("has no object at the top");
    if (!json.contains("lines")) {
      loaded.lines.push_back(json_line(input, json, loaded.value_name));
    } else {
      for (const Json& line : json.at("lines")) loaded.lines.push_back(json_line(input, line, loaded.value_name));
    }
  } catch (const Json::exception& e) {
    input.fail(std::string("not as curves are written: ") + printable(e.what()));
  }
  return loaded;
}

namespace {}  // namespace

LoadedLines read_obj_lines(const Input& input) {
  TextCursor text(input, input.bytes(), 1, '#');
  LoadedLines loaded;
  std::vector<Vec3> positions;
  std::vector<Index> numbers;
  do {
    if (!text.to_word_on_line()) continue;
    const std::string_view keyword = text.word_here();
    if (keyword == "v") positions.push_back(text.point());
    if (keyword != "l" && keyword != "p") continue;
    numbers.clear();
    while (text.to_word_on_line()) {
      const std::int64_t n = text.digits_here("a vertex number");
      const auto count = static_cast<std::int64_t>(positions.size());
      if (n == 0 || n > count || n < -count) text.fail("there is no vertex " + std::to_string(n) + " so far");
      numbers.push_back(static_cast<Index>(n > 0 ? n - 1 : count + n));
      text.word_here();  // the texture's number
    }
    if (numbers.empty()) continue;
    // Several points may stand in one p record.
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (k == 0 || keyword == "p") loaded.lines.emplace_back().value = kNoValue;
      loaded.lines.back().positions.push_back(positions[numbers[k]]);
    }
    if (keyword == "l") close_if_repeated(loaded.lines.back(), numbers.front() == numbers.back());
  } while (text.next_line());
  return loaded;
}

namespace {

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

struct LinesFormat {
  const char* name;
  const char* extension;
  LoadedLines (*read)(const Input& input);
};

// A new reader is one line here.
constexpr LinesFormat kLinesFormats[]{{"CSV", "csv", read_csv_lines},
                                      {"JSON", "json", read_json_lines},
                                      {"OBJ", "obj", read_obj_lines},
                                      {"PLY", "ply", read_ply_lines},
                                      {"VTP", "vtp", read_vtp_lines}};

const char* extension_by_content(std::string_view text) {
  if (starts_with(text, "ply\n") || starts_with(text, "ply\r")) return "ply";
  if (starts_with(text, "<") && text.substr(0, 1024).find("<VTKFile") != std::string_view::npos) return "vtp";
  if (starts_with(text, "{")) return "json";
  if (starts_with(text, "line,")) return "csv";
  return starts_with(text, "v ") ? "obj" : "";
}

LoadedLines read(Input input) {
  input.drop_byte_order_mark();
  if (input.size() == 0) input.fail("the file is empty");
  std::string extension = extension_by_content(text_start(input.bytes()));
  if (extension.empty()) extension = input.extension();
  std::string known;
  for (const LinesFormat& f : kLinesFormats) {
    if (f.extension == extension) {
      LoadedLines loaded = f.read(input);
      loaded.format = f.name;
      return loaded;
    }
    known += std::string(known.empty() ? "" : ", ") + f.name;
  }
  throw Error(
      ErrorCode::UnknownFormat,
      printable(input.name()) + ": neither name nor content tell the format of the curves (known: " + known + ")");
}

}  // namespace

}  // namespace detail

std::vector<FileFormat> lines_read() {
  std::vector<FileFormat> formats;
  for (const detail::LinesFormat& f : detail::kLinesFormats) formats.push_back({f.name, {f.extension}});
  return formats;
}

LoadedLines read_lines(const std::string& path) { return detail::read(detail::Input::from_file(path)); }

LoadedLines read_lines(std::span<const std::byte> content, const std::string& name) {
  return detail::read(
      detail::Input::from_memory({reinterpret_cast<const char*>(content.data()), content.size()}, name));
}

}  // namespace brushfire
