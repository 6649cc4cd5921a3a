// write_grid(): values on a grid, back into files that say where it lies.
#pragma once

#include <brushfire/io/read_grid.h>

#include <string>

namespace brushfire {

// .asc: an ESRI ASCII grid; rows must run east and down south. .npy: an array of rows x columns, without its place.
// .tif: a GeoTIFF, in builds with GDAL. By extension. Values that are not finite stand for none: as no-data, in .npy as
// they are. The file appears complete or not at all. Throws Error(InvalidArgument) where there are not columns * rows
// values, or where the placement is another one than .asc can say; Error(UnknownFormat); Error(FileNotWritable).
void write_grid(const std::string& path, const Grid& grid);

}  // namespace brushfire
