// Merging: one window in place of two neighbours, with the proof of what that costs.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// How much slack windows may carry, and how fast they may spend it.
struct MergeBudget {
  // A window's slack may reach this share of the length of its shortest path: 2 t where the estimate may lie on either
  // side of the distance, t where one of the bounds itself is wanted; 0: no merging.
  double share = 0;
  // A merge may spend at most this part of the room that is left. Small: only cheap merges are made, the error in use
  // is a small part of the promise and room remains for later; 1: fewest windows.
  double pace = 0.03;
};

// Where a merged pair's windows take over from each other, and both values there.
struct Joint {
  Real at = 0, a = 0, b = 0;
};

// L2. Replaces neighbours a and b by one window on [a.b0, b.b1] that
//   (M1) is nowhere above the lesser of the two,
//   (M2) equals a at the left end and b at the right end,
//   (M3) carries as slack the largest of  a.slack + (a - merged)  on [a.b0, joint] and  b.slack + (b - merged)  on
//        [joint, b.b1],
// if the budget allows; docs/tolerance.md has the proof that propagating such windows instead keeps
// value <= distance <= value + slack at every vertex. The neighbours meet at the joint, with a gap of a sliver at most,
// or overlap there, a being the lesser at a.b0 and b at b.b1; where exactly they cross need not be known. `start`: the
// value at the source (its offset): lengths of paths are counted from there. The merged window takes b's place; false,
// and nothing is changed, where that is impossible or too dear. Two linear windows become the linear one through their
// outer ends where that is not above them; else, and of different kinds, a circular one.
bool merge_into(const Window& a, Window& b, const Joint& joint, Real start, const MergeBudget& budget);

// The same for neighbours that have been trimmed.
inline bool merge_into(const Window& a, Window& b, Real start, const MergeBudget& budget) {
  return merge_into(a, b, {a.b1, a.d1, b.d0}, start, budget);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
