// Windows that travel one by one: into a face, trimmed and merged there, and out over the other two edges.
#pragma once

#include <brushfire/solvers/windows/propagation/part_state.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Halfedge h has come up in the queue: what waits there is trimmed (L5), merged (L2), and goes on to the other two
// edges.
void propagate_windows(PartState& part, Index h);

// One window, from halfedge h through its face: what it sees there, and its children on their way.
void pass_face(PartState& part, Index h, const Frame& frame, const Window& waiting);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
