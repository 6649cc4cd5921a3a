// What is read off at the end of a run.
#pragma once

#include <brushfire/core/parallel.h>
#include <brushfire/solvers/windows/paths/point_values.h>
#include <brushfire/solvers/windows/propagation/part.h>
#include <brushfire/solvers/windows/propagation/run_state.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

class Results {
 public:
  Results(RunState& run, std::span<Part> parts, DistanceField& field);

  // Keeps the best path to a target; see reach_target().
  void offer_target(Index target, Real value, Real slack, Real lift, const Ray& ray, bool straight = true);
  // The field, and what paths need later where that is wanted. `scratch` is room to work in; `team` may be null.
  void write(std::vector<Index>& scratch, ThreadTeam* team);

 private:
  Index label_of(Index pseudo_source) const;
  VertexValues with_ghosts(Index v) const;
  bool is_owner(Index v) const;
  std::optional<Real> chord_to(Index outer, const VertexValues& values, Index label) const;
  bool is_place(Index outer, Index label) const;
  CertifiedValue read(Real lower, Real upper, Real estimate, Index label, const Rounding& rounding,
                      Index outer = kNoIndex) const;
  Index outer_pseudo_source(Index pseudo_source) const;
  Ray outer(Ray ray) const;
  void finish_targets();
  void finish_labels(std::vector<Index>& chain);
  // What is counted on the way.
  struct Tally {
    Index beyond_radius = 0;
    double largest_bound = 0;
    Index seen = 0;
    std::vector<Index> unseen;  // by the mesh's numbers: those that a path leads to, but no light
  };
  void write_vertices(ThreadTeam* team);
  Tally write_vertices(const Part& part);
  void write_unseen(std::vector<Index> unseen, Index seen);
  void write_unseen(Index outer, Index before, Real along_edge);
  void write_targets();
  void keep();
  std::shared_ptr<const PointValues> point_values();  // null where not all windows were kept

  RunState& run_;
  std::span<Part> parts_;
  DistanceField& field_;
  std::vector<std::pair<Index, Index>> places_;  // label and vertex of places of curves that have their least value
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
