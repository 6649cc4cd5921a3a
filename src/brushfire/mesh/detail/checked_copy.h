// Arrays that a caller gives, checked, and copied in the same pass where that is wanted.
#pragma once

#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <span>

namespace brushfire::detail {

// 2^990: a shortest path has 2^32 legs at most and each is shorter than four times this, so distances are finite.
constexpr double kMostCoordinate = 0x1p990;

// Throw as the constructors of Mesh do. The second one returns the bounds.
void check(Index vertex_count, std::span<const Face> faces);
Box check(std::span<const Vec3> positions);

// The same, and a copy of what was checked.
UninitializedArray<Face> checked_copy(Index vertex_count, std::span<const Face> faces);
UninitializedArray<Vec3> checked_copy(std::span<const Vec3> positions, Box& bounds);

}  // namespace brushfire::detail
