// Whole lists of windows, of exact runs: trimmed now and then, and on to the other two edges of a face.
#pragma once

#include <brushfire/solvers/windows/propagation/part_state.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Halfedge h has come up in the queue: what waits there goes on as one list.
void propagate_list(PartState& part, Index h);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
