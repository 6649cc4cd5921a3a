// Edges as lines.
#pragma once

#include <brushfire/io/detail/formats.h>

#include <array>
#include <span>

namespace brushfire::detail {

// Edges in the order of the file: one that starts where the last one ended goes on with its line, and ends it, closed,
// where it comes back to the line's first vertex. A vertex in no edge is a line of one point. Lines come in the order
// of their first vertices.
LoadedLines lines_along(std::span<const Vec3> positions, std::span<const std::array<Index, 2>> edges);

}  // namespace brushfire::detail
