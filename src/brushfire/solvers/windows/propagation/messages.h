// What one part of the mesh sends to others: it waits in the sender's outbox until all parts have stopped.
#pragma once

#include <brushfire/solvers/partition/outbox.h>
#include <brushfire/solvers/windows/algebra/rays.h>
#include <brushfire/solvers/windows/algebra/window.h>
#include <brushfire/solvers/windows/store/exact_lists.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The label of a pseudo-source, which must be known before what comes from there. In runs with several sources.
struct LabelMessage {
  Index part, pseudo_source, label;
};
// The upper bound of a vertex fell: its new value, for the ghosts.
struct FallenMessage {
  Index vertex;
};
// A window or a source sees a vertex: to each of its ghosts.
struct ArrivalMessage {
  Index vertex;
  Real value;
  Ray ray;
  bool all_around;
};
// A path to a target; see reach_target().
struct TargetMessage {
  Index target;
  Real value, slack, lift;
  Ray ray;
  bool straight;
};
struct WindowMessage {
  Index halfedge;
  Origin origin;
  Window window;
};
struct ListMessage {
  Index halfedge;
  Origin origin;
  WindowList list;
};

// In the order in which they are received.
using Outbox =
    partition::Outbox<LabelMessage, FallenMessage, ArrivalMessage, TargetMessage, WindowMessage, ListMessage>;

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
