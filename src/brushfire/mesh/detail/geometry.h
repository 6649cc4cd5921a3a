// Lengths and areas of all faces, in a unit that keeps their digits.
#pragma once

#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <span>

namespace brushfire::detail {

struct Geometry {
  UninitializedArray<double> lengths;       // [halfedge_count]
  UninitializedArray<double> double_areas;  // [face_count]
};

// 2^k with 2^k <= x < 2^(k+1), within the bounds of units; 1 for 0.
double power_of_two_below(double x);

// The power of two below the mean length of a sample of the edges.
double unit_from_positions(std::span<const Vec3> positions, std::span<const Face> faces, const Box& bounds);

// The same of all edges of a mesh from lengths.
double unit_from_lengths(std::span<const double> lengths);

Geometry geometry_from_positions(std::span<const Vec3> positions, std::span<const Face> faces, double unit);

}  // namespace brushfire::detail
