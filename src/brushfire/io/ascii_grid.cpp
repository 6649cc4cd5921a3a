// ESRI ASCII grids.
#include <brushfire/io/detail/ascii_grid.h>

#include <brushfire/core/cancel.h>
#include <brushfire/io/detail/text.h>

#include <cctype>
#include <cmath>
#include <map>

namespace brushfire::detail {

namespace {

std::string lower(std::string_view word) {
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

class AsciiGridReader {
 public:
  explicit AsciiGridReader(const Input& input) : text_(input, input.bytes()) {}

  Grid read() {
    read_header();
    Grid grid;
    grid.columns = size("ncols");
    grid.rows = size("nrows");
    const double cell = value("cellsize", 1), dx = value("dx", cell), dy = value("dy", cell);
    if (!(dx > 0 && dy > 0 && std::isfinite(dx) && std::isfinite(dy))) text_.fail("the cells have no size");
    // Of the corner of the lowest row's first cell, or of its middle.
    const double x = value("xllcenter", value("xllcorner", 0) + 0.5 * dx);
    const double y = value("yllcenter", value("yllcorner", 0) + 0.5 * dy);
    const double north = y + dy * (grid.rows - 1);
    if (!std::isfinite(x) || !std::isfinite(north)) text_.fail("the corner of the grid is not finite");
    grid.placement = {{x, north}, {dx, 0}, {0, -dy}};
    read_heights(grid);
    return grid;
  }

 private:
  // A word that begins like a name is one, but for the two that are numbers.
  void read_header() {
    while (text_.to_word()) {
      TextCursor ahead = text_;
      const std::string name = lower(ahead.word_here());
      if (std::isalpha(static_cast<unsigned char>(name[0])) == 0 || name == "nan" || name == "inf") return;
      text_ = ahead;
      header_[name] = text_.number("a number");
    }
  }

  double value(const char* name, double otherwise) const {
    const auto found = header_.find(name);
    return found == header_.end() ? otherwise : found->second;
  }

  Index size(const char* name) const {
    constexpr double kMost = 1e9;
    const double n = value(name, 0);
    if (!header_.contains(name)) text_.fail(std::string("no ") + name + " in the header of the grid");
    if (!(n >= 2 && n <= kMost && n == std::floor(n))) {
      text_.fail(std::string(name) + " is not a whole number from 2 on");
    }
    return static_cast<Index>(n);
  }

  void read_heights(Grid& grid) {
    const std::uint64_t count = std::uint64_t{grid.columns} * grid.rows;
    text_.check_count(count, "the number of heights", 2);
    const double no_data = value("nodata_value", -9999);
    grid.heights.reserve(static_cast<std::size_t>(count));
    Poll poll;
    for (std::uint64_t i = 0; i < count; ++i) {
      poll();
      const double height = text_.number("a height");
      grid.heights.push_back(height == no_data || !std::isfinite(height) ? kInfinity : height);
    }
    if (text_.to_word()) {
      text_.fail(quote(text_.word_here()) + " after the last of " + std::to_string(grid.rows) + " rows of " +
                 std::to_string(grid.columns) + " heights");
    }
  }

  TextCursor text_;
  std::map<std::string, double> header_;
};

}  // namespace

Grid read_ascii_grid(const Input& input) { return AsciiGridReader(input).read(); }

}  // namespace brushfire::detail
