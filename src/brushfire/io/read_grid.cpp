// ESRI ASCII grids, and arrays.
#include <brushfire/io/read_grid.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/gdal_grid.h>
#include <brushfire/io/npy.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

namespace brushfire {
namespace {

// The words of a text, one after the other.
class Words {
 public:
  Words(const std::string& text, const std::string& path) : text_(text), path_(path) {}

  std::string_view next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
      line_ += text_[at_++] == '\n';
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) == 0) ++at_;
    return std::string_view(text_).substr(begin, at_ - begin);
  }
  std::string_view peek() {
    const auto [at, line] = std::pair(at_, line_);
    const std::string_view word = next();
    at_ = at;
    line_ = line;
    return word;
  }
  double number() {
    const std::string_view word = next();
    double value = 0;
    const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty()) fail("the file ends before its last height");
    if (error != std::errc() || end != word.data() + word.size()) fail("'" + std::string(word) + "' is no number");
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::FileMalformed, path_ + ":" + std::to_string(line_) + ": " + what);
  }

 private:
  const std::string& text_;
  const std::string& path_;
  std::size_t at_ = 0, line_ = 1;
};

std::string lower(std::string_view word) {
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

Index size_in(const std::map<std::string, double>& header, const char* name, const Words& words) {
  constexpr double kMost = 1e9;
  const auto found = header.find(name);
  if (found == header.end()) words.fail(std::string("no ") + name + " in the header of the grid");
  if (!(found->second >= 2 && found->second <= kMost && found->second == std::floor(found->second))) {
    words.fail(std::string(name) + " is not a whole number from 2 on");
  }
  return static_cast<Index>(found->second);
}

Grid read_ascii(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(ErrorCode::FileNotReadable, path + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  Words words(text, path);
  std::map<std::string, double> header;
  while (!words.peek().empty() && std::isalpha(static_cast<unsigned char>(words.peek()[0])) != 0 &&
         lower(words.peek()) != "nan") {
    const std::string name = lower(words.next());
    header[name] = words.number();
  }
  Grid grid;
  grid.columns = size_in(header, "ncols", words);
  grid.rows = size_in(header, "nrows", words);
  const auto value = [&](const char* name, double otherwise) {
    const auto found = header.find(name);
    return found == header.end() ? otherwise : found->second;
  };
  const double size = value("cellsize", 1), dx = value("dx", size), dy = value("dy", size);
  if (!(dx > 0 && dy > 0)) words.fail("the cells have no size");
  // Of the corner of the lowest row's first cell, or of its middle.
  const double x = header.contains("xllcenter") ? header["xllcenter"] : value("xllcorner", 0) + 0.5 * dx;
  const double y = header.contains("yllcenter") ? header["yllcenter"] : value("yllcorner", 0) + 0.5 * dy;
  grid.placement = {{x, y + dy * (grid.rows - 1)}, {dx, 0}, {0, -dy}};
  const double no_data = value("nodata_value", -9999);
  const std::size_t count = std::size_t{grid.columns} * grid.rows;
  if (count > text.size()) words.fail("the file is too short for its header");
  grid.heights.reserve(count);
  Poll poll;
  for (std::size_t i = 0; i < count; ++i) {
    poll();
    const double height = words.number();
    grid.heights.push_back(height == no_data || !std::isfinite(height) ? kInfinity : height);
  }
  return grid;
}

Grid read_array(const std::string& path) {
  NpyArray array = read_npy(path);
  if (array.shape.size() != 2 || array.shape[0] < 2 || array.shape[1] < 2) {
    throw Error(ErrorCode::FileMalformed, path + ": heights are an array of rows x columns, two of each at least");
  }
  Grid grid;
  grid.rows = static_cast<Index>(array.shape[0]);
  grid.columns = static_cast<Index>(array.shape[1]);
  grid.heights = std::move(array.values);
  for (double& h : grid.heights) {
    if (!std::isfinite(h)) h = kInfinity;
  }
  return grid;
}

}  // namespace

Grid read_grid(const std::string& path) {
  if (path.ends_with(".npy")) return read_array(path);
  if (path.ends_with(".asc") || path.ends_with(".txt") || path.ends_with(".grd")) return read_ascii(path);
  return detail::read_gdal(path);
}

}  // namespace brushfire
