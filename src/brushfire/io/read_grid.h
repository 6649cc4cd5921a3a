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
  std::string reference;  // of the map's coordinates, as WKT; empty where the file does not say

  Terrain terrain() const { return Terrain(heights, columns, rows, placement); }
};

// .asc, and - for standard input: an ESRI ASCII grid, whose header places it (the northernmost row comes first). .npy:
// an array of rows x columns, placed at the origin in steps of 1, rows running down; NaN is no height. By extension.
// Other files are GDAL's, in builds with it (BRUSHFIRE_WITH_GDAL): the first band. Throws Error(FileNotReadable),
// Error(FileMalformed), Error(TooLarge), Error(InvalidArgument) for a map in degrees, Error(UnknownFormat) for other
// files where there is no GDAL: `gdal_translate -of AAIGrid` makes one of these of them.
Grid read_grid(const std::string& path);

}  // namespace brushfire
