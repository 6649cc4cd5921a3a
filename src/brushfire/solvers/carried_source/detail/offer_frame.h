// What of an offer over an edge is the same for all sources: numbers of a vertex's record.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/solvers/carried_source/detail/records.h>
#include <brushfire/solvers/carried_source/detail/update.h>

#include <cmath>

namespace brushfire::carried_source {

// Without a branch: which it is cannot be foreseen.
template <class T>
BRUSHFIRE_INLINE T minus_if(Index one) {
  return T(1) - T(2) * static_cast<T>(static_cast<int>(one));
}

// How a vector of a vertex is turned into the frame of a side, as source_below() takes it: c, s, or tc, ts.
template <class T>
struct SideTurn {
  T c, s, tc, ts, side;
};
// `hand`: 1 where the target lies to the right; c, s: the side's direction at the vertex, whose angles sum to `around`.
template <class T>
BRUSHFIRE_INLINE SideTurn<T> side_turn(T c, T s, Index hand, Around<T> around) {
  SideTurn<T> t{c, s, 0, 0, minus_if<T>(hand)};
  turn_round(c, s, t.side, around.c, around.s, t.tc, t.ts);
  return t;
}

template <class T>
BRUSHFIRE_INLINE T bending_by(std::uint8_t bends) {
  return bends != 0 ? kGrazing<T> : T(-1);
}

// Over the edge along `by` to the end of `to`; `own`, `end`: of the vertex and of the target.
template <class T>
BRUSHFIRE_INLINE OfferFrame<T> offer_frame(const Side<T>& by, const Side<T>& to, Update u, Around<T> own,
                                           Around<T> end) {
  const SideTurn<T> turned = side_turn(to.c, to.s, u.hand(), own);
  const T tc = u.across() ? turned.tc : to.c, ts = u.across() ? turned.ts : to.s;
  // Where the way back to the vertex has a known direction.
  const T c = u.seam() ? end.c : to.end_c, s = u.seam() ? end.s : to.end_s;
  return frame_over(by.c, by.s, tc, ts, to.length, c, s, minus_if<T>(u.same_turn() ? 0 : 1));
}

}  // namespace brushfire::carried_source
