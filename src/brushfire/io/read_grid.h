// read_grid(): heights on a grid, from the files that hold them.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/terrain.h>

#include <string>
#include <vector>

namespace brushfire {

struct Grid {
  std::vector<double> heights;  // [rows * columns], the file's first row first; +inf: no height
  Index columns = 0, rows = 0;
  GridPlacement placement;

  Terrain terrain() const { return Terrain(heights, columns, rows, placement); }
};

// .asc: an ESRI ASCII grid, whose header places it (the northernmost row comes first). .npy: an array of rows x
// columns, placed at the origin in steps of 1, rows running down; NaN is no height. By extension. Throws
// Error(FileNotReadable), Error(FileMalformed), Error(UnknownFormat) for other files, which `gdal_translate -of
// AAIGrid` turns into the first of these.
Grid read_grid(const std::string& path);

}  // namespace brushfire
