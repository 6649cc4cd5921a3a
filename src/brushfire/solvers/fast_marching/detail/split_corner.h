// What becomes of an obtuse corner that the one face behind it splits, as nearly all do: four corners at a time, in
// registers or one after the other. Both give the same bits.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/fast_marching/detail/double4.h>
#include <brushfire/solvers/fast_marching/detail/unfold.h>
#include <brushfire/solvers/fast_marching/detail/vector_target.h>

#include <array>
#include <cmath>
#include <span>

namespace brushfire::fast_marching {

// Two faces over one edge: an obtuse corner, the ends of the edge across, the vertex behind it.
struct FacePair {
  std::array<Index, 2> end;
  Index corner, behind;
};

inline constexpr std::size_t kPairs = 4;

// The two triangles (corner; end, behind) of each of four corners: what RingBlock wants of them, as seen from the ends
// and from behind.
template <class T>
struct SplitCorners {
  struct Side {
    alignas(32) T length[kPairs];      // from the end to the corner
    alignas(32) T between[kPairs];     // from the end to what is behind
    alignas(32) T dot_end[kPairs];     // at the end: the way to the corner times the one to what is behind
    alignas(32) T dot_behind[kPairs];  // behind: the way to the corner times the one to the end
    alignas(32) T cross[kPairs];       // twice the area
  };
  Side side[2];
  alignas(32) T length[kPairs];  // from the corner to what is behind
};

// Which of four corners are obtuse and which of them the one face behind
// splits into two acute angles: a bit for each.
struct CornerSets {
  std::uint32_t obtuse = 0, split = 0;
};

// Squares of lengths outside of this are left to others: their products could vanish or overflow.
inline constexpr double kLeastSquare = 0x1p-200, kMostSquare = 0x1p200;

// Unfolds the faces behind into the planes of their corners. What is said of corners that are not split is void.
template <class T>
BRUSHFIRE_INLINE CornerSets split_corners(std::span<const Vec3> positions, double scale, const FacePair* pair,
                                          SplitCorners<T>& split) {
  CornerSets sets;
  for (std::size_t k = 0; k < kPairs; ++k) {
    const Vec3 at_corner = positions[pair[k].corner], at_behind = positions[pair[k].behind];
    const Vec3 at0 = positions[pair[k].end[0]], at1 = positions[pair[k].end[1]];
    const Vec3 corner0 = scale * (at_corner - at0), corner1 = scale * (at_corner - at1);
    const Vec3 behind0 = scale * (at_behind - at0), behind1 = scale * (at_behind - at1);
    const Vec3 edge = scale * (at1 - at0), over = scale * (at_corner - at_behind);
    const double cc0 = dot(corner0, corner0), cc1 = dot(corner1, corner1);
    const double bb0 = dot(behind0, behind0), bb1 = dot(behind1, behind1), ee = dot(edge, edge);
    // In the plane, in the frame of the edge and times its length: along it from either end, and away from it. Areas
    // from the two shorter edges, as rounding of a cross product grows with the product of the lengths.
    const double c0 = dot(corner0, edge), c1 = -dot(corner1, edge);
    const double b0 = dot(behind0, edge), b1 = -dot(behind1, edge), along = dot(over, edge);
    const bool edge_longest = (bb0 <= ee) & (bb1 <= ee), first_shorter = bb0 <= bb1;
    const Vec3 u = edge_longest | first_shorter ? behind0 : behind1, w = edge_longest ? behind1 : edge;
    const Vec3 corner_area = brushfire::cross(corner0, corner1), behind_area = brushfire::cross(u, w);
    const double cy = std::sqrt(dot(corner_area, corner_area)), by = std::sqrt(dot(behind_area, behind_area));
    const double away = cy + by, inverse = 1 / ee;
    const double cross0 = (c0 * by + cy * b0) * inverse, cross1 = (c1 * by + cy * b1) * inverse;
    const auto fine = [](double square) { return (kLeastSquare <= square) & (square <= kMostSquare); };
    const bool acute = (0 < c0 * along + cy * away) & (0 < cy * away - c1 * along);
    const bool within = (0 < cross0) & (0 < cross1);
    const bool good = acute & within & fine(cc0) & fine(cc1) & fine(bb0) & fine(bb1) & fine(ee);
    const bool obtuse = cc0 + cc1 < ee * (1 - kRightAngle);
    sets.obtuse |= (obtuse ? 1u : 0u) << k;
    sets.split |= (obtuse & good ? 1u : 0u) << k;
    split.side[0].length[k] = static_cast<T>(std::sqrt(cc0));
    split.side[1].length[k] = static_cast<T>(std::sqrt(cc1));
    split.side[0].between[k] = static_cast<T>(std::sqrt(bb0));
    split.side[1].between[k] = static_cast<T>(std::sqrt(bb1));
    split.side[0].dot_end[k] = static_cast<T>((c0 * b0 - cy * by) * inverse);
    split.side[1].dot_end[k] = static_cast<T>((c1 * b1 - cy * by) * inverse);
    split.side[0].dot_behind[k] = static_cast<T>((by * away - b0 * along) * inverse);
    split.side[1].dot_behind[k] = static_cast<T>((by * away + b1 * along) * inverse);
    split.side[0].cross[k] = static_cast<T>(cross0);
    split.side[1].cross[k] = static_cast<T>(cross1);
    split.length[k] = static_cast<T>(std::sqrt((along * along + away * away) * inverse));
  }
  return sets;
}

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

BRUSHFIRE_AVX2_INLINE Double4 fine_squares(Double4 square) {
  return (all4(kLeastSquare) <= square) & (square <= all4(kMostSquare));
}

// The same operations in the same order. Written twice, as no template can serve both: compilers refuse to inline what
// is for one instruction set (Double4) into what is for another or for any. EveryProcessorBuildsTheSameRings compares
// them.
template <class T>
BRUSHFIRE_AVX2 CornerSets split_corners4(std::span<const Vec3> positions, double scale, const FacePair* pair,
                                         SplitCorners<T>& split) {
  const auto at = [&](Index v) { return &positions.data()->x + 3 * std::size_t{v}; };
  const FourVec3 at_corner = load_four(at(pair[0].corner), at(pair[1].corner), at(pair[2].corner), at(pair[3].corner));
  const FourVec3 at_behind = load_four(at(pair[0].behind), at(pair[1].behind), at(pair[2].behind), at(pair[3].behind));
  const FourVec3 at0 = load_four(at(pair[0].end[0]), at(pair[1].end[0]), at(pair[2].end[0]), at(pair[3].end[0]));
  const FourVec3 at1 = load_four(at(pair[0].end[1]), at(pair[1].end[1]), at(pair[2].end[1]), at(pair[3].end[1]));
  const Double4 scales = all4(scale), zero = all4(0);
  const FourVec3 corner0 = scales * (at_corner - at0), corner1 = scales * (at_corner - at1);
  const FourVec3 behind0 = scales * (at_behind - at0), behind1 = scales * (at_behind - at1);
  const FourVec3 edge = scales * (at1 - at0), over = scales * (at_corner - at_behind);
  const Double4 cc0 = dot(corner0, corner0), cc1 = dot(corner1, corner1);
  const Double4 bb0 = dot(behind0, behind0), bb1 = dot(behind1, behind1), ee = dot(edge, edge);
  const Double4 c0 = dot(corner0, edge), c1 = -dot(corner1, edge);
  const Double4 b0 = dot(behind0, edge), b1 = -dot(behind1, edge), along = dot(over, edge);
  const Double4 edge_longest = (bb0 <= ee) & (bb1 <= ee), first_shorter = bb0 <= bb1;
  const FourVec3 u = select(edge_longest | first_shorter, behind0, behind1), w = select(edge_longest, behind1, edge);
  const FourVec3 corner_area = cross(corner0, corner1), behind_area = cross(u, w);
  const Double4 cy = square_root(dot(corner_area, corner_area)), by = square_root(dot(behind_area, behind_area));
  const Double4 away = cy + by, inverse = all4(1) / ee;
  const Double4 cross0 = (c0 * by + cy * b0) * inverse, cross1 = (c1 * by + cy * b1) * inverse;
  const Double4 acute = (zero < c0 * along + cy * away) & (zero < cy * away - c1 * along);
  const Double4 within = (zero < cross0) & (zero < cross1);
  store_root(split.side[0].length, cc0);
  store_root(split.side[1].length, cc1);
  store_root(split.side[0].between, bb0);
  store_root(split.side[1].between, bb1);
  store(split.side[0].dot_end, (c0 * b0 - cy * by) * inverse);
  store(split.side[1].dot_end, (c1 * b1 - cy * by) * inverse);
  store(split.side[0].dot_behind, (by * away - b0 * along) * inverse);
  store(split.side[1].dot_behind, (by * away + b1 * along) * inverse);
  store(split.side[0].cross, cross0);
  store(split.side[1].cross, cross1);
  store_root(split.length, (along * along + away * away) * inverse);
  const Double4 good =
      acute & within & fine_squares(cc0) & fine_squares(cc1) & fine_squares(bb0) & fine_squares(bb1) & fine_squares(ee);
  const Double4 obtuse = cc0 + cc1 < ee * all4(1 - kRightAngle);
  return {bits(obtuse), bits(obtuse & good)};
}

#endif

}  // namespace brushfire::fast_marching
