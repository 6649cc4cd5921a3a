// Grids in whatever GDAL reads, and as GeoTIFF; in builds with it.
#pragma once

#include <brushfire/io/read_grid.h>

#include <string>

namespace brushfire::detail {

// Both throw Error(UnknownFormat), which says what to do, where there is no GDAL in this build.

// The first band, in its own unit (scale and offset applied); what its mask hides is +inf. Throws
// Error(FileNotReadable) where GDAL opens no raster, Error(FileMalformed) where it cannot read on, Error(TooLarge).
Grid read_gdal(const std::string& path);
// Float64, deflated; +inf is no data. Throws Error(FileNotWritable).
void write_geotiff(const std::string& path, const Grid& grid);

}  // namespace brushfire::detail
