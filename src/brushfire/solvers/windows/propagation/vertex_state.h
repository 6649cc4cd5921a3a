// What a run knows of a vertex, in three arrays: apart, so that the hot one stays small. (Of every copy of a vertex:
// see WindowStructure.)
#pragma once

#include <brushfire/solvers/windows/propagation/fan.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// What every window that passes a vertex reads.
struct alignas(32) VertexValues {
  Real upper = kInfinity;       // length of the shortest real path known
  Real lower = kInfinity;       // least value of the windows that see the vertex, after merging
  Real estimate = kInfinity;    // the least distance that a window expected that saw it, before merging
  Index next_ghost = kNoIndex;  // in another part; the copies of a vertex form a ring. kNoIndex: there is one only
  bool sent = false;            // among the news that are about to be sent to the other copies
  bool direct = false;          // `lower` came straight from a source in a face of the vertex

  bool has_ghosts() const { return next_ghost != kNoIndex; }
  void forget() { *this = {kInfinity, kInfinity, kInfinity, next_ghost, false, false}; }
};
static_assert(sizeof(VertexValues) == 32 || kWide);

// What a vertex where paths may bend needs to send light on.
struct VertexLight {
  Real place = 0;             // where its least value came from: CrossedAt, without its padding
  Index halfedge = kNoIndex;  // likewise
  bool all_around = false;    // sends light in all directions, whatever its faces are like
  bool waiting = false;       // its value has fallen since it last sent light

  CrossedAt from() const { return {place, halfedge}; }
  void came_from(const CrossedAt& at) { place = at.place, halfedge = at.halfedge; }
};
static_assert(sizeof(VertexLight) == 16 || kWide);

// Where light comes from in the end; for runs with several sources.
struct Origins {
  Index root = kNoIndex;  // see Ray
  Index label = kNoIndex;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
