// What one part of the mesh has in a run, and what works on it.
#pragma once

#include <brushfire/solvers/windows/algebra/envelope.h>
#include <brushfire/solvers/windows/algebra/exact_cross.h>
#include <brushfire/solvers/windows/propagation/exact_trim.h>
#include <brushfire/solvers/windows/propagation/links.h>
#include <brushfire/solvers/windows/propagation/messages.h>
#include <brushfire/solvers/windows/propagation/own_vertices.h>
#include <brushfire/solvers/windows/propagation/run_state.h>
#include <brushfire/solvers/windows/store/exact_lists.h>
#include <brushfire/solvers/windows/store/lists.h>
#include <brushfire/solvers/windows/store/memory.h>
#include <brushfire/solvers/windows/store/queue.h>
#include <brushfire/solvers/windows/store/spines.h>
#include <brushfire/solvers/windows/store/trails.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// A vertex this little (relative) off a window's limit ray counts as seen, with the length of the path that bends.
inline constexpr double kSeen = 1e-10 * kSqrtFiner;
// (Beside its segment parallel light may come to a hair less than nothing.)
inline bool is_seen(const Arrival& at) { return !(at.detour > 0) || at.detour <= kSeen * at.value; }

// What is written by one thread all the time stays clear of what another one reads: processors fetch lines by twos.
inline constexpr std::size_t kApart = 128;  // bytes

// What a thread needs at hand to work on parts, one after the other.
struct alignas(kApart) Workbench {
  BlockPool blocks;
  ListTrimmer trim;
  Sight sight;
  Routes routes;
  Envelope envelope;
  std::vector<Window> taken;
  std::vector<Window> on_edge;  // of those, with their source on the edge
  std::vector<Index> corners;   // at a vertex
  LinkShadow link;
};

// What a part needs while something waits in it. The front is in few parts at a time: they hand it on.
struct alignas(kApart) Activity {
  EventQueue queue;
  WindowLists windows;
  ExactLists lists;
  Outbox outbox;

  void clear() {
    queue.reset(1, 0);
    windows.clear();
    lists.clear();
    outbox.clear();
  }
};

struct alignas(kApart) PartState {
  PartState(RunState& r, Index n) : run(&r), number(n), vertices(r, n) {}

  RunState* run;
  Index number;
  OwnVertices vertices;
  std::unique_ptr<Activity> activity;  // null: nothing waits
  Workbench* bench = nullptr;          // of the thread that works on the part
  WindowMemory memory;
  Trails trails;  // of windows that cross thin faces (of all, in wide numbers)
  SpineMemory spines;
  std::vector<KeptWindow> kept;

  WindowFace& face(Index h) const { return run->structure.faces[h / 3]; }
  bool is_here(Index f) const { return run->structure.part_of_face(f) == number; }
};

// Windows of exact runs travel in lists, but not over faces so thin that windows may come back for ever: these take
// them one by one (WindowMemory).
inline bool goes_in_lists(const PartState& part, Index h) { return part.run->in_lists && !part.face(h).thin; }

// Whether windows remember that they were in a face.
inline bool leaves_trail(const WindowFace& f) { return kWide || f.thin; }

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
