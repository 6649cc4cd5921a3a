// Curves as text: how --source and the lines of --sources FILE name whole curves.
//
//   boundary           the boundary of the mesh, all of it
//   boundary:2         the curve that `brushfire info` lists under this name
//   path:0,at:1,2,3    the shortest path between places, in this order
//   chain:3,4,5        along the edges between these vertices; closed where the last one is the first
//   region:FILE:LABEL  where the labels of a file, of vertices or of faces, are these: 0 inside, elsewhere from its
//   border drawn.obj          the curves of a file, each a source of its own: .csv .json .obj .ply .vtp curve:FILE the
//   same, whatever the file is called
#pragma once

#include "where.h"

#include <brushfire/solvers/distance.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::tool {

class Surface;

// What a text names, if it names a curve; nullopt: a place, or nothing. Throws Error(InvalidArgument) for one that
// begins like a curve and is none.
std::optional<CurvePlace> parse_curve(std::string_view text);

// The curves of a text on this surface, as sources: several where a file has several. What lies off the surface is put
// onto it, through `finder`, which refuses or tells the largest gap. Throws Error(InvalidArgument) and
// Error(IndexOutOfRange) for what the mesh has not, and what the readers throw.
std::vector<Source> curve_sources(const Surface& surface, PlaceFinder& finder, const Where& where);

}  // namespace brushfire::tool
