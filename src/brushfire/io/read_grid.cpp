// Grids of heights: which reader a name asks for, and arrays.
#include <brushfire/io/read_grid.h>

#include <brushfire/core/error.h>
#include <brushfire/io/detail/ascii_grid.h>
#include <brushfire/io/detail/gdal_grid.h>
#include <brushfire/io/detail/names.h>
#include <brushfire/io/npy.h>

#include <cmath>

namespace brushfire {
namespace {

Grid read_ascii(const std::string& path) {
  detail::Input input = detail::Input::from_file(path);
  input.drop_byte_order_mark();
  return detail::read_ascii_grid(input);
}

Grid read_array(const std::string& path) {
  NpyArray array = read_npy(path);
  if (array.shape.size() != 2 || array.shape[0] < 2 || array.shape[1] < 2) {
    throw Error(ErrorCode::FileMalformed,
                detail::printable(path) + ": heights are an array of rows x columns, two of each at least");
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

// The extension, without that of a compressed file.
std::string extension_of(const std::string& path) {
  const std::string last = detail::extension_or("", path);
  return last == "gz" ? detail::extension_or("", path.substr(0, path.size() - 3)) : last;
}

}  // namespace

Grid read_grid(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == "npy") return read_array(path);
  if (path == "-" || extension == "asc" || extension == "txt" || extension == "grd") return read_ascii(path);
  return detail::read_gdal(path);
}

}  // namespace brushfire
