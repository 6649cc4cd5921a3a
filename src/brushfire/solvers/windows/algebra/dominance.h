// L7: when what is known at the ends of an edge makes a window on it superfluous.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// A window is dropped where another path is shorter by more than this share: far more than rounding, so that a window
// is never dropped because of a value that it made itself.
inline constexpr Real kDominated = Real{1} - Real{1e-12 * kFiner};

// What is known of an edge: its length, and the lengths of real paths to its ends.
struct EdgeBounds {
  Real length = 0;
  Real start = kInfinity, end = kInfinity;
};

// Xin and Wang 2009: a path through either end of the edge is shorter at the far end of the window [b0,b1] with values
// d0 and d1, hence (the path along the edge grows fastest) everywhere in it.
[[gnu::always_inline]] inline bool is_dominated(const EdgeBounds& edge, Real b0, Real b1, Real d0, Real d1) {
  return (edge.start + b1 < d1 * kDominated) | (edge.end + (edge.length - b0) < d0 * kDominated);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
