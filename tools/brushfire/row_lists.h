// Which rows or columns of a matrix: ranges, lists, files of places, labelled regions.
//
//   all                          every vertex
//   0:1000  0:1000:10  100:      from (and with) the first to (and without) the last, as in Python
//   0-999,5000                   from the first to the last, and another one
//   FILE                         places, one or a list of vertices per line; a mask, label or .npy file of vertices
//   lh.aparc.annot:insula,cuneus the vertices with these labels
//   17  f:120:.2,.3,.5  at:1,2,3 one place
#pragma once

#include "where.h"

#include <optional>
#include <string>
#include <vector>

namespace brushfire::tool {

// nullopt: all vertices. `option` is named in messages. Throws Error(InvalidArgument), Error(IndexOutOfRange) for a
// range beyond the mesh's vertices, and what reading a file throws.
std::optional<std::vector<Where>> parse_row_list(const std::string& text, const std::string& option,
                                                 Index vertex_count);

}  // namespace brushfire::tool
