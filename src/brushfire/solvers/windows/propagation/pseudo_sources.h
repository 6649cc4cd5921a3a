// Where windows begin: at sources, and at vertices where paths may bend.
#pragma once

#include <brushfire/solvers/windows/propagation/part_state.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// L6. A vertex that has been reached is a pseudo-source: windows go on from v into its shadow, or everywhere; here into
// the faces of this part, and from its ghosts into the others.
void propagate_from_vertex(PartState& part, Index v);

// A source at a vertex, or in a face or on an edge (from each of the faces that hold it); `sigma` is the value there.
void start_at_vertex(PartState& part, Index v, Real sigma, Index pseudo_source);
void start_in_face(PartState& part, const FaceWeights& at, Real sigma, Index pseudo_source);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
