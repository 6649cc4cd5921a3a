// Lists from edge to edge.
#include <brushfire/solvers/windows/propagation/window_lists.h>

#include <brushfire/solvers/windows/propagation/arrivals.h>
#include <brushfire/solvers/windows/propagation/sink.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Lists of exact runs are trimmed when their windows have crossed this many faces.
constexpr unsigned kTrimEvery = 8;

inline void offer_apex(PartState& part, Index apex, Real value, const WindowColumns& w, Index i, Index h) {
  part.vertices.reach(apex, value);
  see_vertex(part, apex, value, {w.source(i), h, w.pseudo_source[i], w.kind(i)}, false);
}

// What the list is to the apex. Returns the window that is best there among those that see it, if any.
[[gnu::always_inline]] inline Index reach_apex(PartState& part, Index h, const Frame& frame, const WindowColumns& w,
                                               Index count) {
  const Index apex = part.face(h).vertex[previous3(h % 3)];
  Sight& sight = part.bench->sight;
  Real* const value = sight.value.data();
  const auto sees = [&](Index i) { return sight.left[i] > 0 && sight.right[i] > 0; };
  for (Index i = sight.least; i != kNoIndex; i = least_of(value, count)) {
    if (sees(i)) {
      offer_apex(part, apex, value[i], w, i, h);
      return i;
    }
    // The ray to the apex just misses the window.
    const Window window = w.window(i);
    const Arrival at = arrival(window, frame.apex);
    if (is_seen(at)) offer_apex(part, apex, at.value, w, i, h);
    value[i] = kInfinity;
  }
  // Nobody sees it: paths that bend where the windows next to it end.
  Index right = 0;
  while (right < count && sight.left[right] > 0) ++right;
  const auto bend_around = [&](Index i, Real x) {
    part.vertices.reach(apex, w.value(i, x) + length_of(frame.apex.x - x, frame.apex.y));
  };
  if (right > 0) bend_around(right - 1, w.b1[right - 1]);
  if (right < count) bend_around(right, w.b0[right]);
  return kNoIndex;
}

void reach_targets(PartState& part, Index h, const Frame& frame, const WindowColumns& w, Index count) {
  part.run->targets.for_each_in(h / 3, [&](const TargetInFace& t) {
    const Vec2 p = in_frame(frame, h % 3, t.weights);
    for (Index i = 0; i < count; ++i) {
      const Arrival there = arrival(w.window(i), p);
      reach_target(part, t.target, there.value, 0, 0, {w.source(i), h, w.pseudo_source[i], w.kind(i)}, is_seen(there));
    }
  });
}

void pass_face(PartState& part, Index h, const WindowList& list) {
  const WindowFace& f = part.face(h);
  Workbench& bench = *part.bench;
  const Frame frame = frame_of(f, h % 3);
  const WindowColumns w = list.columns();
  look_at_apex(w, list.size, frame, bench.sight);
  const Index best = reach_apex(part, h, frame, w, list.size);
  if (f.has_target) reach_targets(part, h, frame, w, list.size);
  if (part.run->problem->options->keep_windows) {
    for (Index i = 0; i < list.size; ++i) part.kept.push_back({part.run->structure.outer_halfedge(h), w.window(i)});
  }
  const Index apex = f.vertex[previous3(h % 3)];
  // A list that comes late is on its way out: it is worth trimming.
  const bool late = best != kNoIndex && bench.sight.value[best] > part.vertices[apex].upper / kDominated;
  const unsigned age = late ? kTrimEvery : list.age + 1;
  find_routes(w, list.size, frame, bench.sight, best, bench.routes);
  const Index left = 3 * (h / 3) + previous3(h % 3), right = 3 * (h / 3) + next3(h % 3);
  if (bench.routes.left_end > 0 && leads_on(part, left)) {
    WindowList out{bench.blocks.allocate(bench.routes.left_end), 0, age, true, list.mixed};
    out.size = cross_to_left(w, bench.routes, bench.sight, frame, out.block.columns());
    leave_face(part, left, out, Origin::Start);
  }
  if (bench.routes.right_begin < list.size && leads_on(part, right)) {
    WindowList out{bench.blocks.allocate(list.size - bench.routes.right_begin), 0, age, true, list.mixed};
    out.size = cross_to_right(w, list.size, bench.routes, bench.sight, frame, out.block.columns());
    leave_face(part, right, out, Origin::End);
  }
}

}  // namespace

void propagate_list(PartState& part, Index h) {
  WindowFace& f = part.face(h);
  ExactLists& lists = part.activity->lists;
  Workbench& bench = *part.bench;
  if (lists.empty(f.waiting, h)) return;
  WindowList list = lists.take(f.waiting, h, bench.blocks);
  const RunState& run = *part.run;
  const EdgeBounds edge = part.vertices.bounds(f, h % 3);
  if (list.age >= kTrimEvery || !list.ordered || run.problem->options->keep_windows) {
    bench.trim(list, edge, run.radius, bench.blocks);
  } else if (std::min(edge.start, edge.end) + edge.length > run.radius) {
    // Elsewhere what is beyond the radius is dominated. That goes when the list is trimmed, as without a radius: so
    // both give the same bits.
    bench.trim.drop_useless(list, {edge.length}, run.radius);
  }
  if (list.size > 0) pass_face(part, h, list);
  bench.blocks.release(list.block);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
