// What a run knows of a vertex, in three arrays: apart, so that the one that every window reads stays small. A vertex
// has an entry in each of its parts (FacePartition).
#pragma once

#include <brushfire/solvers/windows/propagation/fan.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// What every window that passes a vertex reads.
struct alignas(32) VertexValues {
  Real upper = kInfinity;       // length of the shortest real path known
  Real lower = kInfinity;       // least value of the windows that see the vertex, after merging
  Real estimate = kInfinity;    // the least distance that a window expected that saw it, before merging
  Index next_ghost = kNoIndex;  // see FacePartition
  bool sent = false;            // a message says that `upper` has fallen
  bool direct = false;          // `lower` came straight from a source in a face of the vertex

  bool has_ghosts() const { return next_ghost != kNoIndex; }
  void forget() { *this = {kInfinity, kInfinity, kInfinity, next_ghost, false, false}; }
};
static_assert(sizeof(VertexValues) == 32 || kWide);

// What a vertex where paths may bend has to know to be one.
struct PseudoSource {
  Real place = 0;             // where its least value came from: a CrossedAt, without its padding
  Index halfedge = kNoIndex;  // likewise
  bool all_around = false;    // windows go on in all directions, whatever its faces are like
  bool waiting = false;       // its value has fallen since windows last went on from it

  CrossedAt from() const { return {place, halfedge}; }
  void came_from(const CrossedAt& at) { place = at.place, halfedge = at.halfedge; }
};
static_assert(sizeof(PseudoSource) == 16 || kWide);

// Where the least value of a vertex comes from in the end; for runs with several sources.
struct Provenance {
  Index pseudo_source = kNoIndex;  // see Ray
  Index label = kNoIndex;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
