// What windows and sources see on their way: vertices and targets.
#pragma once

#include <brushfire/solvers/windows/propagation/part_state.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

[[gnu::noinline]] void accept(PartState& part, Index v, Real value, const Ray& ray, bool all_around);

// A window or a source sees v. Where paths may bend, light will go on from there (`all_around`: whatever the faces
// there are like). The other copies of v are told.
[[gnu::always_inline]] inline void see_vertex(PartState& part, Index v, Real value, const Ray& ray, bool all_around) {
  if (!(value > part.vertices[v].lower)) accept(part, v, value, ray, all_around);
}

// What another part's copy of v has seen.
void receive_sight(PartState& part, Index v, Real value, const Ray& ray, bool all_around);

// Along a ray or, where it is not `straight`, by a detour: a real path, but not one to follow back. Targets may lie on
// an edge between two parts: they are told when all parts have stopped.
void reach_target(PartState& part, Index target, Real value, Real slack, Real lift, const Ray& ray,
                  bool straight = true);

// To be sent before what comes from this root.
void send_label(PartState& part, Index to, Index root);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
