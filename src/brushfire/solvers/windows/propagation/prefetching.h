// What is fetched ahead while a part is at work, and how early: the one place that decides it.
#pragma once

#include <brushfire/solvers/windows/propagation/part_state.h>
#include <brushfire/solvers/windows/store/prefetch.h>

#include <cstddef>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Events come in an order that has little to do with where things lie in memory, but it is known for some way ahead.
// What an event reads is fetched in steps, each of which needs what the one before it fetched.
class Prefetching {
 public:
  explicit Prefetching(const PartState& part) : part_(part), queue_(part.activity->queue) {}

  // The first events of a round: nothing has been fetched ahead for them.
  void first() const {
    for (std::size_t i = 0; i < kFacesAhead; ++i) fetch_face(queue_.peek_list(i));
    for (std::size_t i = 0; i < kAroundAhead; ++i) fetch_around(queue_.peek_list(i));
    for (std::size_t i = 0; i < kWindowsAhead; ++i) fetch_windows(queue_.peek_list(i));
  }
  // While windows or a list are propagated: the faces of later ones; then their windows and the faces beyond; then the
  // vertices there.
  [[gnu::always_inline]] void next_lists() const {
    fetch_face(queue_.peek_list(kFacesAhead));
    fetch_around(queue_.peek_list(kAroundAhead));
    fetch_windows(queue_.peek_list(kWindowsAhead));
  }
  // While windows go on from a vertex: what later ones know of their light, the face that it came through, and the
  // faces around.
  [[gnu::always_inline]] void next_vertices() const {
    if (part_.run->in_lists) return;  // exact runs gain nothing by it
    if (const Index v = queue_.peek_vertex(kLightAhead); v != kNoIndex) {
      prefetch(part_.vertices.place_of_pseudo_source(v));
      prefetch(part_.vertices.place_of_values(v));
    }
    if (const Index v = queue_.peek_vertex(kArrivalAhead); v != kNoIndex)
      fetch_face(part_.vertices.pseudo_source(v).halfedge);
    for (std::size_t steps = 0; steps < kFanSteps; ++steps) {
      const Index v = queue_.peek_vertex(kFanAhead - steps);
      if (v != kNoIndex) fetch_fan(v, steps);
    }
  }

 private:
  // How many events ahead each step is.
  static constexpr std::size_t kFacesAhead = 6, kAroundAhead = 3, kWindowsAhead = 1;
  static constexpr std::size_t kLightAhead = 8, kArrivalAhead = 6, kFanAhead = 4, kFanSteps = 4;

  [[gnu::always_inline]] void fetch_face(Index h) const {
    if (h != kNoIndex) prefetch(&part_.face(h));
  }
  [[gnu::always_inline]] void fetch_around(Index h) const {
    if (h == kNoIndex) return;
    const WindowFace& f = part_.face(h);
    if (part_.run->in_lists) {
      const Index apex = f.vertex[previous3(h % 3)];
      if (!f.thin) part_.activity->lists.prefetch_list(f.waiting);
      prefetch(part_.vertices.place_of_values(apex));
      prefetch(part_.vertices.place_of_pseudo_source(apex));
    } else {
      part_.activity->windows.prefetch_list(f.waiting);
    }
    prefetch(&part_.face(f.opposite[next3(h % 3)]));
    prefetch(&part_.face(f.opposite[previous3(h % 3)]));
  }
  [[gnu::always_inline]] void fetch_windows(Index h) const {
    if (h == kNoIndex) return;
    const WindowFace& f = part_.face(h);
    if (part_.run->in_lists) {
      if (!f.thin) part_.activity->lists.prefetch_windows(f.waiting);
      return;
    }
    fetch_apex(f.opposite[next3(h % 3)]);
    fetch_apex(f.opposite[previous3(h % 3)]);
  }
  [[gnu::always_inline]] void fetch_apex(Index h) const {
    prefetch(part_.vertices.place_of_values(part_.face(h).vertex[previous3(h % 3)]));
  }
  // A shadow is found by going from face to face round the vertex, on both sides of the face that the light came
  // through.
  [[gnu::always_inline]] void fetch_fan(Index v, std::size_t steps) const {
    const Index h = part_.vertices.pseudo_source(v).halfedge;
    if (h == kNoIndex) return;
    const Index start = h / 3, corner = previous3(h % 3);
    for (Index exit : {3 * start + corner, 3 * start + previous3(corner)}) {
      FanFace at;
      for (std::size_t i = 0; i < steps; ++i) {
        if (!next_in_fan(part_.run->structure, v, start, exit, at)) break;
        exit = at.exit();
        // Light leaves the faces opposite of where it came from.
        if (i > 0 && i + 1 == steps) prefetch(&part_.face(part_.face(exit).opposite[next3(at.corner)]));
      }
      prefetch(&part_.face(part_.face(exit).opposite[exit % 3]));
    }
  }

  const PartState& part_;
  const EventQueue& queue_;
};

// Messages come to places that have not been touched for a while: all are fetched at once.
inline void prefetch_receivers(const RunState& run, const Outbox& messages) {
  for (const FallenMessage& m : messages.all<FallenMessage>()) prefetch(&run.values[run.values[m.vertex].next_ghost]);
  for (const WindowMessage& m : messages.all<WindowMessage>()) prefetch(&run.structure.faces[m.halfedge / 3]);
  for (const ListMessage& m : messages.all<ListMessage>()) prefetch(&run.structure.faces[m.halfedge / 3]);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
