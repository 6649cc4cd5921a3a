// The heat method on its own: for many right-hand sides on one mesh. (One field at a time: distance() with
// Method::Heat, which computes the same.)
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/heat_options.h>

#include <memory>
#include <span>
#include <vector>

namespace brushfire {

// Two linear systems, factored once. The results approximate the distance on the smooth surface that the mesh stands
// for, not that on its faces, and have no bound; docs/heat.md says how good they are. Safe to use from several threads.
//
// Based on: Crane, Weischedel, Wardetzky, "The heat method for distance computation", 2017.
class HeatSolver {
 public:
  // Any mesh; walls are borders of what is open. Throws Error(InvalidArgument) for options out of range, and without
  // Eigen. Some 5 microseconds and 600 bytes a vertex on scans.
  explicit HeatSolver(const Domain& domain, const HeatOptions& options = {});
  ~HeatSolver();
  HeatSolver(HeatSolver&&) noexcept;
  HeatSolver& operator=(HeatSolver&&) noexcept;

  // One row for each set of sources: the distance from the nearest of them, [sets * vertex_count] in units of the mesh;
  // +inf where no path leads; on a wall the least of its sides. Every source reads its own offset, except those that
  // another one's front reaches sooner. Eight rows at a time cost a third of what they cost one by one. Throws as
  // distance() does.
  std::vector<double> distances(std::span<const std::vector<Source>> sets) const;
  std::vector<double> distance(std::span<const Source> sources) const;

  double time() const;              // in units of the mesh squared
  double mean_edge_length() const;  // of the triangulation that is computed on
  const Mesh& mesh() const;         // the whole

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace brushfire
