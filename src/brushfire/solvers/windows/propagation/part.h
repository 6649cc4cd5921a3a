// One part of the mesh in a run: its queue, the windows that wait on its faces, and what they do when their turn comes.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/solvers/windows/algebra/dominance.h>
#include <brushfire/solvers/windows/algebra/envelope.h>
#include <brushfire/solvers/windows/algebra/exact_cross.h>
#include <brushfire/solvers/windows/propagation/exact_trim.h>
#include <brushfire/solvers/windows/propagation/links.h>
#include <brushfire/solvers/windows/propagation/mail.h>
#include <brushfire/solvers/windows/propagation/run_state.h>
#include <brushfire/solvers/windows/store/exact_lists.h>
#include <brushfire/solvers/windows/store/lists.h>
#include <brushfire/solvers/windows/store/memory.h>
#include <brushfire/solvers/windows/store/queue.h>
#include <brushfire/solvers/windows/store/spines.h>
#include <brushfire/solvers/windows/store/trails.h>

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// A vertex this little (relative) off a window's limit ray counts as seen, with the length of the path that bends.
inline constexpr double kSeen = 1e-10 * kRootFiner;

// What is written by one thread all the time stays clear of what another one reads: processors fetch lines by twos.
inline constexpr std::size_t kApart = 128;  // bytes

// What a thread needs at hand to work on parts, one after the other.
struct alignas(kApart) Workbench {
  BlockPool blocks;
  ListTrimmer trim;
  Sight sight;
  Routes routes;
  Envelope envelope;
  std::vector<Window> taken;
  std::vector<Window> on_edge;  // of those, with their source on the edge
  std::vector<Index> corners;   // at a vertex
  LinkShadow link;
};

// What a part needs while something waits in it. The front is in few parts at a time: they hand it on.
struct alignas(kApart) Traffic {
  EventQueue queue;
  WindowLists windows;
  ExactLists lists;
  Mail outbox;
  Pile news;  // vertices with copies whose upper bound fell, with repetitions
};

class alignas(kApart) Part {
 public:
  Part(RunState& run, Index number)
      : run_(&run),
        number_(number),
        first_(run.structure.first_vertex[number]),
        last_(run.structure.first_vertex[number + 1]) {}

  // ---- between two rounds, when no part is at work

  bool is_active() const { return traffic_ != nullptr; }
  void activate(std::unique_ptr<Traffic> traffic, std::int64_t turn);
  std::unique_ptr<Traffic> retire() { return std::move(traffic_); }
  bool is_idle() const { return traffic_->queue.empty(); }
  EventQueue::Next next() const { return traffic_->queue.next(); }
  // What it has to tell the others; the caller sees to it and clears it.
  Mail& outbox() {
    send_news();
    return traffic_->outbox;
  }

  void start_at_vertex(Index v, Real sigma, Index root);
  void start_in_face(const FaceWeights& at, Real sigma, Index root, Workbench& bench);
  // What came from other parts.
  void learn_label(const Mail::Label& label) { labels_[label.root] = label.label; }
  void hear(Index v, Real upper, Real estimate);
  void receive(const Mail::Offer& offer) { take(offer.vertex, offer.value, offer.ray, offer.all_around); }
  void receive(const Mail::OneWindow& window, Workbench& bench);
  void receive(const Mail::WholeList& list, Workbench& bench);

  // What is left of the last run, whether it came to its end or not.
  void forget();
  // Its vertices whose entries have changed, each once.
  Index touched_count() const { return touched_; }
  template <class Visit>
  void for_each_touched(Visit&& visit) const {
    if (touched_ <= room_for_touched()) {
      for (Index i = 0; i < touched_; ++i) visit(list_of_touched()[i]);
      return;
    }
    for (Index v = first_; v < last_; ++v) {
      if (run_->values[v].upper < kInfinity) visit(v);
    }
  }
  std::span<KeptWindow> kept() { return kept_; }
  // Events since this was asked last.
  std::uint64_t count_updates() { return std::exchange(updates_, 0); }

  // ---- a round

  // All that is to be done up to bucket number `last`. Throws Error(Cancelled).
  void work(std::int64_t last, Workbench& bench);

  // ---- values of vertices

  // A real path of this length leads to v.
  [[gnu::always_inline]] void reach(Index v, Real length) {
    VertexValues& at = run_->values[v];
    if (at.upper == kInfinity) touch(v, length);
    traffic_->news.push_if((length < at.upper) & at.has_copies(), v);
    at.upper = std::min(at.upper, length);  // without a branch: nobody could guess it
  }

 private:
  const WindowFace& face(Index h) const { return run_->structure.faces[h / 3]; }
  bool is_here(Index f) const { return run_->structure.part_of_face(f) == number_; }
  Index label_of(Index root) const;

  // part.cpp: vertices
  void touch(Index v, Real length) {
    if (!(length < kInfinity)) return;
    if (touched_ < room_for_touched()) list_of_touched()[touched_] = v;
    ++touched_;
  }
  // They are listed as long as they are few: going through all costs less than a long list.
  Index* list_of_touched() const { return run_->touched.data() + first_ / kFewTouched; }
  Index room_for_touched() const { return last_ / kFewTouched - first_ / kFewTouched; }
  [[gnu::always_inline]] void expect(Index v, Real value, Real lift) {
    Real& estimate = run_->values[v].estimate;
    estimate = std::min(estimate, value + lift);
  }
  // A window or a source sees v. Where paths may bend, light will go on from there.
  [[gnu::always_inline]] void offer(Index v, Real value, const Ray& ray, bool all_around) {
    if (!(value > run_->values[v].lower)) accept(v, value, ray, all_around);
  }
  [[gnu::noinline]] void accept(Index v, Real value, const Ray& ray, bool all_around);
  bool take(Index v, Real value, const Ray& ray, bool all_around);
  void offer_target(Index target, Real value, Real slack, Real lift, const Ray& ray, bool straight = true);
  [[gnu::always_inline]] void prefetch_face(Index h) const;
  [[gnu::always_inline]] void prefetch_around(Index h) const;
  [[gnu::always_inline]] void prefetch_windows(Index h) const;
  [[gnu::always_inline]] void prefetch_next() const;
  void prefetch_first() const;
  [[gnu::always_inline]] void prefetch_next_vertices() const;
  [[gnu::always_inline]] void prefetch_fan(Index v, std::size_t steps) const;
  void poll() const;
  void send_news();
  void send_label(Index part, Index root);

  // part_windows.cpp: windows one by one
  EdgeBounds bounds_of(const WindowFace& f, Index k) const {
    const VertexValues &start = run_->values[f.vertex[k]], &end = run_->values[f.vertex[next3(k)]];
    return {f.length[k], std::min(start.upper, start.lower), std::min(end.upper, end.lower)};
  }
  void cross_edge(Index h, const Window& w, Origin origin = Origin::Anywhere);
  void insert(Index h, const Window& w, Origin origin);
  // The same, for callers where it is rare.
  [[gnu::noinline]] void cross_edge_one(Index h, const Window& w);
  [[gnu::noinline]] void insert_one(Index h, const Window& w, Origin origin);
  [[gnu::noinline]] void insert_into_all(Index h, const Window& w);
  bool pass_spine(Index h, Window& w);
  [[gnu::noinline]] void insert_into_rest(Index h, const Window& w);
  [[gnu::noinline]] void insert_into_list(Index h, const Window& w, Origin origin);
  [[gnu::noinline]] void send(Index h, const Window& w, Origin origin);
  [[gnu::noinline]] bool ends_here(const WindowFace& f, Index k, const Window& w) const;
  [[gnu::noinline]] void pass_at_once(Index h, const Window& w);
  [[gnu::noinline]] void insert_after_trail(Index h, Window w);
  void wait(WindowFace& f, Index h, const Window& w);
  // Whether windows remember that they were in a face.
  static bool leaves_trail(const WindowFace& f) { return kWide || f.thin; }
  void spread(Index h);
  std::span<Window> set_apart(std::span<Window> windows);
  std::span<Window> merged(std::span<Window> windows);
  std::size_t merge_neighbours(std::span<Window> w) const;
  bool merge_pair(const Window& a, Window& b, const Joint& joint) const;
  void pass(Index h, const Frame& frame, const Window& waiting);
  void pass_along(Index h, const Frame& frame, const Window& w);

  // part_lists.cpp: whole lists, of exact runs
  // Faces so thin that windows may come back for ever take them one by one (WindowMemory).
  bool goes_in_lists(Index h) const { return run_->in_lists && !face(h).thin; }
  // The key of lists is what is known of the nearer end of the edge: nearly all that enters over the edge has come by
  // then.
  Real nearer_end(const WindowFace& f, Index k) const {
    return std::min(run_->values[f.vertex[k]].upper, run_->values[f.vertex[next3(k)]].upper);
  }
  [[gnu::always_inline]] void queue_list(WindowFace& f, Index h, Real key) {
    EventQueue& queue = traffic_->queue;
    Real& queued = traffic_->lists.key(f.waiting, h);
    if (key < queued && !(queued < kInfinity && queue.same_bucket(to_double(key), to_double(queued)))) {
      queue.push_list(h, to_double(key));
    }
    queued = std::min(queued, key);
  }
  void spread_list(Index h);
  void cross_face(Index h, const WindowList& list);
  [[gnu::always_inline]] Index reach_apex(Index h, const Frame& frame, const WindowColumns& w, Index count);
  [[gnu::always_inline]] void offer_apex(Index apex, Real value, const WindowColumns& w, Index i, Index h);
  void reach_targets(Index h, const Frame& frame, const WindowColumns& w, Index count);
  void hand_over(Index h, const WindowList& list, Origin origin);
  void send(Index h, const WindowList& list, Origin origin);
  bool leads_on(Index h) const { return face(h).beyond[h % 3] != Beyond::Nothing; }

  // part_windows.cpp, too: vertices that send light
  void shine(Index v);
  void shine_through(Index v, Index corner);
  void shine_into(Index v, Sector sector);
  void shine_along(Index v, Index face, Index j, Real length);
  Real slack_of(Index v) const;
  Real lift_of(Index v) const;

  RunState* run_;
  Index number_;
  Index first_, last_;  // its vertices
  std::unique_ptr<Traffic> traffic_;
  Workbench* bench_ = nullptr;
  Index touched_ = 0;
  std::uint64_t updates_ = 0;
  WindowMemory memory_;
  Trails trails_;  // of windows that cross thin faces (of all, in wide numbers)
  SpineMemory spines_;
  std::vector<KeptWindow> kept_;
  std::unordered_map<Index, Index> labels_;  // of roots in other parts, in runs with several sources
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
