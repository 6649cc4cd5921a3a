// The vertices of one part of the mesh: what a run knows of them, out of other parts' reach.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/solvers/windows/algebra/dominance.h>
#include <brushfire/solvers/windows/propagation/run_state.h>

#include <algorithm>
#include <cassert>
#include <unordered_map>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// All that a part reads or writes of RunState's arrays by vertex goes through here, so that parts can be at work side
// by side.
class OwnVertices {
 public:
  OwnVertices(RunState& run, Index part)
      : run_(&run),
        first_(run.structure.partition.first_vertex(part)),
        last_(run.structure.partition.end_vertex(part)) {}

  const VertexValues& operator[](Index v) const { return run_->values[own(v)]; }
  PseudoSource& pseudo_source(Index v) { return run_->pseudo_sources[own(v)]; }
  const PseudoSource& pseudo_source(Index v) const { return run_->pseudo_sources[own(v)]; }
  // For prefetching: where these are.
  const void* place_of_values(Index v) const { return run_->values.data() + v; }
  const void* place_of_pseudo_source(Index v) const { return run_->pseudo_sources.data() + v; }

  // A real path of this length leads to v.
  [[gnu::always_inline]] void reach(Index v, Real length) {
    VertexValues& at = run_->values[own(v)];
    if (at.upper == kInfinity) touch(v, length);
    fallen_.push_if((length < at.upper) & at.has_ghosts(), v);
    at.upper = std::min(at.upper, length);  // without a branch: it could not be predicted
  }
  // A window that sees v expects this distance.
  [[gnu::always_inline]] void expect(Index v, Real value, Real lift) {
    Real& estimate = run_->values[own(v)].estimate;
    estimate = std::min(estimate, value + lift);
  }
  // A window or a source sees v. False where that is nothing new.
  bool see(Index v, Real value, const Ray& ray);
  // The least value of v came straight from a source in one of its faces.
  void mark_direct(Index v) { run_->values[own(v)].direct = true; }
  // A ghost of v has these.
  void receive(Index v, Real upper, Real estimate);

  // By how much the distance may exceed the least value of v, and by how much it is expected to.
  Real slack(Index v) const { return std::max(Real{0}, (*this)[v].upper - (*this)[v].lower); }
  Real lift(Index v) const { return std::clamp((*this)[v].estimate - (*this)[v].lower, Real{0}, slack(v)); }
  // What is known at the ends of halfedge k of a face.
  EdgeBounds bounds(const WindowFace& f, Index k) const {
    const VertexValues &start = (*this)[f.vertex[k]], &end = (*this)[f.vertex[next3(k)]];
    return {f.length[k], std::min(start.upper, start.lower), std::min(end.upper, end.lower)};
  }
  Real nearer_end(const WindowFace& f, Index k) const {
    return std::min((*this)[f.vertex[k]].upper, (*this)[f.vertex[next3(k)]].upper);
  }

  // The source that a pseudo-source's paths begin at. Those in other parts have to be learned before.
  Index label_of(Index pseudo_source) const {
    const Index n = run_->structure.vertex_count();
    if (pseudo_source >= n) return pseudo_source - n;
    if (!run_->several) return 0;
    return first_ <= pseudo_source && pseudo_source < last_ ? run_->provenance[pseudo_source].label
                                                            : labels_.at(pseudo_source);
  }
  void learn_label(Index pseudo_source, Index label) { labels_[pseudo_source] = label; }

  // Vertices with ghosts whose upper bound fell since this was asked last, each once.
  template <class Visit>
  void take_fallen(Visit&& visit) {
    for (const Index v : fallen_) {
      if (!std::exchange(run_->values[v].sent, true)) visit(v);
    }
    fallen_.clear();
  }

  // Vertices whose entries have changed, each once.
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
  void forget();

 private:
  Index own(Index v) const {
    assert(first_ <= v && v < last_);
    return v;
  }
  void touch(Index v, Real length) {
    if (!(length < kInfinity)) return;
    if (touched_ < room_for_touched()) list_of_touched()[touched_] = v;
    ++touched_;
  }
  // They are listed as long as they are few: going through all costs less than a long list.
  Index* list_of_touched() const { return run_->touched.data() + first_ / kFewTouched; }
  Index room_for_touched() const { return last_ / kFewTouched - first_ / kFewTouched; }

  RunState* run_;
  Index first_, last_;
  Index touched_ = 0;
  Pile fallen_;                              // with repetitions
  std::unordered_map<Index, Index> labels_;  // of pseudo-sources in other parts, in runs with several sources
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
