// Curves on a mesh as arrays.
#pragma once

#include "surface.h"

#include <brushfire/mesh/surface_path.h>

#include <span>

namespace brushfire::js {

// [starts (curves + 1), length, closed; faces, weights; positions]: curve k has the points starts[k] .. starts[k+1]
// - 1. No positions where the mesh has none.
void add_curves(Reply& reply, const Mesh& mesh, std::span<const SurfacePath> curves);

// The points of one, as JavaScript gives them back.
std::vector<SurfacePoint> curve_from(std::span<const std::uint32_t> faces, std::span<const double> weights);

}  // namespace brushfire::js
