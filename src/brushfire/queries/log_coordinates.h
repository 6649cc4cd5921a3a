// Log maps with angles counted from a chosen direction, and in Cartesian coordinates.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/queries/straightest.h>

#include <array>
#include <optional>
#include <vector>

namespace brushfire {

// Makes the angles of a map run counter-clockwise, as the faces at its source do, counted from a direction in space
// (see angle_of()), or from the first edge there. Around a point they go from 0 to the full turn; at the mesh's border
// they stay between its two edges, and are negative clockwise of the direction. Throws as angle_of() does.
void turn(const Mesh& mesh, const SurfacePoint& source, const std::optional<Vec3>& direction, SparseLogMap& map);

// u and v of every row of a map that was turned, [reached]: u points along angle 0, v a quarter of a turn counter-
// clockwise. At a vertex with faces all around the full turn, more or less than 2 pi, is stretched to 2 pi; at the
// mesh's border angles stay what they are.
std::vector<std::array<double, 2>> flat_coordinates(const Mesh& mesh, const SurfacePoint& source,
                                                    const SparseLogMap& map);

}  // namespace brushfire
