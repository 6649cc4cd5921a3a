// Which part of a mesh is connected with given points of it.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire {

// [vertex_count]: 1 where faces, joined through vertices, lead from one of the points; 0 elsewhere, where every
// distance from them is infinite. A run that a radius or its targets stopped early cannot tell the two apart by
// itself. Points that are nowhere lead nowhere. Throws Error(IndexOutOfRange) for a face that does not exist. O(faces).
std::vector<std::uint8_t> reachable(const Mesh& mesh, std::span<const SurfacePoint> points);

}  // namespace brushfire
