// Where windows go that leave a face, or come from another part: they wait in the face beyond, are sent to its part, or
// end.
#pragma once

#include <brushfire/solvers/windows/algebra/dominance.h>
#include <brushfire/solvers/windows/algebra/propagate.h>
#include <brushfire/solvers/windows/propagation/part_state.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// ---- one by one

// A window leaves a face over its halfedge h; it is described from beyond, from the end of h to its start.
void leave_face(PartState& part, Index h, const Window& w, Origin origin);
// The same, for callers where it is rare.
[[gnu::noinline]] void leave_face_once(PartState& part, Index h, const Window& w);
// A message.
void receive(PartState& part, const WindowMessage& message);

// ---- whole lists, of exact runs

// A list leaves a face over its halfedge h; its block is the caller's no longer.
void leave_face(PartState& part, Index h, const WindowList& list, Origin origin);
void receive(PartState& part, const ListMessage& message);
inline bool leads_on(const PartState& part, Index h) { return part.face(h).beyond[h % 3] != Beyond::Nothing; }

// ---- what leave_face() is made of: it is where runs spend their time

[[gnu::noinline]] void leave_into_several(PartState& part, Index h, const Window& w);
[[gnu::noinline]] void send(PartState& part, Index h, const Window& w, Origin origin);
[[gnu::noinline]] void enter_list(PartState& part, Index h, const Window& w, Origin origin);
[[gnu::noinline]] void enter_after_trail(PartState& part, Index h, Window w);
[[gnu::noinline]] void pass_at_once(PartState& part, Index h, const Window& w);
[[gnu::noinline]] bool ends_here(const PartState& part, const WindowFace& f, Index k, const Window& w);

// In the face of h, until h comes up in the queue.
[[gnu::always_inline]] inline void wait(PartState& part, WindowFace& f, Index h, const Window& w) {
  const RunState& run = *part.run;
  const Index k = h % 3;
  const Arrival at_apex = arrival(w, frame_of(f, k).apex);
  const Index apex = f.vertex[previous3(k)];
  part.vertices.reach(apex, at_apex.value + w.slack);
  if (at_apex.value > run.radius && ends_here(part, f, k, w)) return;
  if (run.merges() && is_seen(at_apex)) part.vertices.expect(apex, at_apex.value, w.lift);
  // The key is the arrival at the far corner: by then everything that enters over the edge has come.
  EventQueue& queue = part.activity->queue;
  const std::int64_t bucket = queue.bucket_of(to_double(at_apex.value));
  if (part.activity->windows.push(f.waiting, h, w, bucket)) queue.push_list_into(bucket, h);
}

// A window is about to enter the face of h: unless it is of no use, it waits there.
[[gnu::always_inline]] inline void enter_face(PartState& part, Index h, const Window& w, Origin origin) {
  if (!part.is_here(h / 3)) return send(part, h, w, origin);
  WindowFace& f = part.face(h);
  const Index k = h % 3;
  // One branch to guess, not three.
  if (is_sliver(w) | (least_value(w) > part.run->radius) |
      is_dominated(part.vertices.bounds(f, k), w.b0, w.b1, w.d0, w.d1)) {
    return;
  }
  if (goes_in_lists(part, h)) return is_on_edge(w) ? pass_at_once(part, h, w) : enter_list(part, h, w, origin);
  if (leaves_trail(f)) return enter_after_trail(part, h, w);
  wait(part, f, h, w);
}

[[gnu::always_inline]] inline void leave_face(PartState& part, Index h, const Window& w, Origin origin) {
  const WindowFace& f = part.face(h);
  if (f.beyond[h % 3] == Beyond::Face) return enter_face(part, f.opposite[h % 3], w, origin);
  if (f.beyond[h % 3] == Beyond::Several) leave_into_several(part, h, w);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
