// CsvRows: the lines of a CSV file, cut into cells.
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/text.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

// One line at a time. Cells are separated by comma, semicolon or tab, as the first line tells.
class CsvRows {
 public:
  explicit CsvRows(const Input& input) : input_(&input), text_(input, input.bytes()) {
    const std::string_view first = input.bytes().substr(0, input.bytes().find_first_of("\r\n"));
    for (const char c : {',', ';', '\t'}) {
      if (first.find(c) != std::string_view::npos) {
        separator_ = c;
        break;
      }
    }
  }

  // The next line that is not empty.
  bool next(std::vector<std::string_view>& cells) {
    while (!text_.at_end()) {
      line_ = text_.line();
      const char* begin = text_.position();
      text_.skip_to_end_of_line();
      std::string_view row(begin, static_cast<std::size_t>(text_.position() - begin));
      text_.next_line();
      if (row.find_first_not_of(" \t") == std::string_view::npos || row[0] == '#') continue;
      cells.clear();
      while (true) {
        const std::size_t end = row.find(separator_);
        cells.push_back(trimmed(row.substr(0, end)));
        if (end == std::string_view::npos) return true;
        row.remove_prefix(end + 1);
      }
    }
    return false;
  }

  bool is_number(std::string_view cell, double& value) const {
    if (!cell.empty() && cell[0] == '+') cell.remove_prefix(1);
    const auto result = fast_float::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (result.ec == std::errc() && result.ptr == cell.data() + cell.size()) return true;
    return read_foreign_number(cell, value);
  }
  double number(std::string_view cell) const {
    double value = 0;
    if (!is_number(cell, value)) fail(quote(cell) + " where a number is expected");
    return value;
  }
  // The same, which must be finite.
  double coordinate(std::string_view cell) const {
    const double value = number(cell);
    if (!std::isfinite(value)) fail("coordinate " + quote(cell) + " is not finite");
    return value;
  }
  std::size_t line() const { return line_; }
  [[noreturn]] void fail(const std::string& cause) const { input_->fail_line(line_, cause); }

 private:
  static std::string_view trimmed(std::string_view cell) {
    const std::size_t begin = cell.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    cell = cell.substr(begin, cell.find_last_not_of(" \t") - begin + 1);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    return cell;
  }

  const Input* input_;
  TextCursor text_;
  char separator_ = ',';
  std::size_t line_ = 1;
};

}  // namespace brushfire::detail
