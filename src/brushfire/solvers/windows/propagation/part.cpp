// The turn of a part, what becomes of its vertices, and its mail.
#include <brushfire/solvers/windows/propagation/part.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/windows/store/prefetch.h>

#include <algorithm>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// How many events ahead each step of prefetching is.
constexpr std::size_t kFacesAhead = 6, kAroundAhead = 3, kWindowsAhead = 1;
// Of vertices that send light: what they know of it, the face that it came through, and the faces around.
constexpr std::size_t kLightAhead = 8, kArrivalAhead = 6, kFanAhead = 4, kFanSteps = 4;

}  // namespace

void Part::activate(std::unique_ptr<Traffic> traffic, std::int64_t turn) {
  traffic_ = std::move(traffic);
  traffic_->queue.reset(run_->bucket_width, turn);
}

void Part::forget() {
  for_each_touched([&](Index v) {
    run_->values[v].forget();
    run_->light[v] = {};
    if (!run_->origins.empty()) run_->origins[v] = {};
    if (!run_->rays.empty()) run_->rays[v] = {};
  });
  touched_ = 0;
  updates_ = 0;
  memory_.clear();
  trails_.clear();
  spines_.clear();
  kept_.clear();
  labels_.clear();
  if (!traffic_) return;
  // The run was stopped.
  for (WindowFace& f : run_->structure.faces_of(number_)) f.waiting = kNoIndex;
  for (const Index v : traffic_->outbox.news) run_->values[v].sent = false;
  traffic_->queue.reset(1, 0);
  traffic_->windows.clear();
  traffic_->lists.clear();
  traffic_->outbox.clear();
  traffic_->news.clear();
}

// What the next lists will read is fetched in three steps, each of which needs what the one before it fetched: their
// faces; then their windows and the faces beyond; then the vertices there.
inline void Part::prefetch_face(Index h) const {
  if (h != kNoIndex) prefetch(&face(h));
}

inline void Part::prefetch_around(Index h) const {
  if (h == kNoIndex) return;
  const WindowFace& f = face(h);
  if (run_->in_lists) {
    const Index apex = f.vertex[previous3(h % 3)];
    if (!f.thin) traffic_->lists.prefetch_list(f.waiting);
    prefetch(&run_->values[apex]);
    prefetch(&run_->light[apex]);
  } else {
    traffic_->windows.prefetch_list(f.waiting);
  }
  prefetch(&face(f.opposite[next3(h % 3)]));
  prefetch(&face(f.opposite[previous3(h % 3)]));
}

inline void Part::prefetch_windows(Index h) const {
  if (h == kNoIndex) return;
  const WindowFace& f = face(h);
  if (run_->in_lists) {
    if (!f.thin) traffic_->lists.prefetch_windows(f.waiting);
    return;
  }
  const auto prefetch_apex = [&](Index g) { prefetch(&run_->values[face(g).vertex[previous3(g % 3)]]); };
  prefetch_apex(f.opposite[next3(h % 3)]);
  prefetch_apex(f.opposite[previous3(h % 3)]);
}

inline void Part::prefetch_next() const {
  const EventQueue& queue = traffic_->queue;
  prefetch_face(queue.peek_list(kFacesAhead));
  prefetch_around(queue.peek_list(kAroundAhead));
  prefetch_windows(queue.peek_list(kWindowsAhead));
}

// The first ones of a round: nobody has looked ahead to them.
void Part::prefetch_first() const {
  const EventQueue& queue = traffic_->queue;
  for (std::size_t i = 0; i < kFacesAhead; ++i) prefetch_face(queue.peek_list(i));
  for (std::size_t i = 0; i < kAroundAhead; ++i) prefetch_around(queue.peek_list(i));
  for (std::size_t i = 0; i < kWindowsAhead; ++i) prefetch_windows(queue.peek_list(i));
}

// A shadow is found by going from face to face round the vertex, on both sides of the face that the light came through.
inline void Part::prefetch_fan(Index v, std::size_t steps) const {
  const Index h = run_->light[v].halfedge;
  if (h == kNoIndex) return;
  const Index start = h / 3, corner = previous3(h % 3);
  for (Index exit : {3 * start + corner, 3 * start + previous3(corner)}) {
    FanFace at;
    for (std::size_t i = 0; i < steps; ++i) {
      if (!next_in_fan(run_->structure, v, start, exit, at)) break;
      exit = at.exit();
      // Light leaves the faces opposite of where it came from.
      if (i > 0 && i + 1 == steps) prefetch(&face(face(exit).opposite[next3(at.corner)]));
    }
    prefetch(&face(face(exit).opposite[exit % 3]));
  }
}

inline void Part::prefetch_next_vertices() const {
  const EventQueue& queue = traffic_->queue;
  if (const Index v = queue.peek_vertex(kLightAhead); v != kNoIndex) {
    prefetch(&run_->light[v]);
    prefetch(&run_->values[v]);
  }
  if (const Index v = queue.peek_vertex(kArrivalAhead); v != kNoIndex) {
    const Index h = run_->light[v].halfedge;
    if (h != kNoIndex) prefetch(&face(h));
  }
  for (std::size_t steps = 0; steps < kFanSteps; ++steps) {
    const Index v = queue.peek_vertex(kFanAhead - steps);
    if (v != kNoIndex) prefetch_fan(v, steps);
  }
}

void Part::work(std::int64_t last, Workbench& bench) {
  constexpr std::uint64_t kPoll = 1024;
  bench_ = &bench;
  EventQueue::Event event;
  traffic_->queue.advance_to(last);
  prefetch_first();
  while (traffic_->queue.pop(last, event)) {
    if (++updates_ % kPoll == 0) poll();
    if (event.is_list) {
      prefetch_next();
      if (goes_in_lists(event.index)) {
        spread_list(event.index);
      } else {
        spread(event.index);
      }
    } else {
      if (!run_->in_lists) prefetch_next_vertices();  // exact runs gain nothing by it
      if (run_->light[event.index].waiting) shine(event.index);
    }
  }
  send_news();
}

void Part::poll() const {
  const CancelToken* cancel = run_->problem->cancel;
  if (cancel && cancel->cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
}

// ---- vertices and targets

Index Part::label_of(Index root) const {
  const Index n = run_->structure.vertex_count();
  if (root >= n) return root - n;
  if (!run_->several) return 0;
  return first_ <= root && root < last_ ? run_->origins[root].label : labels_.at(root);
}

void Part::accept(Index v, Real value, const Ray& ray, bool all_around) {
  if (!take(v, value, ray, all_around)) return;
  for (Index c = run_->values[v].next_copy; c != v && c != kNoIndex; c = run_->values[c].next_copy) {
    send_label(run_->structure.part_of_vertex(c), ray.root);
    traffic_->outbox.offers.push_back({c, value, ray, all_around});
  }
}

// False where it is nothing new.
bool Part::take(Index v, Real value, const Ray& ray, bool all_around) {
  Real& least = run_->values[v].lower;
  const Real before = least;
  const bool lower = value < before;
  if (!lower && (!run_->several || value > before || label_of(ray.root) >= run_->origins[v].label)) return false;
  least = value;
  run_->values[v].direct = false;
  if (run_->several) run_->origins[v] = {ray.root, label_of(ray.root)};
  if (!run_->rays.empty()) run_->rays[v] = ray;
  if (!all_around && run_->structure.bend[v] == Bend::None) return true;
  VertexLight& light = run_->light[v];
  const bool queued = light.waiting && traffic_->queue.same_bucket(to_double(before), to_double(value));
  light.came_from(crossed_at(run_->structure, ray));
  light.all_around = all_around;
  if (!lower) return true;
  light.waiting = true;
  if (!queued) traffic_->queue.push_vertex(v, to_double(value));
  return true;
}

// Along a ray or, where it is not `straight`, by a detour: a real path, but not one to follow back. Targets may lie on
// an edge between two parts: they are told when all parts have stopped.
void Part::offer_target(Index target, Real value, Real slack, Real lift, const Ray& ray, bool straight) {
  const TargetState& t = run_->targets[target];
  if (value + slack >= t.upper && !(straight && value <= t.lower)) return;
  traffic_->outbox.to_targets.push_back({target, value, slack, lift, ray, straight});
}

// ---- mail

void Part::send_label(Index part, Index root) {
  if (!run_->several || root >= run_->structure.vertex_count()) return;
  std::vector<Mail::Label>& labels = traffic_->outbox.labels;
  if (!labels.empty() && labels.back().part == part && labels.back().root == root) return;
  labels.push_back({part, root, label_of(root)});
}

// All that is known now, as often as it fell in this round.
void Part::send_news() {
  for (const Index v : traffic_->news) {
    if (std::exchange(run_->values[v].sent, true)) continue;
    traffic_->outbox.news.push_back(v);
  }
  traffic_->news.clear();
}

// Of another copy of v.
void Part::hear(Index v, Real upper, Real estimate) {
  VertexValues& at = run_->values[v];
  if (at.upper == kInfinity) touch(v, upper);
  at.upper = std::min(at.upper, upper);
  at.estimate = std::min(at.estimate, estimate);
}

void Part::receive(const Mail::OneWindow& window, Workbench& bench) {
  bench_ = &bench;
  if (run_->structure.is_spine(window.halfedge)) return insert_into_rest(window.halfedge, window.window);
  insert_one(window.halfedge, window.window, window.origin);
}

void Part::receive(const Mail::WholeList& list, Workbench& bench) {
  bench_ = &bench;
  WindowFace& f = run_->structure.faces[list.halfedge / 3];
  traffic_->lists.put(f.waiting, list.halfedge, list.origin, list.list);
  queue_list(f, list.halfedge, nearer_end(f, list.halfedge % 3));
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
