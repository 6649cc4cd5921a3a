// Merging: one window in place of two neighbours, with the proof of what that costs.
#pragma once

#include <brushfire/solvers/windows/detail/window.h>

#include <vector>

namespace brushfire::detail {

// How much slack windows may carry, and how fast they may spend it.
struct MergeBudget {
  // A window's slack may reach this share of the length of its shortest path: 2 t where the estimate may lie on either
  // side of the distance, t where one of the bounds itself is wanted; 0: no merging.
  double share = 0;
  // A merge may spend at most this part of the room that is left. Small: only cheap merges are made, the error in use
  // is a small part of the promise and room remains for later; 1: fewest windows.
  double pace = 0.03;
};

// L2. Replaces neighbours a = [a.b0, m] and b = [m', b.b1], m' - m a sliver at most, by one window on [a.b0, b.b1] that
//   (M1) is nowhere above either,
//   (M2) equals a at the left end and b at the right end,
//   (M3) carries as slack the largest of  a.slack + (a - merged)  and  b.slack + (b - merged)  over their intervals,
// if the budget allows; docs/tolerance.md has the proof that propagating such windows instead keeps
// value <= distance <= value + slack at every vertex. `start`: the value at the source (its offset): lengths of paths
// are counted from there. Returns false and leaves `merged` in any state where that is impossible or too dear.
bool merge(const Window& a, const Window& b, double start, const MergeBudget& budget, Window& merged);

}  // namespace brushfire::detail
