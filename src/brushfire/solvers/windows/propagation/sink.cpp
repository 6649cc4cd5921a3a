// What happens seldom to windows on their way: other parts, lists, thin faces, edges of three faces and more.
#include <brushfire/solvers/windows/propagation/sink.h>

#include <brushfire/solvers/windows/propagation/arrivals.h>
#include <brushfire/solvers/windows/propagation/single_windows.h>

#include <algorithm>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

[[gnu::noinline]] void enter_face_once(PartState& part, Index h, const Window& w, Origin origin) {
  enter_face(part, h, w, origin);
}

[[gnu::always_inline]] inline void queue_list(PartState& part, WindowFace& f, Index h, Real key) {
  EventQueue& queue = part.activity->queue;
  Real& queued = part.activity->lists.key(f.waiting, h);
  if (key < queued && !(queued < kInfinity && queue.same_bucket(to_double(key), to_double(queued)))) {
    queue.push_list(h, to_double(key));
  }
  queued = std::min(queued, key);
}

// The key of lists is what is known of the nearer end of the edge: nearly all that enters over the edge has come by
// then.
[[gnu::always_inline]] inline void wait(PartState& part, Index h, const WindowList& list, Origin origin) {
  WindowFace& f = part.face(h);
  part.activity->lists.put(f.waiting, h, origin, list);
  queue_list(part, f, h, part.vertices.nearer_end(f, h % 3));
}

// L10. In the frame from the end of h to its start. False where nothing of the window is needed beyond the spine.
bool pass_spine(PartState& part, Index h, Window& w) {
  const WindowFace& f = part.face(h);
  const Index start = f.vertex[h % 3], end = f.vertex[next3(h % 3)];
  const EdgeBounds seen = part.vertices.bounds(f, h % 3);
  if (is_sliver(w) || least_value(w) > part.run->radius) return false;
  if (is_dominated({seen.length, seen.end, seen.start}, w.b0, w.b1, w.d0, w.d1)) return false;
  const Index label = part.run->several ? part.vertices.label_of(w.pseudo_source) : 0;
  if (end < start) return part.spines.learn(end, start, w, label);
  Window turned = mirrored(w, seen.length);
  if (!part.spines.learn(start, end, turned, label)) return false;
  if (turned.b0 > 0 || turned.b1 < seen.length) w = mirrored(turned, seen.length);
  return true;
}

// From another part, over a spine: into the face of h and the others in this part, which follow in the ring.
void enter_over_spine(PartState& part, Index h, const Window& window) {
  const WindowFace& f = part.face(h);
  Window w = mirrored(window, f.length[h % 3]);
  if (!pass_spine(part, h, w)) return;
  const Index end = f.vertex[next3(h % 3)];
  Index g = h;
  do {
    const bool usual = part.face(g).vertex[g % 3] == end;
    enter_face_once(part, g, usual ? w : mirrored(w, f.length[h % 3]), Origin::Anywhere);
    g = part.face(g).opposite[g % 3];
  } while (g != h && part.is_here(g / 3));
}

void send(PartState& part, Index h, const WindowList& list, Origin origin) {
  const WindowColumns w = list.columns();
  if (part.run->several) {
    const Index to = part.run->structure.part_of_face(h / 3);
    for (Index i = 0; i < list.size; ++i) send_label(part, to, w.pseudo_source[i]);
  }
  part.activity->outbox.send(ListMessage{h, origin, list});
}

}  // namespace

void leave_face_once(PartState& part, Index h, const Window& w) { leave_face(part, h, w, Origin::Anywhere); }

void receive(PartState& part, const WindowMessage& message) {
  if (part.run->structure.is_spine(message.halfedge)) return enter_over_spine(part, message.halfedge, message.window);
  enter_face_once(part, message.halfedge, message.window, message.origin);
}

void receive(PartState& part, const ListMessage& message) {
  wait(part, message.halfedge, message.list, message.origin);
}

// To another part.
void send(PartState& part, Index h, const Window& w, Origin origin) {
  if (is_sliver(w) || least_value(w) > part.run->radius) return;
  send_label(part, part.run->structure.part_of_face(h / 3), w.pseudo_source);
  WindowMessage message{h, origin, w};
  message.window.trail = kNoIndex;  // a trail is known in its part only
  part.activity->outbox.send(message);
}

// Other parts are told once each: they see to their faces.
void leave_into_several(PartState& part, Index h, const Window& window) {
  const WindowStructure& structure = part.run->structure;
  Window w = window;
  if (structure.is_spine(h) && !pass_spine(part, h, w)) return;
  const WindowFace& f = part.face(h);
  const Index end = f.vertex[next3(h % 3)];
  Index told = part.number;
  for (Index g = f.opposite[h % 3]; g != h; g = part.face(g).opposite[g % 3]) {
    const Index to = structure.part_of_face(g / 3);
    if (to != part.number && std::exchange(told, to) == to) continue;
    const bool usual = structure.is_same(part.face(g).vertex[g % 3], end);
    enter_face_once(part, g, usual ? w : mirrored(w, f.length[h % 3]), Origin::Anywhere);
  }
}

void enter_list(PartState& part, Index h, const Window& w, Origin origin) {
  WindowFace& f = part.face(h);
  part.activity->lists.put(f.waiting, h, origin, w, part.bench->blocks);
  queue_list(part, f, h, std::min({w.d0, w.d1, part.vertices.nearer_end(f, h % 3)}));
}

// What is new of it; where hundreds of faces meet, carried to the last of them that it crosses.
void enter_after_trail(PartState& part, Index h, Window w) {
  WindowFace& f = part.face(h);
  if (f.double_area > 0 && part.trails.has_been(w.trail, h / 3)) return;
  if (f.thin && !part.memory.learn(h, w)) return;
  if (f.thin && !part.run->structure.wheels.empty() && !part.run->problem->options->keep_windows) {
    const Index later = part.run->structure.wheels.carry(h, w);
    if (later != h) {
      w.trail = part.trails.with(w.trail, h / 3);
      return enter_face_once(part, later, w, Origin::Anywhere);
    }
  }
  wait(part, f, h, w);
}

// Where the source lies on the edge: lists are for windows that can be trimmed.
void pass_at_once(PartState& part, Index h, const Window& w) { pass_face(part, h, frame_of(part.face(h), h % 3), w); }

// Whether a window whose apex is beyond the radius has nothing to tell anyone behind the face.
bool ends_here(const PartState& part, const WindowFace& f, Index k, const Window& w) {
  if (minimum_of(w) > part.run->radius) return true;
  return !f.has_target && !part.run->problem->options->keep_windows &&
         ends_in_face(w, frame_of(f, k), part.run->radius);
}

void leave_face(PartState& part, Index h, const WindowList& list, Origin origin) {
  const WindowFace& f = part.face(h);
  const Index beyond = f.opposite[h % 3];
  if (list.size > 0 && f.beyond[h % 3] == Beyond::Face && goes_in_lists(part, beyond)) {
    return part.is_here(beyond / 3) ? wait(part, beyond, list, origin) : send(part, beyond, list, origin);
  }
  const WindowColumns w = list.columns();
  for (Index i = 0; i < list.size; ++i) leave_face_once(part, h, w.window(i));
  part.bench->blocks.release(list.block);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
