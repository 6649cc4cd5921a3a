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
  const T sign = minus_if<T>(hand), turn = sign * around.s;
  return {c, s, c * around.c - s * turn, s * around.c + c * turn, sign};
}

template <class T>
BRUSHFIRE_INLINE T bending_by(std::uint8_t bends) {
  return bends != 0 ? kGrazing<T> : T(-1);
}

// The target in the frame of the edge, and how vectors turn from there into the target's own frame.
template <class T>
struct OfferFrame {
  T x, y, sign, turn_c, turn_s;
};
// Over the edge along `by` to the end of `to`; `own`, `end`: of the vertex and of the target.
template <class T>
BRUSHFIRE_INLINE OfferFrame<T> offer_frame(const Side<T>& by, const Side<T>& to, Update u, Around<T> own,
                                           Around<T> end) {
  const T own_turn = minus_if<T>(u.hand()) * own.s;
  const T tc = u.across() ? to.c * own.c - to.s * own_turn : to.c;
  const T ts = u.across() ? to.s * own.c + to.c * own_turn : to.s;
  OfferFrame<T> f;
  f.x = to.length * (tc * by.c + ts * by.s), f.y = to.length * std::abs(ts * by.c - tc * by.s);
  // Where the way back to the vertex has a known direction.
  const T c = u.seam() ? end.c : to.end_c, s = u.seam() ? end.s : to.end_s;
  f.sign = minus_if<T>(u.same_turn() ? 0 : 1);
  const T inverse = T(-1) / to.length, sy = f.sign * f.y;
  f.turn_c = (c * f.x + s * sy) * inverse, f.turn_s = (s * f.x - c * sy) * inverse;
  return f;
}

}  // namespace brushfire::carried_source
