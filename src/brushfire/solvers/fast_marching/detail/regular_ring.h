// The triangles around a vertex with a regular one-ring: an inner vertex of three to eight faces in the plainest order.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/fast_marching/detail/angle.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <type_traits>

namespace brushfire::fast_marching {

// What of a mesh is looked at. Plain: with positions, and without slits.
struct RingMesh {
  std::span<const Vec3> positions;
  std::span<const Face> faces;
  std::span<const Index> corner_offsets, corners;
  double scale = 1;  // 1 / unit
  Index none = 0;    // the end of sides that are not there
  bool plain = false;

  const double* coordinates() const { return reinterpret_cast<const double*>(positions.data()); }
  const Index* vertices() const { return reinterpret_cast<const Index*>(faces.data()); }
};

// Vertices are taken some at a time: what one of them waits for, another one computes meanwhile.
inline constexpr Index kRingsAtOnce = 16;

// The one-rings of vertices that follow each other; what is said of a vertex whose ring is not regular is void.
template <class T>
struct RegularRings {
  // Of the triangles, the sums: their angles at the vertex, twice their areas, their first sides. 0 where not regular.
  T angle[kRingsAtOnce], area[kRingsAtOnce], length[kRingsAtOnce];
  bool regular[kRingsAtOnce];
  // The corners whose angle is more than a right one, or seems to be.
  Index obtuse[(kRingsAtOnce + 1) * kLanes];  // whole registers are written
  Index obtuse_count = 0;
};

// Not so small that squares and fourth powers lose their digits.
template <class T>
inline constexpr T kSmallestSquare = std::is_same_v<T, float> ? T(0x1p-60) : T(0x1p-400);

}  // namespace brushfire::fast_marching

#define BRUSHFIRE_KERNEL <brushfire/solvers/fast_marching/detail/regular_ring_kernel.h>
#include <brushfire/core/detail/each_target.h>
