// Colours of cells in a picture: few, far apart, and never the same on both sides of a border.
#pragma once

#include <brushfire/queries/voronoi.h>

#include <vector>

namespace brushfire::tool {

// [count] a number for label_color() of each cell. The colours of consecutive numbers are those of Okabe and Ito, which
// people with any colour vision tell apart; up to eight cells have one each. Of more, cells that share a face differ.
std::vector<Index> colors_of(const VoronoiDiagram& cells, std::size_t count);

}  // namespace brushfire::tool
