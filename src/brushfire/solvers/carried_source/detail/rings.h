// The one-rings of most vertices, measured some at a time: inner vertices of three to eight faces in the plainest
// order. Directions are products of the unit vectors of corners; their angles, which only say in which sectors light is
// dark, are those of single numbers.
#pragma once

#include <brushfire/solvers/carried_source/detail/sight.h>
#include <brushfire/solvers/fast_marching/detail/regular_ring.h>

namespace brushfire::carried_source {

using fast_marching::kLanes, fast_marching::kRingsAtOnce, fast_marching::RingMesh;

// Sides and corners counter-clockwise, from the first corner on: corner i lies between sides i and i + 1.
struct Ring {
  bool is_regular = false;  // if not, all else is void
  Index count = 0;
  alignas(32) Index corner[kLanes];  // as halfedges: along side i
  alignas(64) double length[kLanes];
  double c[kLanes + 1], s[kLanes + 1];  // directions; the last one: turned by the sum of all angles
  alignas(32) float angle[2 * kLanes];  // of sides, and the sum of all; +inf behind
  SightSets sets[kLanes];               // of the sides
  std::uint32_t obtuse = 0;             // bit i: the face of corner i is obtuse at the end of side i + 1
};

// As fast_marching::kRightAngle: rounding of coordinates tilts right angles by less.
inline constexpr double kRightAngle = 1e-9;

}  // namespace brushfire::carried_source

#define BRUSHFIRE_KERNEL <brushfire/solvers/carried_source/detail/rings_kernel.h>
#include <brushfire/core/detail/each_target.h>
