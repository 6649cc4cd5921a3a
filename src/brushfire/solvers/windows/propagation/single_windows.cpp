// Trimming and merging of what waits at a halfedge, and its way through the face.
#include <brushfire/solvers/windows/propagation/single_windows.h>

#include <brushfire/solvers/windows/algebra/merge_all.h>
#include <brushfire/solvers/windows/algebra/propagate.h>
#include <brushfire/solvers/windows/algebra/tie_point.h>
#include <brushfire/solvers/windows/propagation/arrivals.h>
#include <brushfire/solvers/windows/propagation/sink.h>

#include <algorithm>
#include <span>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// L5. Windows with their source on the edge are not trimmed (all their light passes through that one point, where
// others may tie with them): they go on whole unless another path to the source itself is shorter, by more than
// rounding: parallel light of the segment that begins there is as short, and goes one way only; and light that passes a
// vertex reads what the vertex does, to the rounding of places on the edge. Returns the others.
std::span<Window> set_apart(std::span<Window> windows, const Rounding& rounding, std::vector<Window>& on_edge) {
  const auto others = std::stable_partition(windows.begin(), windows.end(), is_on_edge);
  for (auto w = windows.begin(); w != others; ++w) {
    const Real x = w->source.x;
    const Real least = w->sigma - tie(w->sigma) - rounding.of(to_double(w->sigma));
    const bool beaten = std::any_of(windows.begin(), windows.end(), [&](const Window& o) {
      return o.b0 <= x && x <= o.b1 &&
             value_at(o, x) - w->source.y < least - (o.kind == WindowKind::Linear ? moved(o) : Real{0});
    });
    if (!beaten) on_edge.push_back(*w);
  }
  return {others, windows.end()};
}

// Light of different sources stays apart, so that labels do.
bool merge_pair(const PartState& part, const Window& a, Window& b, const Joint& joint) {
  const RunState& run = *part.run;
  if (run.problem->sources.size() == 1) return merge_into(a, b, joint, run.start_of(0), run.budget);
  const Index label = part.vertices.label_of(a.pseudo_source);
  return label == part.vertices.label_of(b.pseudo_source) && merge_into(a, b, joint, run.start_of(label), run.budget);
}

// What is left of the windows of an edge.
std::span<Window> merged(PartState& part, std::span<Window> windows) {
  return merge_all(windows, part.bench->envelope,
                   [&part](const Window& a, Window& b, const Joint& joint) { return merge_pair(part, a, b, joint); });
}

void pass_along(PartState& part, Index h, const Frame& frame, const Window& w) {
  const Index face = 3 * (h / 3), k = h % 3;
  propagate_along(
      w, frame, [&](const Window& left) { leave_face(part, face + previous3(k), left, Origin::Anywhere); },
      [&](const Window& right) { leave_face(part, face + next3(k), right, Origin::Anywhere); });
}

// Compiled once for each kind: what is written in terms of kinds costs nothing then.
template <WindowKind kKind>
[[gnu::always_inline]] inline void pass_face_as(PartState& part, Index h, const Frame& frame, const Window& waiting) {
  Window w = waiting;
  w.kind = kKind;
  const WindowFace& f = part.face(h);
  const Index apex = f.vertex[previous3(h % 3)];
  if (leaves_trail(f)) w.trail = part.trails.with(w.trail, h / 3);
  const Ray ray{w.source, h, w.pseudo_source, w.kind};
  const Arrival at = arrival(w, frame.apex);
  if (is_seen(at)) {
    part.vertices.reach(apex, at.value + w.slack);
    see_vertex(part, apex, at.value, ray, false);
  }
  if (f.has_target) {
    part.run->targets.for_each_in(h / 3, [&](const TargetInFace& t) {
      const Arrival there = arrival(w, in_frame(frame, h % 3, t.weights));
      reach_target(part, t.target, there.value, w.slack, w.lift, ray, is_seen(there));
    });
  }
  if (part.run->problem->options->keep_windows) part.kept.push_back({part.run->structure.outer_halfedge(h), w});
  if (frame.apex.y == 0 && w.source.y == 0) return pass_along(part, h, frame, w);
  propagate(
      w, frame, [&](const Window& left) { leave_face(part, 3 * (h / 3) + previous3(h % 3), left, Origin::Anywhere); },
      [&](const Window& right) { leave_face(part, 3 * (h / 3) + next3(h % 3), right, Origin::Anywhere); });
}

[[gnu::noinline]] void pass_face_in_parallel(PartState& part, Index h, const Frame& frame, const Window& w) {
  pass_face_as<WindowKind::Linear>(part, h, frame, w);
}

}  // namespace

void propagate_windows(PartState& part, Index h) {
  WindowFace& f = part.face(h);
  const Index k = h % 3;
  Workbench& bench = *part.bench;
  bench.taken.clear();
  part.activity->windows.take(f.waiting, h, [&](const Window& w) {
    if (!((least_value(w) > part.run->radius) | is_dominated(part.vertices.bounds(f, k), w.b0, w.b1, w.d0, w.d1))) {
      bench.taken.push_back(w);
    }
  });
  if (bench.taken.empty()) return;
  const Frame frame = frame_of(f, k);
  std::span<Window> windows = bench.taken;
  if (windows.size() > 1 && std::any_of(windows.begin(), windows.end(), is_on_edge)) {
    windows = set_apart(windows, part.run->rounding, bench.on_edge);
  }
  const bool merges = part.run->merges() && !f.thin;  // a merged window begins a new trail: see Trails
  if (windows.size() > 1) windows = merges ? merged(part, windows) : bench.envelope(windows);
  for (const Window& w : windows) pass_face(part, h, frame, w);
  for (const Window& w : bench.on_edge) pass_face(part, h, frame, w);
  bench.on_edge.clear();
}

void pass_face(PartState& part, Index h, const Frame& frame, const Window& w) {
  if (w.kind == WindowKind::Linear) return pass_face_in_parallel(part, h, frame, w);
  pass_face_as<WindowKind::Circular>(part, h, frame, w);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
