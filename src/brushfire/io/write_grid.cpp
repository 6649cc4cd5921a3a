// ESRI ASCII grids, arrays, and GeoTIFF by GDAL.
#include <brushfire/io/write_grid.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/io/detail/gdal_grid.h>
#include <brushfire/io/detail/output.h>
#include <brushfire/io/npy.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brushfire {
namespace {

// A number that is none of the values.
double no_data_for(const Grid& grid) {
  double none = -9999;
  while (std::find(grid.heights.begin(), grid.heights.end(), none) != grid.heights.end()) none = 10 * none - 9;
  return none;
}

void write_ascii(const std::string& path, const Grid& grid) {
  const GridPlacement& p = grid.placement;
  if (!(p.right[0] > 0 && p.right[1] == 0 && p.down[0] == 0 && p.down[1] < 0)) {
    throw Error(
        ErrorCode::InvalidArgument,
        path + ": an ESRI ASCII grid has rows that run east and down south, and this one does not: .tif says so");
  }
  const double dx = p.right[0], dy = -p.down[1], none = no_data_for(grid);
  detail::Output out(path);
  const auto line = [&](const char* name, double value) {
    out.write(name);
    out.number(value);
    out.write('\n');
  };
  line("ncols ", grid.columns);
  line("nrows ", grid.rows);
  line("xllcenter ", p.origin[0]);
  line("yllcenter ", p.origin[1] - dy * (grid.rows - 1));
  if (dx == dy) {
    line("cellsize ", dx);
  } else {
    line("dx ", dx);
    line("dy ", dy);
  }
  line("NODATA_value ", none);
  Poll poll;
  for (std::size_t i = 0; i < grid.heights.size(); ++i) {
    poll();
    out.number(std::isfinite(grid.heights[i]) ? grid.heights[i] : none);
    out.write((i + 1) % grid.columns == 0 ? '\n' : ' ');
  }
  out.commit();
}

}  // namespace

void write_grid(const std::string& path, const Grid& grid) {
  if (grid.heights.size() != std::size_t{grid.columns} * grid.rows) {
    throw Error(ErrorCode::InvalidArgument, path + ": " + std::to_string(grid.heights.size()) + " values for " +
                                                std::to_string(grid.columns) + " x " + std::to_string(grid.rows) +
                                                " cells: one each is needed");
  }
  if (path.ends_with(".npy")) {
    const std::array<std::size_t, 2> shape{grid.rows, grid.columns};
    write_npy(path, grid.heights, shape);
  } else if (path.ends_with(".asc")) {
    write_ascii(path, grid);
  } else if (path.ends_with(".tif") || path.ends_with(".tiff")) {
    detail::write_geotiff(path, grid);
  } else {
    throw Error(ErrorCode::UnknownFormat, path + ": grids are written as .asc, .npy and .tif");
  }
}

}  // namespace brushfire
