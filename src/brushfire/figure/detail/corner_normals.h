// Normals for shading.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <array>
#include <vector>

namespace brushfire::detail {

// A direction for every corner of every face, [halfedge_count], of length 1 (0 in a face without area), on the side
// from which the face's corners run counter-clockwise: smooth over a scan, kept apart at the edges of a machine part.
std::vector<std::array<float, 3>> corner_normals(const Mesh& mesh);

}  // namespace brushfire::detail
