// What of a front still holds after weights, walls, fences or sources have changed.
// Based on: Koenig, Likhachev, Furcy (2004), Lifelong planning A*: what hangs on a step that has become dearer is
// forgotten, and the search goes on from what lies around it.
#pragma once

#include <brushfire/solvers/steiner/detail/run.h>

#include <vector>

namespace brushfire::steiner {

struct Carried {
  Front front;              // values that real paths still have, +inf elsewhere; parents in the numbers of the new run
  std::vector<Index> rows;  // those to be sent again, whole; sources start anew
  double kept = 0;          // the share of the points that have a value
};

// From the run `before` to `after`, which has everything but its front. A search that goes on from here ends with the
// values of a search from the sources, to the bit: it finds the least of the same sums. Nothing is kept where the units
// or the least offsets of the two differ. Takes the front of `before`. O(points), a few nanoseconds each; what is
// forgotten costs as much again.
Carried carry(Run& before, const Run& after);

}  // namespace brushfire::steiner
