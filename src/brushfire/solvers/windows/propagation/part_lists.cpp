// Whole lists of windows, of exact runs: trimmed now and then, and on to the other two edges of a face.
#include <brushfire/solvers/windows/algebra/propagate.h>
#include <brushfire/solvers/windows/propagation/part.h>

#include <algorithm>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Lists of exact runs are trimmed when their windows have crossed this many faces.
constexpr unsigned kTrimEvery = 8;

}  // namespace

// The turn of a list: trimmed now and then, and on to the other two edges as a whole.
void Part::spread_list(Index h) {
  WindowFace& f = run_->structure.faces[h / 3];
  const Index k = h % 3;
  if (traffic_->lists.empty(f.waiting, h)) return;
  WindowList list = traffic_->lists.take(f.waiting, h, bench_->blocks);
  if (list.age >= kTrimEvery || !list.ordered || run_->radius < kInfinity || run_->problem->options->keep_windows) {
    bench_->trim(list, bounds_of(f, k), run_->radius, bench_->blocks);
  }
  if (list.size > 0) cross_face(h, list);
  bench_->blocks.release(list.block);
}

inline void Part::offer_apex(Index apex, Real value, const WindowColumns& w, Index i, Index h) {
  reach(apex, value);
  offer(apex, value, {{w.x[i], w.y[i]}, h, w.root[i], WindowKind::Circular}, false);
}

// What the list is to the apex. Returns the window that is best there among those that see it, if any.
inline Index Part::reach_apex(Index h, const Frame& frame, const WindowColumns& w, Index count) {
  const Index apex = run_->structure.faces[h / 3].vertex[previous3(h % 3)];
  Real* const value = bench_->sight.value.data();
  const auto sees = [&](Index i) { return bench_->sight.left[i] > 0 && bench_->sight.right[i] > 0; };
  while (true) {
    const Index i = least_of(value, count);
    if (value[i] == kInfinity) break;
    if (sees(i)) {
      offer_apex(apex, value[i], w, i, h);
      return i;
    }
    // The ray to the apex just misses the window.
    const Window window = w.window(i);
    const Arrival at = arrival(window, frame.apex);
    if (at.detour <= kSeen * at.value) offer_apex(apex, at.value, w, i, h);
    value[i] = kInfinity;
  }
  // Nobody sees it: paths that bend where the windows next to it end.
  Index right = 0;
  while (right < count && bench_->sight.left[right] > 0) ++right;
  const auto bend = [&](Index i, Real x) {
    reach(apex, w.sigma[i] + length_of(x - w.x[i], w.y[i]) + length_of(frame.apex.x - x, frame.apex.y));
  };
  if (right > 0) bend(right - 1, w.b1[right - 1]);
  if (right < count) bend(right, w.b0[right]);
  return kNoIndex;
}

void Part::cross_face(Index h, const WindowList& list) {
  const WindowFace& f = run_->structure.faces[h / 3];
  const Frame frame = frame_of(f, h % 3);
  const WindowColumns w = list.block.columns();
  look_at_apex(w, list.size, frame, bench_->sight);
  const Index best = reach_apex(h, frame, w, list.size);
  if (f.has_target) reach_targets(h, frame, w, list.size);
  if (run_->problem->options->keep_windows) {
    for (Index i = 0; i < list.size; ++i) kept_.push_back({run_->structure.outer_halfedge(h), w.window(i)});
  }
  const Index apex = f.vertex[previous3(h % 3)];
  // A list that comes late is on its way out: it is worth trimming.
  const bool late = best != kNoIndex && bench_->sight.value[best] > run_->values[apex].upper / kDominated;
  const unsigned age = late ? kTrimEvery : list.age + 1;
  find_routes(w, list.size, frame, bench_->sight, best, bench_->routes);
  const Index left = 3 * (h / 3) + previous3(h % 3), right = 3 * (h / 3) + next3(h % 3);
  if (bench_->routes.left_end > 0 && leads_on(left)) {
    WindowList out{bench_->blocks.allocate(bench_->routes.left_end), 0, age, true};
    out.size = cross_to_left(w, bench_->routes, bench_->sight, frame, out.block.columns());
    hand_over(left, out, Origin::Start);
  }
  if (bench_->routes.right_begin < list.size && leads_on(right)) {
    WindowList out{bench_->blocks.allocate(list.size - bench_->routes.right_begin), 0, age, true};
    out.size = cross_to_right(w, list.size, bench_->routes, bench_->sight, frame, out.block.columns());
    hand_over(right, out, Origin::End);
  }
}

void Part::reach_targets(Index h, const Frame& frame, const WindowColumns& w, Index count) {
  run_->targets.for_each_in(h / 3, [&](const TargetInFace& t) {
    const Vec2 p = in_frame(frame, h % 3, t.weights);
    for (Index i = 0; i < count; ++i) {
      const Arrival there = arrival(w.window(i), p);
      offer_target(t.target, there.value, 0, 0, {{w.x[i], w.y[i]}, h, w.root[i], WindowKind::Circular},
                   there.detour <= kSeen * there.value);
    }
  });
}

// To another part.
void Part::send(Index h, const WindowList& list, Origin origin) {
  const WindowColumns w = list.block.columns();
  if (run_->several) {
    for (Index i = 0; i < list.size; ++i) send_label(run_->structure.part_of_face(h / 3), w.root[i]);
  }
  traffic_->outbox.lists.push_back({h, origin, list});
}

// A list leaves a face over its halfedge h.
void Part::hand_over(Index h, const WindowList& list, Origin origin) {
  const WindowFace& f = run_->structure.faces[h / 3];
  const Index beyond = f.opposite[h % 3];
  if (list.size > 0 && f.beyond[h % 3] == Beyond::Face && goes_in_lists(beyond)) {
    if (!is_here(beyond / 3)) return send(beyond, list, origin);
    WindowFace& next = run_->structure.faces[beyond / 3];
    traffic_->lists.put(next.waiting, beyond, origin, list);
    return queue_list(next, beyond, nearer_end(next, beyond % 3));
  }
  const WindowColumns w = list.block.columns();
  for (Index i = 0; i < list.size; ++i) cross_edge_one(h, w.window(i));
  bench_->blocks.release(list.block);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
