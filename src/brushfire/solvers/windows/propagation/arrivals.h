// What windows and sources see on their way: vertices and targets.
#pragma once

#include <brushfire/solvers/windows/propagation/part_state.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

[[gnu::noinline]] void accept(PartState& part, Index v, Real value, const Ray& ray, bool all_around);

// A window or a source sees v. Where paths may bend, light will go on from there (`all_around`: whatever the faces
// there are like). The ghosts of v get a message.
[[gnu::always_inline]] inline void see_vertex(PartState& part, Index v, Real value, const Ray& ray, bool all_around) {
  if (!(value > part.vertices[v].lower)) accept(part, v, value, ray, all_around);
}

// What a ghost of the vertex has seen.
void receive(PartState& part, const ArrivalMessage& message);

// Along a ray or, where it is not `straight`, by a detour: a real path, but not one to follow back. Targets may lie on
// an edge between two parts: their values are gathered when all parts have stopped.
void reach_target(PartState& part, Index target, Real value, Real slack, Real lift, const Ray& ray,
                  bool straight = true);

// Must be sent before what comes from this pseudo-source.
void send_label(PartState& part, Index to, Index pseudo_source);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
