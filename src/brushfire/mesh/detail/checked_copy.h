// Arrays that a caller gives, checked and copied in one pass.
#pragma once

#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <span>

namespace brushfire::detail {

// 2^990: a shortest path has 2^32 legs at most and each is shorter than four times this, so distances are finite.
constexpr double kMostCoordinate = 0x1p990;

// A copy of the faces; throws as the constructor of Mesh does.
UninitializedArray<Face> checked_copy(Index vertex_count, std::span<const Face> faces);

// A copy of the positions, and their bounds; throws as the constructor of Mesh does.
UninitializedArray<Vec3> checked_copy(std::span<const Vec3> positions, Box& bounds);

}  // namespace brushfire::detail
