// ESRI ASCII grids: a header of names and numbers, then the heights, the northernmost row first.
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/read_grid.h>

namespace brushfire::detail {

// Lines count for nothing: rows may be wrapped. NODATA_value (-9999 unless the header says otherwise) and what is not
// finite are no heights. Throws Error(FileMalformed), also where more numbers follow than the header promises.
Grid read_ascii_grid(const Input& input);

}  // namespace brushfire::detail
