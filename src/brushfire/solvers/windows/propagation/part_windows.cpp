// Windows that travel one by one: into a face, trimmed and merged there, and out over the other two edges.
#include <brushfire/solvers/windows/algebra/propagate.h>
#include <brushfire/solvers/windows/algebra/sweep.h>
#include <brushfire/solvers/windows/propagation/part.h>

#include <algorithm>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// A source nearer to a corner of its face than this share of the face's longest edge makes the corner send light in all
// directions: limit rays through the corner are known to epsilon / share only.
constexpr double kNear = 1e-3 * kFiner;

}  // namespace

// Until the turn of its halfedge, in the face of h.
[[gnu::always_inline]] inline void Part::wait(WindowFace& f, Index h, const Window& w) {
  const Index k = h % 3;
  const Arrival at_apex = arrival(w, frame_of(f, k).apex);
  const Index apex = f.vertex[previous3(k)];
  reach(apex, at_apex.value + w.slack);
  if (at_apex.value > run_->radius && ends_here(f, k, w)) return;
  if (run_->merges() && at_apex.detour <= kSeen * at_apex.value) expect(apex, at_apex.value, w.lift);
  // The key is the arrival at the far corner: by then everything that enters over the edge has come.
  EventQueue& queue = traffic_->queue;
  const std::int64_t turn = queue.turn_of(to_double(at_apex.value));
  if (traffic_->windows.push(f.waiting, h, w, turn)) queue.push_list(h, to_double(at_apex.value), turn);
}

// A window is about to enter the face of h: unless it is of no use, it waits there for its turn.
[[gnu::always_inline]] inline void Part::insert(Index h, const Window& w, Origin origin) {
  if (!is_here(h / 3)) return send(h, w, origin);
  WindowFace& f = run_->structure.faces[h / 3];
  const Index k = h % 3;
  // One branch to guess, not three.
  if (is_sliver(w) | (least_value(w) > run_->radius) | is_dominated(bounds_of(f, k), w.b0, w.b1, w.d0, w.d1)) return;
  if (goes_in_lists(h)) return is_on_edge(w) ? pass_at_once(h, w) : insert_into_list(h, w, origin);
  if (leaves_trail(f)) return insert_after_trail(h, w);
  wait(f, h, w);
}
void Part::insert_one(Index h, const Window& w, Origin origin) { insert(h, w, origin); }

// What is new of it.
void Part::insert_after_trail(Index h, Window w) {
  WindowFace& f = run_->structure.faces[h / 3];
  if (f.double_area > 0 && trails_.has_been(w.trail, h / 3)) return;
  if (!f.thin || memory_.learn(h, w)) wait(f, h, w);
}

// To another part.
void Part::send(Index h, const Window& w, Origin origin) {
  if (is_sliver(w) || least_value(w) > run_->radius) return;
  send_label(run_->structure.part_of_face(h / 3), w.root);
  traffic_->outbox.windows.push_back({h, origin, w});
  traffic_->outbox.windows.back().window.trail = kNoIndex;  // a trail is known in its part only
}

// A window leaves a face over its halfedge h; it is described from beyond, from the end of h to its start.
[[gnu::always_inline]] inline void Part::cross_edge(Index h, const Window& w, Origin origin) {
  const WindowFace& f = face(h);
  if (f.beyond[h % 3] == Beyond::Face) return insert(f.opposite[h % 3], w, origin);
  if (f.beyond[h % 3] == Beyond::Several) insert_into_all(h, w);
}
void Part::cross_edge_one(Index h, const Window& w) { cross_edge(h, w); }

// L10. In the frame from the end of h to its start. False where nothing of the window is needed beyond the spine.
bool Part::pass_spine(Index h, Window& w) {
  const WindowFace& f = face(h);
  const Index start = f.vertex[h % 3], end = f.vertex[next3(h % 3)];
  const EdgeBounds seen = bounds_of(f, h % 3);
  if (is_sliver(w) || least_value(w) > run_->radius) return false;
  if (is_dominated({seen.length, seen.end, seen.start}, w.b0, w.b1, w.d0, w.d1)) return false;
  const Index label = run_->several ? label_of(w.root) : 0;
  if (end < start) return spines_.learn(end, start, w, label);
  Window turned = mirrored(w, seen.length);
  if (!spines_.learn(start, end, turned, label)) return false;
  if (turned.b0 > 0 || turned.b1 < seen.length) w = mirrored(turned, seen.length);
  return true;
}

// Other parts are told once each: they see to their faces.
void Part::insert_into_all(Index h, const Window& window) {
  Window w = window;
  if (run_->structure.is_spine(h) && !pass_spine(h, w)) return;
  const WindowFace& f = run_->structure.faces[h / 3];
  const Index end = f.vertex[next3(h % 3)];
  Index told = number_;
  for (Index g = f.opposite[h % 3]; g != h; g = run_->structure.faces[g / 3].opposite[g % 3]) {
    const Index part = run_->structure.part_of_face(g / 3);
    if (part != number_ && std::exchange(told, part) == part) continue;
    const bool usual = run_->structure.is_same(run_->structure.faces[g / 3].vertex[g % 3], end);
    insert_one(g, usual ? w : mirrored(w, f.length[h % 3]), Origin::Anywhere);
  }
}

// From another part, over a spine: into the face of h and the others in this part, which follow in the ring.
void Part::insert_into_rest(Index h, const Window& window) {
  const WindowFace& f = run_->structure.faces[h / 3];
  Window w = mirrored(window, f.length[h % 3]);
  if (!pass_spine(h, w)) return;
  const Index end = f.vertex[next3(h % 3)];
  Index g = h;
  do {
    const bool usual = run_->structure.faces[g / 3].vertex[g % 3] == end;
    insert_one(g, usual ? w : mirrored(w, f.length[h % 3]), Origin::Anywhere);
    g = run_->structure.faces[g / 3].opposite[g % 3];
  } while (g != h && is_here(g / 3));
}

void Part::insert_into_list(Index h, const Window& w, Origin origin) {
  WindowFace& f = run_->structure.faces[h / 3];
  traffic_->lists.put(f.waiting, h, origin, w, bench_->blocks);
  queue_list(f, h, std::min({w.d0, w.d1, nearer_end(f, h % 3)}));
}
// Whether a window whose apex is beyond the radius has nothing to tell anyone behind the face.
bool Part::ends_here(const WindowFace& f, Index k, const Window& w) const {
  if (minimum_of(w) > run_->radius) return true;
  return !f.has_target && !run_->problem->options->keep_windows && ends_in_face(w, frame_of(f, k), run_->radius);
}
// Where the source lies on the edge: lists are for windows that can be trimmed (see set_apart()).
void Part::pass_at_once(Index h, const Window& w) { pass(h, frame_of(run_->structure.faces[h / 3], h % 3), w); }

// The turn of a list: trimmed (L5), merged (L2), and on to the other two edges.
void Part::spread(Index h) {
  WindowFace& f = run_->structure.faces[h / 3];
  const Index k = h % 3;
  bench_->taken.clear();
  traffic_->windows.take(f.waiting, h, [&](const Window& w) {
    if (!((least_value(w) > run_->radius) | is_dominated(bounds_of(f, k), w.b0, w.b1, w.d0, w.d1)))
      bench_->taken.push_back(w);
  });
  if (bench_->taken.empty()) return;
  const Frame frame = frame_of(f, k);
  std::span<Window> windows = bench_->taken;
  if (windows.size() > 1 && std::any_of(windows.begin(), windows.end(), is_on_edge)) windows = set_apart(windows);
  if (windows.size() > 1) windows = run_->merges() ? merged(windows) : bench_->envelope(windows);
  for (const Window& w : windows) pass(h, frame, w);
  for (const Window& w : bench_->on_edge) pass(h, frame, w);
  bench_->on_edge.clear();
}

// L5. Windows with their source on the edge are not trimmed (all their light passes through that one point, where
// others may tie with them): they go on whole unless another path to the source itself is shorter. Returns the
// others.
std::span<Window> Part::set_apart(std::span<Window> windows) {
  const auto others = std::stable_partition(windows.begin(), windows.end(), is_on_edge);
  for (auto w = windows.begin(); w != others; ++w) {
    const Real x = w->source.x;
    const bool beaten = std::any_of(windows.begin(), windows.end(), [&](const Window& o) {
      return o.b0 <= x && x <= o.b1 && value_at(o, x) - w->source.y < w->sigma - tie(w->sigma);
    });
    if (!beaten) bench_->on_edge.push_back(*w);
  }
  return {others, windows.end()};
}

// L2, L5, L8: what is left of the windows of an edge.
std::span<Window> Part::merged(std::span<Window> windows) {
  constexpr std::size_t kFew = 8;  // more are sorted by the envelope
  if (windows.size() <= kFew) {
    for (std::size_t i = 1; i < windows.size(); ++i) {
      for (std::size_t j = i; j > 0 && windows[j].b0 < windows[j - 1].b0; --j) std::swap(windows[j], windows[j - 1]);
    }
    Sweep sweep(windows, [this](const Window& a, Window& b, const Joint& joint) { return merge_pair(a, b, joint); });
    const bool done = sweep();
    windows = windows.first(sweep.count());
    if (done) return windows;
  }
  windows = bench_->envelope(windows);
  return windows.first(merge_neighbours(windows));
}

// ---- merging

// L2, L8. From left to right, each with the one before it as long as that works. Returns how many are left.
std::size_t Part::merge_neighbours(std::span<Window> w) const {
  std::size_t last = 0;
  for (std::size_t i = 1; i < w.size(); ++i) {
    w[++last] = w[i];
    while (last > 0 && w[last].b0 - w[last - 1].b1 <= 2 * kSliver * (w[last].d0 - w[last].sigma) &&
           merge_pair(w[last - 1], w[last], {w[last - 1].b1, w[last - 1].d1, w[last].d0})) {
      w[last - 1] = w[last];
      --last;
    }
  }
  return w.empty() ? 0 : last + 1;
}

// Light of different sources stays apart, so that labels do.
bool Part::merge_pair(const Window& a, Window& b, const Joint& joint) const {
  if (run_->problem->sources.size() == 1) return merge_into(a, b, joint, run_->start_of(0), run_->budget);
  const Index label = label_of(a.root);
  return label == label_of(b.root) && merge_into(a, b, joint, run_->start_of(label), run_->budget);
}

// ---- from edge to edge

void Part::pass(Index h, const Frame& frame, const Window& waiting) {
  Window w = waiting;
  w.kind = WindowKind::Circular;  // known here: no other kind is ever started
  const WindowFace& f = run_->structure.faces[h / 3];
  const Index apex = f.vertex[previous3(h % 3)];
  if (leaves_trail(f)) w.trail = trails_.with(w.trail, h / 3);
  const Ray ray{w.source, h, w.root, w.kind};
  const Arrival at = arrival(w, frame.apex);
  if (at.detour <= kSeen * at.value) {
    reach(apex, at.value + w.slack);
    offer(apex, at.value, ray, false);
  }
  if (f.has_target) {
    run_->targets.for_each_in(h / 3, [&](const TargetInFace& t) {
      const Arrival there = arrival(w, in_frame(frame, h % 3, t.weights));
      offer_target(t.target, there.value, w.slack, w.lift, ray, there.detour <= kSeen * there.value);
    });
  }
  if (run_->problem->options->keep_windows) kept_.push_back({run_->structure.outer_halfedge(h), w});
  if (frame.apex.y == 0 && w.source.y == 0) return pass_along(h, frame, w);
  const Division d = divide(w, frame.apex);
  const Real apex_value = straight_value(w, frame.apex);
  if (d.lit_left() && frame.left > 0) {
    const Window l = left_child(w, frame, d, apex_value);
    if (is_lit(l)) cross_edge(3 * (h / 3) + previous3(h % 3), l);
  }
  if (d.lit_right() && frame.right > 0) {
    const Window r = right_child(w, frame, d, apex_value);
    if (is_lit(r)) cross_edge(3 * (h / 3) + next3(h % 3), r);
  }
}

// Light from a point on the edge of a face without area: the point lies on another edge as well.
void Part::pass_along(Index h, const Frame& frame, const Window& w) {
  const Index face = 3 * (h / 3), k = h % 3;
  const Real apex = frame.apex.x, x = w.source.x;
  Window out = w;
  out.b0 = 0;
  const auto send = [&](Index edge, Real length, Real from_start) {
    out.source = {from_start, 0};
    out.b1 = length;
    out.d0 = value_at(out, 0);
    out.d1 = value_at(out, length);
    if (is_lit(out)) cross_edge(face + edge, out);
  };
  send(previous3(k), frame.left, apex > 0 ? x : -x);
  send(next3(k), frame.right, apex < frame.length ? x - apex : apex - x);
}

// ---- vertices as sources

// L6. Light goes on from v: into its shadow, or everywhere; here into the faces of this part, and from v's copies into
// the others.
void Part::shine(Index v) {
  VertexLight& light = run_->light[v];
  light.waiting = false;
  if (run_->values[v].lower > run_->radius) return;
  if (light.all_around || run_->structure.bend[v] == Bend::Full || light.halfedge == kNoIndex) {
    for (const Index h : run_->structure.corners_of(v, number_, bench_->corners)) shine_through(v, h);
    return;
  }
  if (run_->structure.bend[v] == Bend::Fans) {
    const std::span<const Index> corners = run_->structure.corners_of(v, bench_->corners);
    for (const Sector& sector : bench_->link(run_->structure, corners, light.from())) {
      if (is_here(sector.face)) shine_into(v, sector);
    }
    return;
  }
  for_each_shadow(run_->structure, v, light.from(), [&](const Sector& sector) {
    if (is_here(sector.face)) shine_into(v, sector);
  });
}

void Part::shine_through(Index v, Index corner) {
  const Index face = corner / 3, i = corner % 3;
  const WindowFace& f = run_->structure.faces[face];
  if (f.usable) {
    shine_into(v, whole_sector(f, face, i));
    return;
  }
  for (const Index j : {next3(i), previous3(i)}) {
    if (f.vertex[j] == v) continue;
    const Real value = run_->values[v].lower + f.length[j == next3(i) ? i : j];
    reach(f.vertex[j], value + slack_of(v));
    expect(f.vertex[j], value, lift_of(v));
    offer(f.vertex[j], value, {{}, kNoIndex, v, WindowKind::Circular}, false);
  }
}

Real Part::slack_of(Index v) const { return std::max(Real{0}, run_->values[v].upper - run_->values[v].lower); }
Real Part::lift_of(Index v) const {
  return std::clamp(run_->values[v].estimate - run_->values[v].lower, Real{0}, slack_of(v));
}

// Along the sector's edges to their ends, and through its face.
void Part::shine_into(Index v, Sector sector) {
  const WindowFace& f = run_->structure.faces[sector.face];
  const Index i = sector.corner, near = next3(i), far = previous3(i);
  // Where the corner lies on the opposite edge, an interval there cannot tell directions: all are lit.
  if (f.double_area <= kOnEdge * f.length[near] * f.length[near]) sector = whole_sector(f, sector.face, i);
  if (sector.from_edge()) shine_along(v, sector.face, near, f.length[i]);
  if (sector.to_edge()) shine_along(v, sector.face, far, f.length[far]);
  if (!(f.length[near] > 0)) return;
  Window w = window_of(f, sector, run_->values[v].lower);
  w.slack = slack_of(v);
  w.lift = static_cast<float>(lift_of(v));
  w.root = v;
  if (is_lit(w)) cross_edge(3 * sector.face + near, w, Origin::Apex);
}

// Along the edge from v to corner j of a face that contains both.
void Part::shine_along(Index v, Index face, Index j, Real length) {
  const WindowFace& f = run_->structure.faces[face];
  const Index opposite = next3(j);  // the halfedge opposite of corner j; v is one of its ends
  const Real x = f.vertex[opposite] == v ? 0 : f.length[opposite];
  const Real value = run_->values[v].lower + length;
  reach(f.vertex[j], value + slack_of(v));
  expect(f.vertex[j], value, lift_of(v));
  const bool framed = f.length[opposite] > 0;
  offer(f.vertex[j], value, {{x, 0}, framed ? 3 * face + opposite : kNoIndex, v, WindowKind::Circular}, false);
}

// ---- sources

void Part::start_at_vertex(Index v, Real sigma, Index root) {
  reach(v, sigma);
  expect(v, sigma, 0);
  offer(v, sigma, {{}, kNoIndex, root, WindowKind::Circular}, true);
}

// Straight to the corners, and through the edges that the source does not lie on.
void Part::start_in_face(const FaceWeights& at, Real sigma, Index root, Workbench& bench) {
  bench_ = &bench;
  const WindowFace& f = run_->structure.faces[at.face];
  const std::array<Real, 3> distance = corner_distances_of(run_->structure, at);
  const Real longest = std::max({f.length[0], f.length[1], f.length[2]});
  for (Index k = 0; k < 3; ++k) {
    const Index h = 3 * at.face + next3(k);  // opposite of corner k
    Ray ray{{}, kNoIndex, root, WindowKind::Circular};
    if (f.usable && f.length[next3(k)] > 0) {
      ray.halfedge = h;
      ray.source = in_frame(frame_of(f, next3(k)), next3(k), at.weights);
    }
    const Real value = sigma + distance[k];
    reach(f.vertex[k], value);
    expect(f.vertex[k], value, 0);
    offer(f.vertex[k], value, ray, ray.halfedge == kNoIndex || distance[k] < kNear * longest);
    if (run_->values[f.vertex[k]].lower == value) run_->values[f.vertex[k]].direct = true;
    if (ray.halfedge == kNoIndex) continue;
    Window w;
    w.b1 = f.length[next3(k)];
    w.source = {w.b1 - ray.source.x, -ray.source.y};
    w.sigma = sigma;
    w.d0 = sigma + distance[previous3(k)];
    w.d1 = sigma + distance[next3(k)];
    w.root = root;
    // A source on the edge of a face with an area lights nothing through that edge: the faces beyond start it, too.
    if (is_lit(w) && (w.source.y < 0 || f.double_area == 0)) cross_edge_one(h, w);
  }
  if (!f.has_target) return;
  run_->targets.for_each_in(at.face, [&](const TargetInFace& t) {
    const Index k = f.length[0] > 0 ? 0 : 1;
    if (!(f.length[k] > 0)) return;
    std::array<Real, 3> step;
    for (std::size_t i = 0; i < 3; ++i) step[i] = t.weights[i] - at.weights[i];
    const Vec2 d = in_frame(frame_of(f, k), k, step);
    const Vec2 source = in_frame(frame_of(f, k), k, at.weights);
    offer_target(t.target, sigma + length_of(d.x, d.y), 0, 0, {source, 3 * at.face + k, root, WindowKind::Circular});
  });
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
