// Windows on their way: they wait at halfedges, are trimmed and merged, cross faces, and refract where weights change.
#include <brushfire/solvers/refraction/detail/run.h>

#include <brushfire/solvers/windows/algebra/dominance.h>
#include <brushfire/solvers/windows/algebra/merge_all.h>
#include <brushfire/solvers/windows/algebra/propagate.h>
#include <brushfire/solvers/windows/store/prefetch.h>

#include <algorithm>
#include <cmath>

namespace brushfire::refraction {

using windows::next3, windows::previous3, windows::WindowFace, windows::WindowKind;

namespace {

// A vertex this little (relative) off a window's limit ray counts as seen, as in solvers/windows/.
constexpr double kSeen = 1e-10;
// A place this little (of what it is computed from) beyond the end of an interval counts as in it: where windows meet,
// rounding must not leave the light of the critical angle to neither. The way by the end itself is a real one.
constexpr double kTouching = 1e-10;
// The part of what is left that one merge may spend (MergeBudget::pace).
constexpr double kMergePace = 0.06;
// So many windows, a twentieth of a second's, are no reason to give up.
constexpr std::uint64_t kMostAnyway = 100000;

}  // namespace

Run::Run(Medium& medium, std::span<const detail::LocatedSource> sources, const RunLimits& limits)
    : medium_(medium), sources_(sources), limits_(limits), radius_(limits.max_value) {
  for (WindowFace& f : medium.structure.faces) f.waiting = kNoIndex;
  vertices_.resize(medium.structure.vertex_count());
  targets_.place(limits.targets, medium.structure);
  queue_.reset(medium.bucket_width, 0);
}

bool Run::operator()() {
  for (Index s = 0; s < sources_.size(); ++s) start(sources_[s], s);
  windows::EventQueue::Event event{};
  while (queue_.pop(windows::EventQueue::kLastBucket, event)) {
    poll_();
    if (gives_up()) return false;
    event.is_list ? pass_halfedge(event.index) : leave_vertex(event.index);
  }
  finish_targets();
  return is_complete();
}

// By what has been reached so far, so that it is known early.
bool Run::is_too_dear() const {
  return static_cast<double>(windows_) > kMostAnyway + limits_.most_per_vertex * static_cast<double>(seen_);
}

// Every now and then: whether it is too dear, how far light is still wanted, and progress.
bool Run::gives_up() {
  if (windows_ < next_look_ || given_up_) return given_up_;
  next_look_ = windows_ + 4096 + limits_.targets.size();
  narrow();
  if (limits_.progress) limits_.progress(static_cast<double>(seen_) / static_cast<double>(vertices_.size() + 1));
  return given_up_ = is_too_dear();
}

void Run::narrow() {
  if (limits_.targets.empty()) return;
  double farthest = 0;
  for (Index i = 0; i < targets_.size(); ++i) {
    const PointLocation& at = limits_.targets[i];
    const bool vertex = at.on == PointLocation::On::Vertex;
    farthest =
        std::max(farthest, vertex ? vertices_[medium_.structure.inner_vertex(at.vertex)].upper : targets_[i].upper);
  }
  radius_ = std::min(radius_, farthest + medium_.rounding.of(farthest));
}

// ---- what is seen

void Run::reach(Index v, double cost, Index source) {
  Vertex& at = vertices_[v];
  if (at.upper == kInfinity) ++seen_;
  if (cost < at.upper) at.upper = cost, at.source = source;
}

// `ray`: where it comes from; null: not over a halfedge.
void Run::see(Index v, double value, const windows::Ray* ray, bool all_around) {
  Vertex& at = vertices_[v];
  if (!(value < at.lower)) return;
  const double before = at.lower;
  at.lower = value;
  if (!all_around && !medium_.is_pivot[v] && medium_.structure.vertex_type[v] == windows::VertexType::None) return;
  at.from = ray ? windows::crossed_at(medium_.structure, *ray) : windows::CrossedAt{};
  at.all_around = all_around;
  if (!(at.waiting && queue_.same_bucket(before, value))) queue_.push_vertex(v, value);
  at.waiting = true;
}

void Run::reach_target(Index target, double value, double slack, Index source, bool straight) {
  windows::TargetState& t = targets_[target];
  if (value + slack < t.upper) t.upper = value + slack, t.ray.pseudo_source = source;
  if (straight) t.lower = std::min(t.lower, value);
}

windows::EdgeBounds Run::bounds(const WindowFace& f, Index k, double inverse_weight) const {
  const Vertex &start = vertices_[f.vertex[k]], &end = vertices_[f.vertex[next3(k)]];
  return {f.length[k], inverse_weight * std::min(start.upper, start.lower),
          inverse_weight * std::min(end.upper, end.lower)};
}

// ---- from face to face

// A window leaves a face over its halfedge h: from the end of h to its start, in the units of that face.
void Run::leave_face(Index h, const Window& w) {
  const WindowFace& f = face(h);
  if (medium_.is_border[h]) return refract_at(h, w);
  if (f.beyond[h % 3] == windows::Beyond::Face) return enter(f.opposite[h % 3], w);
  if (f.beyond[h % 3] == windows::Beyond::Nothing) return;
  const Index end = f.vertex[next3(h % 3)];
  for (Index g = f.opposite[h % 3]; g != h; g = face(g).opposite[g % 3]) enter_from(end, g, w);
}

// A window whose frame begins at vertex `end` of the edge of g.
void Run::enter_from(Index end, Index g, const Window& w) {
  const WindowFace& f = face(g);
  enter(g, f.vertex[g % 3] == end ? w : mirrored(w, f.length[g % 3]));
}

void Run::refract_at(Index h, const Window& w) {
  const WindowFace& f = face(h);
  const double from = medium_.weight[h / 3];
  const Index end = f.vertex[next3(h % 3)];
  if (windows::is_dominated({f.length[h % 3], vertices_[end].upper / from, vertices_[f.vertex[h % 3]].upper / from},
                            w.b0, w.b1, w.d0, w.d1)) {
    return;
  }
  run_from_critical(h, w);
  for (Index g = f.opposite[h % 3]; g != h; g = face(g).opposite[g % 3]) {
    const double into = medium_.weight[g / 3];
    if (into == from) {
      enter_from(end, g, w);
      continue;
    }
    refracted_.clear();
    refract(w, from / into, {limits_.share, 0.25, start_of(w.pseudo_source) / into}, refracted_);
    for (const Window& r : refracted_) enter_from(end, g, r);
  }
}

// Where light meets an edge that is cheaper than its face at the critical angle, it runs along it.
void Run::run_from_critical(Index h, const Window& w) {
  if (w.kind == WindowKind::Linear) return;  // it would run with its own front
  const double from = medium_.weight[h / 3], ratio = medium_.along[h] / from, depth = -w.source.y;
  if (depth > 0 && !(ratio < 1)) return;
  const double reach = depth > 0 ? depth * ratio / std::sqrt((1 - ratio) * (1 + ratio)) : 0;
  const double length = face(h).length[h % 3];
  for (const double side : {-1.0, 1.0}) {
    const double meets = w.source.x + side * reach, x = std::clamp(meets, w.b0, w.b1);
    if (std::abs(meets - x) > kTouching * (std::abs(w.source.x) + reach)) continue;
    // In the frame of h places count from its start.
    run_along({from * value_at(w, x), from * w.slack, w.pseudo_source}, h, length - x, side < 0);
  }
}

// Into the face of h, in its units.
void Run::enter(Index h, const Window& w) {
  WindowFace& f = face(h);
  const Index k = h % 3;
  const double weight = medium_.weight[h / 3];
  if (is_sliver(w) || weight * least_value(w) > radius_ ||
      is_dominated(bounds(f, k, 1 / weight), w.b0, w.b1, w.d0, w.d1)) {
    return;
  }
  const windows::Arrival at = arrival(w, frame_of(f, k).apex);
  const Index apex = f.vertex[previous3(k)];
  reach(apex, weight * (at.value + w.slack), w.pseudo_source);
  if (weight * at.value > radius_ && weight * minimum_of(w) > radius_) return;
  ++windows_;
  const std::int64_t bucket = queue_.bucket_of(weight * at.value);
  if (waiting_.push(f.waiting, h, w, bucket)) queue_.push_list_into(bucket, h);
}

// ---- through a face

void Run::pass_halfedge(Index h) {
  WindowFace& f = face(h);
  const Index k = h % 3;
  const double weight = medium_.weight[h / 3];
  const windows::EdgeBounds ends = bounds(f, k, 1 / weight);
  taken_.clear();
  on_edge_.clear();
  waiting_.take(f.waiting, h, [&](const Window& w) {
    if (!(weight * least_value(w) > radius_ || is_dominated(ends, w.b0, w.b1, w.d0, w.d1))) taken_.push_back(w);
  });
  if (taken_.empty()) return;
  const windows::Frame frame = frame_of(f, k);
  const std::span<Window> left = what_is_left(taken_, f, weight);
  for (const std::span<const Window> all : {std::span<const Window>(left), std::span<const Window>(on_edge_)}) {
    for (const Window& w : all) {
      if (gives_up()) return;  // one of them may become thousands
      pass_face(h, frame, w);
    }
  }
}

// Trimmed and merged (L2, L5, L8); what comes from a point of the edge goes on whole unless another path is shorter
// there.
std::span<Window> Run::what_is_left(std::span<Window> windows, const WindowFace& face, double weight) {
  if (windows.size() == 1) return windows;
  if (std::any_of(windows.begin(), windows.end(), windows::is_on_edge)) {
    const auto others = std::stable_partition(windows.begin(), windows.end(), windows::is_on_edge);
    for (auto w = windows.begin(); w != others; ++w) {
      const double x = w->source.x;
      const bool beaten = std::any_of(windows.begin(), windows.end(), [&](const Window& o) {
        return o.b0 <= x && x <= o.b1 && value_at(o, x) - w->source.y < w->sigma - windows::tie(w->sigma);
      });
      if (!beaten) on_edge_.push_back(*w);
    }
    windows = {others, windows.end()};
    if (windows.size() < 2) return windows;
  }
  const windows::MergeBudget budget{face.thin ? 0 : limits_.share, kMergePace};
  const auto merge = [&](const Window& a, Window& b, const windows::Joint& joint) {
    return a.pseudo_source == b.pseudo_source && merge_into(a, b, joint, start_of(a.pseudo_source) / weight, budget);
  };
  return windows::merge_all(windows, envelope_, merge);
}

void Run::pass_face(Index h, const windows::Frame& frame, const Window& w) {
  const WindowFace& f = face(h);
  const Index apex = f.vertex[previous3(h % 3)];
  const double weight = medium_.weight[h / 3];
  const windows::Arrival at = arrival(w, frame.apex);
  if (at.detour <= kSeen * at.value) {
    reach(apex, weight * (at.value + w.slack), w.pseudo_source);
    const windows::Ray ray{w.source, h, w.pseudo_source, w.kind};
    see(apex, weight * at.value, &ray, false);
  }
  if (f.has_target) {
    targets_.for_each_in(h / 3, [&](const windows::TargetInFace& t) {
      const windows::Arrival there = arrival(w, windows::in_frame(frame, h % 3, t.weights));
      reach_target(t.target, weight * there.value, weight * w.slack, w.pseudo_source,
                   there.detour <= kSeen * there.value);
    });
  }
  if (frame.apex.y == 0 && w.source.y == 0) return pass_along(h, frame, w);
  propagate(
      w, frame, [&](const Window& left) { leave_face(3 * (h / 3) + previous3(h % 3), left); },
      [&](const Window& right) { leave_face(3 * (h / 3) + next3(h % 3), right); });
}

void Run::pass_along(Index h, const windows::Frame& frame, const Window& w) {
  const Index first = 3 * (h / 3), k = h % 3;
  propagate_along(
      w, frame, [&](const Window& left) { leave_face(first + previous3(k), left); },
      [&](const Window& right) { leave_face(first + next3(k), right); });
}

// ---- results

Known Run::at_vertex(Index outer) const {
  const Vertex& v = vertices_[medium_.structure.inner_vertex(outer)];
  if (v.upper == kInfinity) return {};
  if (v.upper == start_of(v.source)) return {v.upper, v.upper, v.source};  // a source itself
  return {std::max(0.0, v.lower - medium_.rounding.of(v.lower)), v.upper + medium_.rounding.of(v.upper), v.source};
}

Known Run::at_target(std::size_t target) const {
  const PointLocation& at = limits_.targets[target];
  if (at.on == PointLocation::On::Vertex) return at_vertex(at.vertex);
  const windows::TargetState& t = targets_[static_cast<Index>(target)];
  if (t.upper == kInfinity) return {};
  return {std::max(0.0, t.lower - medium_.rounding.of(t.lower)), t.upper + medium_.rounding.of(t.upper),
          t.ray.pseudo_source};
}

}  // namespace brushfire::refraction
