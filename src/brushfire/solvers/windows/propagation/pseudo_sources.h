// Where windows begin: at sources, and at vertices where paths may bend.
#pragma once

#include <brushfire/solvers/windows/algebra/line_source.h>
#include <brushfire/solvers/windows/propagation/part_state.h>

#include <span>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// L6. A vertex that has been reached is a pseudo-source: windows go on from v into its shadow, or everywhere; here into
// the faces of this part, and from its ghosts into the others.
void propagate_from_vertex(PartState& part, Index v);

// A segment of a source and one of its ends.
struct SegmentEnd {
  SegmentInFace segment;
  bool is_first;  // the end is where the segment begins
};

// A source at a vertex, or in a face or on an edge (from each of the faces that hold it); `sigma` is the value there.
// Where segments of a curve end in the point (`ends`, at most two), it sends out the light that they do not.
void start_at_vertex(PartState& part, Index v, Real sigma, Index pseudo_source);
void start_in_face(PartState& part, const FaceWeights& at, Real sigma, Index pseudo_source,
                   std::span<const SegmentEnd> ends = {});
// A segment of a curve: what it sees, and the parallel light of both sides. Along an edge from each of its faces.
void start_along(PartState& part, const SegmentInFace& segment, Index pseudo_source);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
