// A window that crosses an edge between two weights.
//
// Within a face of weight w values are costs divided by w, so that windows there are those of
// solvers/windows/algebra/window.h. Behind the edge the same costs, in the next face's units, are n times as large, n
// being the quotient of the weights: a front that is no longer a circle. It is replaced by windows that are nowhere
// above it, have its values at their ends, and pay what that loses in slack; docs/weights.md has the proof.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

#include <vector>

namespace brushfire::refraction {

using windows::Window;

// What may be spent where weights change, in the next face's units.
struct RefractionBudget {
  double share = 0;    // of the path's length from its source on: all of a window's slack
  double pace = 0.25;  // of what is left of that: one refraction
  double start = 0;    // the value at the source
};

// How many times the values of a window its source may be away: the flattest fronts behind the edge are some 1 / n^2 of
// them from theirs. Values are off by an epsilon or two of that.
double farthest_source(double n);

// Appends what lights the next face; nothing where all is reflected. Places on the edge stay what they are. The windows
// tile the part of the interval that is not reflected. `n` > 0, not 1.
void refract(const Window& w, double n, const RefractionBudget& budget, std::vector<Window>& out);

}  // namespace brushfire::refraction
