// Obtuse corners unfolded by the one face behind them, as nearly all are: the faces behind, looked up for many corners,
// and the triangles that come of it, four corners at a time.
#pragma once

#include <brushfire/core/detail/lanes.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/fast_marching/detail/regular_ring.h>
#include <brushfire/solvers/fast_marching/detail/unfold.h>

#include <array>
#include <bit>
#include <span>

namespace brushfire::fast_marching {

// Two faces over one edge: an obtuse corner, the ends of the edge across, the vertex behind it.
struct FacePair {
  std::array<Index, 2> end;
  Index corner, behind;
};

// Of the corner of halfedge h in a face with three vertices. Where there is not exactly one face behind, or it is the
// same one turned over, an end takes the place of what is behind: no corner is unfolded by that.
FacePair face_pair(const Mesh& mesh, const Unfolder& unfolder, Index h);

inline constexpr std::size_t kCorners = 4;

// The two triangles (corner; end, behind) of each of four corners: what RingBlock wants of them, as seen from the ends
// and from behind.
template <class T>
struct UnfoldedCorners {
  struct Side {
    alignas(32) T length[kCorners];      // from the end to the corner
    alignas(32) T between[kCorners];     // from the end to what is behind
    alignas(32) T dot_end[kCorners];     // at the end: the way to the corner times the one to what is behind
    alignas(32) T dot_behind[kCorners];  // behind: the way to the corner times the one to the end
    alignas(32) T cross[kCorners];       // twice the area
  };
  Side side[2];
  alignas(32) T length[kCorners];  // from the corner to what is behind
};

// Which of four corners are obtuse, and which of them the one face behind splits into two acute angles: a bit for each.
struct CornerSets {
  std::uint32_t obtuse = 0, split = 0;
};

// Squares of lengths outside of this are left to others: their products could vanish or overflow.
inline constexpr double kLeastSquare = 0x1p-200, kMostSquare = 0x1p200;

}  // namespace brushfire::fast_marching

#define BRUSHFIRE_KERNEL <brushfire/solvers/fast_marching/detail/unfolded_corner_kernel.h>
#include <brushfire/core/detail/each_target.h>
