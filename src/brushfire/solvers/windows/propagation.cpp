// The driver: sources, events, windows from edge to edge, light from vertices, and what is read off at the end.
//
// L1 ... L8 are the lemmas of docs/tolerance.md. Every write to a vertex is the length of a real path (to rounding),
// and a window or a part of one is dropped only where another real path is shown to be shorter; so order does not
// matter to the result, only to the time.
#include <brushfire/core/error.h>
#include <brushfire/solvers/windows/detail/dominance.h>
#include <brushfire/solvers/windows/detail/engine.h>
#include <brushfire/solvers/windows/detail/envelope.h>
#include <brushfire/solvers/windows/detail/exact_cross.h>
#include <brushfire/solvers/windows/detail/exact_lists.h>
#include <brushfire/solvers/windows/detail/exact_trim.h>
#include <brushfire/solvers/windows/detail/fan.h>
#include <brushfire/solvers/windows/detail/lists.h>
#include <brushfire/solvers/windows/detail/memory.h>
#include <brushfire/solvers/windows/detail/merge.h>
#include <brushfire/solvers/windows/detail/propagate.h>
#include <brushfire/solvers/windows/detail/queue.h>
#include <brushfire/solvers/windows/detail/reading.h>
#include <brushfire/solvers/windows/detail/record.h>
#include <brushfire/solvers/windows/detail/ridge.h>
#include <brushfire/solvers/windows/detail/structure.h>
#include <brushfire/solvers/windows/detail/sweep.h>
#include <brushfire/solvers/windows/detail/targets.h>
#include <brushfire/solvers/windows/detail/vertex_state.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace brushfire::detail {
namespace {

// Lists of exact runs are trimmed when their windows have crossed this many faces.
constexpr unsigned kTrimEvery = 8;
// Exact runs are quicker with narrower buckets.
constexpr double kExactBucket = 0.2;
// In buckets: exact runs not farther than this take windows one by one, lists of them would stay short.
constexpr double kShort = 8;
// A vertex this little (relative) off a window's limit ray counts as seen, with the length of the path that bends.
constexpr double kSeen = 1e-10;
// A source nearer to a corner of its face than this share of the face's longest edge makes the corner send light in all
// directions: limit rays through the corner are known to epsilon / share only.
constexpr double kNear = 1e-3;
class WindowEngine final : public Engine {
 public:
  explicit WindowEngine(const Mesh& mesh) : structure_(mesh) {
    if (mesh.vertex_count() >= kNoIndex / 2) throw Error(ErrorCode::TooLarge, "too many vertices for windows");
    values_.resize(mesh.vertex_count());
    light_.resize(mesh.vertex_count());
    touched_.reserve(mesh.vertex_count());
  }

  bool lists_touched() const override { return true; }

  void solve(const Problem& problem, DistanceField& field) override {
    problem_ = &problem;
    field_ = &field;
    clean();
    shift_ = -std::min_element(problem.sources.begin(), problem.sources.end(), [](const auto& a, const auto& b) {
                return a.offset < b.offset;
              })->offset;
    radius_ = problem.max_distance + shift_;
    several_ = problem.sources.size() > 1;
    if (several_) origins_.resize(values_.size());
    if (keeps_rays()) rays_.resize(values_.size());
    budget_ = budget_of(*problem.options);
    in_lists_ = !merges() && radius_ > kShort * structure_.bucket_width;
    queue_.reset(in_lists_ ? kExactBucket * structure_.bucket_width : structure_.bucket_width);
    targets_.place(problem.targets, structure_);
    next_target_check_ = problem.targets.empty() ? std::numeric_limits<std::uint64_t>::max() : 0;
    for (const LocatedSource& s : problem.sources) start(s);
    drain();
    finish();
  }

 private:
  // ---- set-up and reset

  bool merges() const { return budget_.share > 0; }
  bool keeps_rays() const { return problem_->options->keep_paths || problem_->options->keep_windows; }

  void clean() {
    for (const Index v : touched_) {
      values_[v] = {};
      light_[v] = {};
      if (!origins_.empty()) origins_[v] = {};
      if (!rays_.empty()) rays_[v] = {};
    }
    touched_.clear();
    if (!queue_.empty()) {  // left over from a run that was stopped
      lists_.clear();
      for (WindowFace& f : structure_.faces) f.waiting = kNoIndex;
      exact_.clear();
    }
    targets_.clear(structure_);
    kept_.clear();
    memory_.clear();
  }

  // ---- sources

  void start(const LocatedSource& s) {
    const Index root = structure_.vertex_count() + s.label;
    const double sigma = s.offset + shift_;
    if (s.at.on == PointLocation::On::Vertex) {
      const Index v = structure_.inner_vertex(s.at.vertex);
      reach(v, sigma);
      expect(v, sigma, 0);
      offer(v, sigma, {{}, kNoIndex, root, WindowKind::Circular}, true);
      return;
    }
    for (const FaceWeights& f : faces_around(structure_.mesh, s.at)) {
      start_in_face({structure_.inner_face(f.face), f.weights}, sigma, root);
    }
  }

  std::array<double, 3> corner_distances_of(const FaceWeights& at) const {
    PointLocation here;
    here.face = structure_.outer_face(at.face);
    here.weights = at.weights;
    return corner_distances(structure_.mesh, here);
  }

  // Straight to the corners, and through the edges that the source does not lie on.
  void start_in_face(const FaceWeights& at, double sigma, Index root) {
    const WindowFace& f = structure_.faces[at.face];
    const std::array<double, 3> distance = corner_distances_of(at);
    const double longest = std::max({f.length[0], f.length[1], f.length[2]});
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * at.face + next3(k);  // opposite of corner k
      Ray ray{{}, kNoIndex, root, WindowKind::Circular};
      if (f.usable && f.length[next3(k)] > 0) {
        ray.halfedge = h;
        ray.source = in_frame(frame_of(f, next3(k)), next3(k), at.weights);
      }
      const double value = sigma + distance[k];
      reach(f.vertex[k], value);
      expect(f.vertex[k], value, 0);
      offer(f.vertex[k], value, ray, ray.halfedge == kNoIndex || distance[k] < kNear * longest);
      if (ray.halfedge == kNoIndex) continue;
      Window w;
      w.b1 = f.length[next3(k)];
      w.source = {w.b1 - ray.source.x, -ray.source.y};
      w.sigma = sigma;
      w.d0 = sigma + distance[previous3(k)];
      w.d1 = sigma + distance[next3(k)];
      w.root = root;
      // A source on the edge of a face with an area lights nothing through that edge: the faces beyond start it, too.
      if (is_lit(w) && (w.source.y < 0 || f.double_area == 0)) cross_edge(h, w);
    }
    if (!f.has_target) return;
    targets_.for_each_in(at.face, [&](const TargetInFace& t) {
      const Index k = f.length[0] > 0 ? 0 : 1;
      if (!(f.length[k] > 0)) return;
      std::array<double, 3> step;
      for (std::size_t i = 0; i < 3; ++i) step[i] = t.weights[i] - at.weights[i];
      const Vec2 d = in_frame(frame_of(f, k), k, step);
      const Vec2 source = in_frame(frame_of(f, k), k, at.weights);
      offer_target(t.target, sigma + length_of(d.x, d.y), 0, 0, {source, 3 * at.face + k, root, WindowKind::Circular});
    });
  }

  // ---- events

  void drain() {
    constexpr std::uint64_t kPoll = 1024;
    const DistanceOptions& options = *problem_->options;
    while (!queue_.empty()) {
      if (++field_->updates % kPoll == 0) {
        if (options.cancel && options.cancel->cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
        if (options.progress && field_->updates % (64 * kPoll) == 0) {
          options.progress(static_cast<double>(touched_.size()) / structure_.vertex_count());
        }
      }
      if (field_->updates >= next_target_check_) narrow_radius();
      const EventQueue::Event event = queue_.pop();
      if (in_lists_) {
        prefetch_next_list();
      } else {
        prefetch_next();
      }
      if (event.is_list) {
        if (goes_in_lists(event.index)) {
          spread_list(event.index);
        } else {
          spread(event.index);
        }
      } else if (light_[event.index].waiting) {
        shine(event.index);
      }
    }
  }

  // What the next lists will read: their faces first, then their windows and the faces beyond, then the vertices there.
  void prefetch_next() const {
    const Index third = queue_.peek_list(5), second = queue_.peek_list(2), first = queue_.peek_list(1);
    if (third != kNoIndex) prefetch(&structure_.faces[third / 3]);
    if (second != kNoIndex) {
      const WindowFace& f = structure_.faces[second / 3];
      lists_.prefetch_list(f.waiting);
      for (const Index k : {next3(second % 3), previous3(second % 3)}) prefetch(&structure_.faces[f.opposite[k] / 3]);
    }
    if (first != kNoIndex) {
      const WindowFace& f = structure_.faces[first / 3];
      for (const Index k : {next3(first % 3), previous3(first % 3)}) {
        const Index g = f.opposite[k];
        prefetch(&values_[structure_.faces[g / 3].vertex[previous3(g % 3)]]);
      }
    }
  }

  // The same for lists of exact runs.
  void prefetch_next_list() const {
    const Index third = queue_.peek_list(6), second = queue_.peek_list(3), first = queue_.peek_list(1);
    if (third != kNoIndex) prefetch(&structure_.faces[third / 3]);
    if (second != kNoIndex) {
      const WindowFace& f = structure_.faces[second / 3];
      const Index apex = f.vertex[previous3(second % 3)];
      if (!f.thin) exact_.prefetch_list(f.waiting);
      prefetch(&values_[apex]);
      prefetch(&light_[apex]);
      for (const Index k : {next3(second % 3), previous3(second % 3)}) prefetch(&structure_.faces[f.opposite[k] / 3]);
    }
    if (first != kNoIndex && !structure_.faces[first / 3].thin) {
      exact_.prefetch_windows(structure_.faces[first / 3].waiting);
    }
  }

  // Nothing beyond the farthest target matters once all have been reached.
  void narrow_radius() {
    next_target_check_ = field_->updates + targets_.size() + 256;
    double farthest = 0;
    for (Index i = 0; i < targets_.size(); ++i) {
      const PointLocation& at = problem_->targets[i];
      const bool vertex = at.on == PointLocation::On::Vertex;
      farthest = std::max(farthest, vertex ? values_[structure_.inner_vertex(at.vertex)].upper : targets_[i].upper);
    }
    radius_ = std::min(radius_, farthest / kDominated);
  }

  // ---- values of vertices and targets

  // A real path of this length leads to v.
  [[gnu::always_inline]] void reach(Index v, double length) {
    double& upper = values_[v].upper;
    if (upper == kInfinity) touched_.push_back(v);
    upper = std::min(upper, length);  // without a branch: nobody could guess it
  }

  Index label_of(Index root) const {
    const Index n = structure_.vertex_count();
    return root >= n ? root - n : several_ ? origins_[root].label : 0;
  }

  // A window that is about to be merged with others sees v: what it expects the distance to be.
  [[gnu::always_inline]] void expect(Index v, double value, double lift) {
    double& estimate = values_[v].estimate;
    estimate = std::min(estimate, value + lift);
  }

  // A window or a source sees v. Where paths may bend, light will go on from there.
  [[gnu::always_inline]] void offer(Index v, double value, const Ray& ray, bool all_around) {
    if (!(value > values_[v].lower)) accept(v, value, ray, all_around);
  }
  [[gnu::noinline]] void accept(Index v, double value, const Ray& ray, bool all_around) {
    double& least = values_[v].lower;
    const double before = least;
    const bool lower = value < before;
    if (!lower && (!several_ || label_of(ray.root) >= origins_[v].label)) return;
    least = value;
    if (several_) origins_[v] = {ray.root, label_of(ray.root)};
    if (!rays_.empty()) rays_[v] = ray;
    if (!all_around && structure_.bend[v] == Bend::None) return;
    VertexLight& light = light_[v];
    const bool queued = light.waiting && queue_.same_bucket(before, value);
    light.from = crossed_at(structure_, ray);
    light.all_around = all_around;
    if (!lower) return;
    light.waiting = true;
    if (queued) return;
    queue_.push_vertex(v, value);
  }

  // Along a ray or, where it is not `straight`, by a detour: a real path, but not one to follow back.
  void offer_target(Index i, double value, double slack, double lift, const Ray& ray, bool straight = true) {
    TargetState& t = targets_[i];
    t.upper = std::min(t.upper, value + slack);
    if (!straight) return;
    if (value > t.lower || (value == t.lower && label_of(ray.root) >= label_of(t.ray.root))) return;
    t.lower = value;
    t.estimate = value + lift;
    t.ray = ray;
  }

  // ---- windows

  EdgeBounds bounds_of(const WindowFace& f, Index k) const {
    const VertexValues &start = values_[f.vertex[k]], &end = values_[f.vertex[next3(k)]];
    return {f.length[k], std::min(start.upper, start.lower), std::min(end.upper, end.lower)};
  }
  [[gnu::always_inline]] bool is_dominated(const WindowFace& f, Index k, const Window& w) const {
    return detail::is_dominated(bounds_of(f, k), w.b0, w.b1, w.d0, w.d1);
  }

  // A window leaves a face over its halfedge h; it is described from beyond, from the end of h to its start.
  [[gnu::always_inline]] void cross_edge(Index h, const Window& w, Origin origin = Origin::Anywhere) {
    const WindowFace& f = structure_.faces[h / 3];
    if (f.beyond[h % 3] == Beyond::Face) return insert(f.opposite[h % 3], w, origin);
    if (f.beyond[h % 3] == Beyond::Several) insert_into_all(h, w);
  }

  [[gnu::noinline]] void insert_into_all(Index h, const Window& w) {
    const WindowFace& f = structure_.faces[h / 3];
    const Index end = f.vertex[next3(h % 3)];
    for (Index g = f.opposite[h % 3]; g != h; g = structure_.faces[g / 3].opposite[g % 3]) {
      const bool usual = structure_.faces[g / 3].vertex[g % 3] == end;
      insert(g, usual ? w : mirrored(w, f.length[h % 3]));
    }
  }

  // A window is about to enter the face of h: unless it is of no use, it waits there for its turn.
  [[gnu::always_inline]] void insert(Index h, const Window& w, Origin origin = Origin::Anywhere) {
    WindowFace& f = structure_.faces[h / 3];
    const Index k = h % 3;
    if (is_sliver(w) | (least_value(w) > radius_) | is_dominated(f, k, w)) return;  // one branch to guess, not three
    if (goes_in_lists(h)) return is_on_edge(w) ? pass_at_once(h, w) : insert_into_list(h, w, origin);
    if (f.thin && !learn(h, w)) return;
    const Arrival at_apex = arrival(w, frame_of(f, k).apex);
    const Index apex = f.vertex[previous3(k)];
    reach(apex, at_apex.value + w.slack);
    if (at_apex.value > radius_ && ends_here(f, k, w)) return;
    if (merges() && at_apex.detour <= kSeen * at_apex.value) expect(apex, at_apex.value, w.lift);
    // The key is the arrival at the far corner: by then everything that enters over the edge has come.
    const std::int64_t turn = queue_.turn_of(at_apex.value);
    if (lists_.push(f.waiting, h, w, turn)) queue_.push_list(h, at_apex.value, turn);
  }
  [[gnu::noinline]] void insert_into_list(Index h, const Window& w, Origin origin) {
    exact_.put(structure_.faces[h / 3].waiting, h, origin, w);
    queue_list(h, std::min({w.d0, w.d1, nearer_end(h)}));
  }
  // Whether a window whose apex is beyond the radius has nothing to tell anyone behind the face.
  [[gnu::noinline]] bool ends_here(const WindowFace& f, Index k, const Window& w) const {
    if (minimum_of(w) > radius_) return true;
    return !f.has_target && !problem_->options->keep_windows && ends_in_face(w, frame_of(f, k), radius_);
  }
  // Where the source lies on the edge: lists are for windows that can be trimmed (see set_apart()).
  [[gnu::noinline]] void pass_at_once(Index h, const Window& w) {
    pass(h, frame_of(structure_.faces[h / 3], h % 3), w);
  }
  [[gnu::noinline]] bool learn(Index h, Window w) { return memory_.learn(h, w); }

  // The turn of a list: trimmed (L5), merged (L2), and on to the other two edges.
  void spread(Index h) {
    WindowFace& f = structure_.faces[h / 3];
    const Index k = h % 3;
    taken_.clear();
    lists_.take(f.waiting, h, [&](const Window& w) {
      if (!((least_value(w) > radius_) | is_dominated(f, k, w))) taken_.push_back(w);
    });
    if (taken_.empty()) return;
    const Frame frame = frame_of(f, k);
    std::span<Window> windows = taken_;
    if (windows.size() > 1 && std::any_of(windows.begin(), windows.end(), is_on_edge)) windows = set_apart(windows);
    if (windows.size() > 1) windows = merges() ? merged(windows) : envelope_(windows);
    for (const Window& w : windows) pass(h, frame, w);
    for (const Window& w : on_edge_) pass(h, frame, w);
    on_edge_.clear();
  }

  // L5. Windows with their source on the edge are not trimmed (all their light passes through that one point, where
  // others may tie with them): they go on whole unless another path to the source itself is shorter. Returns the
  // others.
  std::span<Window> set_apart(std::span<Window> windows) {
    const auto others = std::stable_partition(windows.begin(), windows.end(), is_on_edge);
    for (auto w = windows.begin(); w != others; ++w) {
      const double x = w->source.x;
      const bool beaten = std::any_of(windows.begin(), windows.end(), [&](const Window& o) {
        return o.b0 <= x && x <= o.b1 && value_at(o, x) - w->source.y < w->sigma - tie(w->sigma);
      });
      if (!beaten) on_edge_.push_back(*w);
    }
    return {others, windows.end()};
  }

  // L2, L5, L8: what is left of the windows of an edge.
  std::span<Window> merged(std::span<Window> windows) {
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
    windows = envelope_(windows);
    return windows.first(merge_neighbours(windows));
  }

  // ---- lists of exact runs

  // Faces so thin that windows may come back for ever take them one by one (WindowMemory).
  bool goes_in_lists(Index h) const { return in_lists_ && !structure_.faces[h / 3].thin; }

  // The key of lists is what is known of the nearer end of the edge: nearly all that enters over the edge has come by
  // then.
  double nearer_end(Index h) const {
    const WindowFace& f = structure_.faces[h / 3];
    return std::min(values_[f.vertex[h % 3]].upper, values_[f.vertex[next3(h % 3)]].upper);
  }
  void queue_list(Index h, double key) {
    double& queued = exact_.key(structure_.faces[h / 3].waiting, h);
    if (key < queued && !(queued < kInfinity && queue_.same_bucket(key, queued))) queue_.push_list(h, key);
    queued = std::min(queued, key);
  }

  // The turn of a list: trimmed now and then, and on to the other two edges as a whole.
  void spread_list(Index h) {
    WindowFace& f = structure_.faces[h / 3];
    const Index k = h % 3;
    if (exact_.empty(f.waiting, h)) return;
    WindowList list = exact_.take(f.waiting, h);
    if (list.age >= kTrimEvery || !list.ordered || radius_ < kInfinity || problem_->options->keep_windows) {
      trim_(list, bounds_of(f, k), radius_, exact_.blocks());
    }
    if (list.size > 0) cross_face(h, list);
    exact_.blocks().release(list.block);
  }

  void cross_face(Index h, const WindowList& list) {
    const WindowFace& f = structure_.faces[h / 3];
    const Frame frame = frame_of(f, h % 3);
    const WindowColumns w = list.block.columns();
    look_at_apex(w, list.size, frame, sight_);
    const Index best = reach_apex(h, frame, w, list.size);
    if (f.has_target) reach_targets(h, frame, w, list.size);
    if (problem_->options->keep_windows) {
      for (Index i = 0; i < list.size; ++i) kept_.push_back({structure_.outer_halfedge(h), w.window(i)});
    }
    const Index apex = f.vertex[previous3(h % 3)];
    // A list that comes late is on its way out: it is worth trimming.
    const bool late = best != kNoIndex && sight_.value[best] > values_[apex].upper / kDominated;
    const unsigned age = late ? kTrimEvery : list.age + 1;
    find_routes(w, list.size, frame, sight_, best, routes_);
    const Index left = 3 * (h / 3) + previous3(h % 3), right = 3 * (h / 3) + next3(h % 3);
    if (routes_.left_end > 0 && leads_on(left)) {
      WindowList out{exact_.blocks().allocate(routes_.left_end), 0, age, true};
      out.size = cross_to_left(w, routes_, sight_, frame, out.block.columns());
      hand_over(left, out, Origin::Start);
    }
    if (routes_.right_begin < list.size && leads_on(right)) {
      WindowList out{exact_.blocks().allocate(list.size - routes_.right_begin), 0, age, true};
      out.size = cross_to_right(w, list.size, routes_, sight_, frame, out.block.columns());
      hand_over(right, out, Origin::End);
    }
  }
  bool leads_on(Index h) const { return structure_.faces[h / 3].beyond[h % 3] != Beyond::Nothing; }

  // What the list is to the apex. Returns the window that is best there among those that see it, if any.
  Index reach_apex(Index h, const Frame& frame, const WindowColumns& w, Index count) {
    const Index apex = structure_.faces[h / 3].vertex[previous3(h % 3)];
    double* const value = sight_.value.data();
    const auto sees = [&](Index i) { return sight_.left[i] > 0 && sight_.right[i] > 0; };
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
    while (right < count && sight_.left[right] > 0) ++right;
    const auto bend = [&](Index i, double x) {
      reach(apex, w.sigma[i] + length_of(x - w.x[i], w.y[i]) + length_of(frame.apex.x - x, frame.apex.y));
    };
    if (right > 0) bend(right - 1, w.b1[right - 1]);
    if (right < count) bend(right, w.b0[right]);
    return kNoIndex;
  }

  void offer_apex(Index apex, double value, const WindowColumns& w, Index i, Index h) {
    reach(apex, value);
    offer(apex, value, {{w.x[i], w.y[i]}, h, w.root[i], WindowKind::Circular}, false);
  }

  void reach_targets(Index h, const Frame& frame, const WindowColumns& w, Index count) {
    targets_.for_each_in(h / 3, [&](const TargetInFace& t) {
      const Vec2 p = in_frame(frame, h % 3, t.weights);
      for (Index i = 0; i < count; ++i) {
        const Arrival there = arrival(w.window(i), p);
        offer_target(t.target, there.value, 0, 0, {{w.x[i], w.y[i]}, h, w.root[i], WindowKind::Circular},
                     there.detour <= kSeen * there.value);
      }
    });
  }

  // A list leaves a face over its halfedge h.
  void hand_over(Index h, const WindowList& list, Origin origin) {
    const WindowFace& f = structure_.faces[h / 3];
    const Index beyond = f.opposite[h % 3];
    if (list.size > 0 && f.beyond[h % 3] == Beyond::Face && goes_in_lists(beyond)) {
      exact_.put(structure_.faces[beyond / 3].waiting, beyond, origin, list);
      return queue_list(beyond, nearer_end(beyond));
    }
    const WindowColumns w = list.block.columns();
    for (Index i = 0; i < list.size; ++i) cross_edge(h, w.window(i));
    exact_.blocks().release(list.block);
  }

  // ---- merging

  // L2, L8. From left to right, each with the one before it as long as that works. Returns how many are left.
  std::size_t merge_neighbours(std::span<Window> w) const {
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
  bool merge_pair(const Window& a, Window& b, const Joint& joint) const {
    if (problem_->sources.size() == 1) return merge_into(a, b, joint, start_of(0), budget_);
    const Index label = label_of(a.root);
    return label == label_of(b.root) && merge_into(a, b, joint, start_of(label), budget_);
  }
  // The value with which paths from a source start.
  double start_of(Index label) const { return problem_->sources[label].offset + shift_; }

  void pass(Index h, const Frame& frame, const Window& waiting) {
    Window w = waiting;
    w.kind = WindowKind::Circular;  // known here: no other kind is ever started
    const WindowFace& f = structure_.faces[h / 3];
    const Index apex = f.vertex[previous3(h % 3)];
    const Ray ray{w.source, h, w.root, w.kind};
    const Arrival at = arrival(w, frame.apex);
    if (at.detour <= kSeen * at.value) {
      reach(apex, at.value + w.slack);
      offer(apex, at.value, ray, false);
    }
    if (f.has_target) {
      targets_.for_each_in(h / 3, [&](const TargetInFace& t) {
        const Arrival there = arrival(w, in_frame(frame, h % 3, t.weights));
        offer_target(t.target, there.value, w.slack, w.lift, ray, there.detour <= kSeen * there.value);
      });
    }
    if (problem_->options->keep_windows) kept_.push_back({structure_.outer_halfedge(h), w});
    if (frame.apex.y == 0 && w.source.y == 0) return pass_along(h, frame, w);
    const Division d = divide(w, frame.apex);
    const double apex_value = straight_value(w, frame.apex);
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
  void pass_along(Index h, const Frame& frame, const Window& w) {
    const Index face = 3 * (h / 3), k = h % 3;
    const double apex = frame.apex.x, x = w.source.x;
    Window out = w;
    out.b0 = 0;
    const auto send = [&](Index edge, double length, double from_start) {
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

  // L6. Light goes on from v: into its shadow, or everywhere.
  void shine(Index v) {
    VertexLight& light = light_[v];
    light.waiting = false;
    if (values_[v].lower > radius_) return;
    if (light.all_around || structure_.bend[v] == Bend::Full || light.from.halfedge == kNoIndex) {
      for (const Index corner : structure_.mesh.corners(structure_.outer_vertex(v))) {
        shine_through(v, structure_.inner_halfedge(corner));
      }
      return;
    }
    for_each_shadow(structure_, v, light.from, [&](const Sector& sector) { shine_into(v, sector); });
  }

  void shine_through(Index v, Index corner) {
    const Index face = corner / 3, i = corner % 3;
    const WindowFace& f = structure_.faces[face];
    if (f.usable) {
      shine_into(v, whole_sector(f, face, i));
      return;
    }
    for (const Index j : {next3(i), previous3(i)}) {
      if (f.vertex[j] == v) continue;
      const double value = values_[v].lower + f.length[j == next3(i) ? i : j];
      reach(f.vertex[j], value + slack_of(v));
      expect(f.vertex[j], value, lift_of(v));
      offer(f.vertex[j], value, {{}, kNoIndex, v, WindowKind::Circular}, false);
    }
  }

  double slack_of(Index v) const { return std::max(0.0, values_[v].upper - values_[v].lower); }
  double lift_of(Index v) const { return std::clamp(values_[v].estimate - values_[v].lower, 0.0, slack_of(v)); }

  // Along the sector's edges to their ends, and through its face.
  void shine_into(Index v, Sector sector) {
    const WindowFace& f = structure_.faces[sector.face];
    const Index i = sector.corner, near = next3(i), far = previous3(i);
    // Where the corner lies on the opposite edge, an interval there cannot tell directions: all are lit.
    if (f.double_area <= kOnEdge * f.length[near] * f.length[near]) sector = whole_sector(f, sector.face, i);
    if (sector.from_edge()) shine_along(v, sector.face, near, f.length[i]);
    if (sector.to_edge()) shine_along(v, sector.face, far, f.length[far]);
    if (!(f.length[near] > 0)) return;
    Window w = window_of(f, sector, values_[v].lower);
    w.slack = slack_of(v);
    w.lift = static_cast<float>(lift_of(v));
    w.root = v;
    if (is_lit(w)) cross_edge(3 * sector.face + near, w, Origin::Apex);
  }

  // Along the edge from v to corner j of a face that contains both.
  void shine_along(Index v, Index face, Index j, double length) {
    const WindowFace& f = structure_.faces[face];
    const Index opposite = next3(j);  // the halfedge opposite of corner j; v is one of its ends
    const double x = f.vertex[opposite] == v ? 0 : f.length[opposite];
    const double value = values_[v].lower + length;
    reach(f.vertex[j], value + slack_of(v));
    expect(f.vertex[j], value, lift_of(v));
    const bool framed = f.length[opposite] > 0;
    offer(f.vertex[j], value, {{x, 0}, framed ? 3 * face + opposite : kNoIndex, v, WindowKind::Circular}, false);
  }

  // ---- results

  void finish() {
    finish_targets();
    finish_labels();
    const bool bounded = !problem_->touched;
    if (bounded) field_->error_bound.assign(structure_.vertex_count(), kInfinity);
    field_->max_error_bound = 0;
    const bool narrowed = radius_ < problem_->max_distance + shift_;
    for (const Index v : touched_) {
      const Index outer = structure_.outer_vertex(v);
      if (problem_->touched) problem_->touched->push_back(outer);
      const VertexValues& s = values_[v];
      // Seen by no window yet, or not final when the run stopped.
      if (s.lower == kInfinity || (narrowed && s.lower > radius_)) {
        ++field_->beyond_radius;
        continue;
      }
      const Index label = label_of(v);
      const Reading r = read(s.lower, s.upper, s.estimate, label);
      field_->distance[outer] = r.value - shift_;
      field_->source[outer] = label;
      if (bounded) field_->error_bound[outer] = r.bound;
      if (r.value <= radius_) field_->max_error_bound = std::max(field_->max_error_bound, r.relative);
    }
    for (Index i = 0; i < targets_.size(); ++i) {
      const PointLocation& at = problem_->targets[i];
      if (at.on == PointLocation::On::Vertex) continue;  // read off the field
      const TargetState& t = targets_[i];
      if (t.upper == kInfinity) continue;
      field_->target_source[i] = label_of(t.ray.root);
      field_->target_distance[i] = read(t.lower, t.upper, t.estimate, field_->target_source[i]).value - shift_;
    }
    if (keeps_rays()) keep();
  }

  Reading read(double lower, double upper, double estimate, Index label) const {
    return detail::read(lower, upper, estimate, start_of(label), budget_.share, problem_->options->bound);
  }

  // With the mesh's own numbers.
  Index outer_root(Index root) const { return root < structure_.vertex_count() ? structure_.outer_vertex(root) : root; }
  Ray outer(Ray ray) const {
    if (ray.halfedge != kNoIndex) ray.halfedge = structure_.outer_halfedge(ray.halfedge);
    if (ray.root != kNoIndex) ray.root = outer_root(ray.root);
    return ray;
  }

  // What paths and points inside of faces need later.
  void keep() {
    const Mesh& mesh = structure_.mesh;
    auto data = std::make_shared<WindowFieldData>();
    data->mesh = mesh;
    data->sources.assign(problem_->sources.begin(), problem_->sources.end());
    data->shift = shift_;
    PointRecord unknown;
    if (radius_ < kInfinity) unknown.value = std::numeric_limits<double>::quiet_NaN();
    data->vertices.assign(mesh.vertex_count(), unknown);
    for (const Index v : touched_) {
      if (values_[v].lower > radius_) continue;
      data->vertices[structure_.outer_vertex(v)] = {values_[v].lower, label_of(v), outer(rays_[v])};
    }
    data->targets.assign(problem_->targets.begin(), problem_->targets.end());
    for (Index i = 0; i < targets_.size(); ++i) {
      const TargetState& t = targets_[i];
      data->target.push_back({t.lower, t.lower < kInfinity ? label_of(t.ray.root) : kNoIndex, outer(t.ray)});
    }
    data->exact = !merges();
    data->all_points = problem_->options->keep_windows;
    if (data->all_points) {
      for (KeptWindow& k : kept_) k.window.root = outer_root(k.window.root);
      data->keep(kept_);
    }
    field_->windows = std::make_shared<WindowField>(std::move(data));
  }

  // Around the corners of a target's face.
  void finish_targets() {
    for (const TargetInFace& t : targets_.in_faces()) {
      const std::array<double, 3> d = corner_distances_of({t.face, t.weights});
      for (Index k = 0; k < 3; ++k) {
        const Index v = structure_.faces[t.face].vertex[k];
        if (values_[v].upper == kInfinity) continue;
        offer_target(t.target, values_[v].lower + d[k], slack_of(v), lift_of(v),
                     {{}, kNoIndex, v, WindowKind::Circular});
      }
    }
  }

  // A vertex belongs to the source to which its chain of roots leads; with ties, roots may have changed hands since.
  void finish_labels() {
    if (problem_->sources.size() == 1) return;
    const Index n = structure_.vertex_count();
    for (const Index start : touched_) {
      chain_.clear();
      Index v = start;
      while (v < n && origins_[v].root < n && chain_.size() <= touched_.size()) {
        chain_.push_back(v);
        v = origins_[v].root;
      }
      if (v >= n) continue;
      for (const Index u : chain_) origins_[u].label = origins_[v].label;
    }
  }

  WindowStructure structure_;
  WindowLists lists_;
  EventQueue queue_;
  Envelope envelope_;
  WindowMemory memory_;
  ExactLists exact_;
  ListTrimmer trim_;
  Sight sight_;
  Routes routes_;
  std::vector<VertexValues> values_;  // [vertex_count]
  std::vector<VertexLight> light_;    // [vertex_count]
  std::vector<Origins> origins_;      // [vertex_count] in runs with several sources
  std::vector<Ray> rays_;       // [vertex_count] in runs that keep them: what brought every vertex its least value
  std::vector<Index> touched_;  // vertices whose entries have changed
  std::vector<Window> taken_;
  std::vector<Window> on_edge_;  // of those, with their source on the edge
  std::vector<KeptWindow> kept_;
  Targets targets_;
  std::vector<Index> chain_;
  MergeBudget budget_;
  const Problem* problem_ = nullptr;
  DistanceField* field_ = nullptr;
  bool several_ = false;   // sources
  double shift_ = 0;       // added to all values, so that none is negative
  double radius_ = 0;      // nothing beyond is wanted
  bool in_lists_ = false;  // windows travel in lists
  std::uint64_t next_target_check_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_windows(const Mesh& mesh) { return std::make_unique<WindowEngine>(mesh); }

}  // namespace brushfire::detail
