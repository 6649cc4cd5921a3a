// The front over the edge of a triangle, and the value that it gives the corner across: one kernel per front model, of
// single numbers or of lanes.
//
// Based on: Novotni, Klein (2002), Computing Geodesic Distances on Triangular Meshes, section 3 (circular front);
// Kimmel, Sethian (1998), Computing Geodesic Paths on Manifolds (planar front).
#pragma once

#include <brushfire/core/detail/lanes.h>

#include <limits>

namespace brushfire::fast_marching {

// A front that started in one point, at distances t1 and t2 from the edge's ends: the target's distance from that
// point, where the straight line to it passes through the edge (ALGORITHMS: visibility test; without it the value is
// shorter than any path and every such error spreads).
struct CircularFront {
  static constexpr bool kHasRadius = true;   // the circle's radius is carried along, as sigma, the value at its centre
  static constexpr bool kFixedOnly = false;  // only values that are fixed support it
};

// The same, literally as printed: the farther of the two circle intersections, accepted always; where there is none,
// or only one value is known, the way along the edge.
struct LiteralCircularFront {
  static constexpr bool kHasRadius = false;
  static constexpr bool kFixedOnly = true;
};

// A straight front: of slope (t2 - t1)/length along the edge and slope 1 in all, where the ray that arrives at the
// target came through the edge (the upwind condition).
struct PlanarFront {
  static constexpr bool kHasRadius = false;
  static constexpr bool kFixedOnly = false;
};

}  // namespace brushfire::fast_marching

#define BRUSHFIRE_KERNEL <brushfire/solvers/fast_marching/detail/fronts_kernel.h>
#include <brushfire/core/detail/each_target.h>
