// Which part of a mesh hangs together with some points of it.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brushfire {

// [vertex_count]: 1 where faces, joined through vertices, lead from one of the points; 0 elsewhere, where every
// distance from them is infinite. A run that was stopped by a radius or by its targets does not know the one from the
// other. Points that are nowhere lead nowhere. Throws Error(IndexOutOfRange) for a face that does not exist. O(faces).
std::vector<std::uint8_t> reachable(const Mesh& mesh, std::span<const SurfacePoint> points);

}  // namespace brushfire
