// The driver: sources, rounds in which the parts of the mesh work side by side, and messages between them.
//
// L1 ... L10 are the lemmas of docs/tolerance.md. Every write to a vertex is the length of a real path (to rounding),
// and a window or a part of one is dropped only where another real path is shown to be shorter; so order does not
// matter to the result, only to the time. That is why the parts of a mesh can be left alone with their events for a
// bucket of values at a time, and receive messages only then. What a part does depends on these alone, and they
// are delivered in a fixed order: the numbers are the same for any number of threads.
#include <brushfire/core/error.h>
#include <brushfire/solvers/partition/rounds.h>
#include <brushfire/solvers/partition/worker_team.h>
#include <brushfire/solvers/windows/engine.h>
#include <brushfire/solvers/windows/paths/results.h>
#include <brushfire/solvers/windows/propagation/arrivals.h>
#include <brushfire/solvers/windows/propagation/circled_faces.h>
#include <brushfire/solvers/windows/propagation/least_budget.h>
#include <brushfire/solvers/windows/propagation/part.h>
#include <brushfire/solvers/windows/propagation/prefetching.h>
#include <brushfire/solvers/windows/propagation/pseudo_sources.h>
#include <brushfire/solvers/windows/propagation/run_state.h>
#include <brushfire/solvers/windows/propagation/sink.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// Exact runs are quicker with narrower buckets.
constexpr double kExactBucket = 0.2;

// What working on a part takes in a round, more or less.
constexpr std::chrono::microseconds kStealAfter{20};

class WindowEngine final : public NumberedEngine {
 public:
  WindowEngine(const Mesh& mesh, unsigned part_bits, Merging merging)
      : run_(mesh, part_bits), merging_(merging), benches_(1) {
    const Index n = run_.structure.vertex_count();
    run_.values.resize(n);
    run_.structure.partition.for_each_ghost([&](Index v, Index ghost) { run_.values[v].next_ghost = ghost; });
    run_.pseudo_sources.resize(n);
    run_.touched.resize(n / kFewTouched + 1);
    for (Index p = 0; p < run_.structure.part_count(); ++p) parts_.emplace_back(run_, p);
  }

  bool has_spines() const override { return run_.structure.has_spines; }
  bool lists_touched() const override { return true; }
  double doubt() const override { return run_.rounding.doubt; }
  double absolute_rounding() const override { return run_.rounding.absolute; }

  void solve(const detail::Problem& problem, DistanceField& field) override {
    field_ = &field;
    forget();
    prepare(problem);
    Results results(run_, parts_, field);
    for (const detail::LocatedSource& s : problem.sources) start(s);
    deliver(results);
    drain(results);
    results.write(scratch_, workers_.team());
  }

 private:
  // ---- set-up and reset

  void forget() {
    const auto forget_part = [&](unsigned, std::size_t p) { parts_[p].forget(); };
    if (workers_.team()) {
      workers_.team()->run(parts_.size(), forget_part);
    } else {
      for (std::size_t p = 0; p < parts_.size(); ++p) forget_part(0, p);
    }
    for (const Index p : active_) {  // left over from a run that was stopped
      spare_.push_back(parts_[p].retire());
    }
    if (!active_.empty()) {
      for (Workbench& b : benches_) b.blocks.clear();
    }
    active_.clear();
    run_.targets.clear(run_.structure);
    circled_.clear(run_.structure);
  }

  void prepare(const detail::Problem& problem) {
    run_.problem = &problem;
    run_.shift = -std::min_element(problem.sources.begin(), problem.sources.end(), [](const auto& a, const auto& b) {
                    return a.offset < b.offset;
                  })->offset;
    run_.radius = problem.max_distance + run_.shift;
    run_.several = problem.sources.size() > 1;
    if (run_.several) run_.provenance.resize(run_.values.size());
    if (run_.keeps_rays()) run_.rays.resize(run_.values.size());
    run_.budget = budget_of(*problem.options, run_.rounding, merging_ == Merging::Always ? 0 : least_share(outlook()));
    run_.in_lists = !kWide && !run_.merges();
    run_.bucket_width = run_.in_lists ? kExactBucket * run_.structure.bucket_width : run_.structure.bucket_width;
    run_.targets.place(problem.targets, run_.structure);
    circled_.mark(problem.sources, run_.structure);
    next_target_check_ = problem.targets.empty() ? std::numeric_limits<std::uint64_t>::max() : 0;
    bucket_ = 0;
    updates_ = 0;
    workers_.assemble(problem.options->threads, parts_.size());
    benches_.resize(std::max<std::size_t>(benches_.size(), workers_.size()));
  }

  MergeOutlook outlook() const {
    return {static_cast<double>(run_.structure.mesh.vertex_count()), static_cast<double>(run_.problem->sources.size()),
            run_.structure.typical_deficit};
  }

  // ---- sources

  using EndsInFace = std::vector<SegmentEnd>;

  void start(const detail::LocatedSource& s) {
    const Index pseudo_source = run_.structure.vertex_count() + s.label;
    const Real sigma = s.offset + run_.shift;
    if (!s.curve) return start_at(s.at, sigma, pseudo_source, [](Index) { return EndsInFace{}; });
    const Mesh& mesh = run_.structure.mesh;
    for (Index i = 0; i < s.curve->segments.size(); ++i) {
      for_each_face_of(mesh, *s.curve, i, sigma, [&](SegmentInFace segment) {
        segment.face = run_.structure.inner_face(segment.face);
        start_along(active_part(run_.structure.part_of_face(segment.face)), segment, pseudo_source);
      });
    }
    for (const CurvePlace& p : s.curve->places) {
      start_at(p.at, sigma + p.offset, pseudo_source, [&](Index face) { return ends_in(*s.curve, p, face, sigma); });
    }
  }

  // The segments of a curve that end in the place and lie in a face.
  EndsInFace ends_in(const LocatedCurve& curve, const CurvePlace& place, Index face, Real start) const {
    EndsInFace ends;
    for (const bool is_first : {false, true}) {
      const Index i = is_first ? place.after : place.before;
      if (i == kNoIndex) continue;
      if (const auto s = segment_in_face(run_.structure.mesh, curve, i, face, start)) ends.push_back({*s, is_first});
    }
    return ends;
  }

  // `ends_in`: the ends of segments there, by the mesh's face.
  template <class EndsIn>
  void start_at(const PointLocation& at, Real sigma, Index pseudo_source, EndsIn&& ends_in) {
    const WindowStructure& structure = run_.structure;
    if (at.on == PointLocation::On::Vertex) {
      const Index v = structure.inner_vertex(at.vertex);
      start_at_vertex(active_part(structure.part_of_vertex(v)), v, sigma, pseudo_source);
      return;
    }
    for_each_face_around(structure.mesh, at, [&](const FaceWeights& f) {
      const Index face = structure.inner_face(f.face);
      start_in_face(active_part(structure.part_of_face(face)), {face, f.weights}, sigma, pseudo_source,
                    ends_in(f.face));
    });
  }

  // ---- rounds

  void drain(Results& results) {
    while (next_round()) {
      workers_.work(due_, [this](unsigned worker, Index p) { parts_[p].work(bucket_, benches_[worker]); });
      deliver(results);
      look_up();
      retire();
    }
  }

  // The parts that have something to do in the next bucket in which any has. False where none has.
  bool next_round() {
    const auto outlook_of = [&](Index p) { return parts_[p].outlook(); };
    bucket_ = partition::next_round(active_, std::numeric_limits<std::int64_t>::min(), outlook_of, due_);
    return !due_.empty();
  }

  void retire() {
    std::erase_if(active_, [&](Index p) {
      if (!parts_[p].is_idle()) return false;
      spare_.push_back(parts_[p].retire());
      return true;
    });
  }

  // To give something to a part while none is at work.
  PartState& active_part(Index p) {
    if (!parts_[p].is_active()) {
      if (spare_.empty()) spare_.push_back(std::make_unique<Activity>());
      parts_[p].activate(std::move(spare_.back()), bucket_);
      spare_.pop_back();
      active_.push_back(p);
    }
    return parts_[p].at(benches_.front());
  }

  // What has to be seen to between rounds: progress, cancelling, targets.
  void look_up() {
    constexpr std::uint64_t kOften = 1024, kSeldom = 64 * kOften;
    const std::uint64_t before = updates_;
    for (const partition::Due& d : due_) updates_ += parts_[d.part].count_updates();
    field_->updates = updates_;
    const DistanceOptions& options = *run_.problem->options;
    if (updates_ / kOften != before / kOften && run_.problem->cancel && run_.problem->cancel->cancelled()) {
      throw Error(ErrorCode::Cancelled, "cancelled");
    }
    if (updates_ / kSeldom != before / kSeldom && options.progress) options.progress(share_done());
    if (updates_ >= next_target_check_) narrow_radius();
  }

  double share_done() const {
    std::size_t touched = 0;
    for (const Part& p : parts_) touched += p.vertices().touched_count();
    return static_cast<double>(touched) / run_.structure.vertex_count();
  }

  // Nothing beyond the farthest target matters once all have been reached. Some path may come to less than the light
  // that a target is read from, by rounding.
  void narrow_radius() {
    next_target_check_ = updates_ + run_.targets.size() + 256;
    Real farthest = 0;
    for (Index i = 0; i < run_.targets.size(); ++i) {
      const PointLocation& at = run_.problem->targets[i];
      const bool vertex = at.on == PointLocation::On::Vertex;
      farthest = std::max(farthest,
                          vertex ? run_.values[run_.structure.inner_vertex(at.vertex)].upper : run_.targets[i].upper);
    }
    run_.radius = std::min(run_.radius, farthest / kDominated + run_.rounding.of(to_double(farthest)));
  }

  // ---- messages

  // Until nobody has any more: windows that pass at once (see enter_face()) may be sent on.
  void deliver(Results& results) {
    for (bool any = true; any;) {
      any = false;
      // It may grow. NOLINTNEXTLINE(modernize-loop-convert)
      for (std::size_t i = 0; i < active_.size(); ++i) {
        Outbox& messages = parts_[active_[i]].outbox();
        if (messages.empty()) continue;
        any = true;
        deliver(messages, results);
        messages.clear();
      }
    }
  }

  void deliver(const Outbox& messages, Results& results) {
    const WindowStructure& structure = run_.structure;
    for (const LabelMessage& m : messages.all<LabelMessage>())
      parts_[m.part].vertices().learn_label(m.pseudo_source, m.label);
    prefetch_receivers(run_, messages);
    for (const FallenMessage& m : messages.all<FallenMessage>()) tell_ghosts(m.vertex);
    for (const ArrivalMessage& m : messages.all<ArrivalMessage>()) {
      receive(active_part(structure.part_of_vertex(m.vertex)), m);
    }
    for (const TargetMessage& m : messages.all<TargetMessage>()) {
      results.offer_target(m.target, m.value, m.slack, m.lift, m.ray, m.straight);
    }
    for (const WindowMessage& m : messages.all<WindowMessage>()) {
      receive(active_part(structure.part_of_face(m.halfedge / 3)), m);
    }
    for (const ListMessage& m : messages.all<ListMessage>()) {
      receive(active_part(structure.part_of_face(m.halfedge / 3)), m);
    }
  }

  void tell_ghosts(Index v) {
    VertexValues& at = run_.values[v];
    at.sent = false;
    for (Index c = at.next_ghost; c != v; c = run_.values[c].next_ghost) {
      parts_[run_.structure.part_of_vertex(c)].vertices().receive(c, at.upper, at.estimate);
    }
  }

  RunState run_;
  Merging merging_;
  std::vector<Part> parts_;
  CircledFaces circled_;
  std::vector<Index> active_;        // parts in which something waits
  std::vector<partition::Due> due_;  // those with something to do in this round
  std::vector<std::unique_ptr<Activity>> spare_;
  partition::WorkerTeam workers_{kStealAfter};
  std::vector<Workbench> benches_;  // [threads]
  std::vector<Index> scratch_;
  DistanceField* field_ = nullptr;
  std::int64_t bucket_ = 0;  // number of the bucket
  std::uint64_t updates_ = 0;
  std::uint64_t next_target_check_ = 0;
};

}  // namespace

std::unique_ptr<NumberedEngine> make_engine(const Mesh& mesh, unsigned part_bits, Merging merging) {
  return std::make_unique<WindowEngine>(mesh, part_bits, merging);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
