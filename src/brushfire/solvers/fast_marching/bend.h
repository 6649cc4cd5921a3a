// How the curvature of the surface bends fronts.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <vector>

namespace brushfire::detail {

// [vertex_count] Gaussian curvature around each vertex (the missing angle over the area, mean of the vertex and its
// neighbours) times the way that a front makes from one vertex to the next: what a front's own curvature loses there.
// 0 on boundaries, at non-manifold vertices, and where the surface is flat to kFlat radians.
std::vector<double> front_bend(const Mesh& mesh);

inline constexpr double kFlat = 1e-6;

}  // namespace brushfire::detail
