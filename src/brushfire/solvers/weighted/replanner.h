// Replanner: costs that follow changes of weights, walls, fences, roads and sources, without starting anew.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     brushfire::Weights weights{.face = std::vector<double>(mesh.face_count(), 1.0)};
//     brushfire::Replanner planner(mesh, weights, {{brushfire::vertex_point(mesh, 0)}});
//     weights.face[1] = brushfire::kInfinity;  // a wall
//     planner.change(weights);
//     std::printf("vertex 2: %g, %.0f %% of the work of a run\n", planner.field().distance[2], 100 *
//     planner.renewed());
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/steiner/weights.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <memory>
#include <vector>

namespace brushfire {

struct ReplannerOptions {
  double tolerance = 0.01;  // as WeightedOptions::tolerance
  bool towards = false;     // as WeightedOptions::towards: for whoever is on the way to the sources
  Progress progress = {};
  const CancelToken* cancel = nullptr;  // null: what the thread listens to
};

// The upper bounds of a search over points on edges. After every change they are, to the bit, those of a new Replanner,
// and of WeightedSolver::distance() with lower = false where the weight is not one and the same everywhere; of two
// sources that are equally near the one that is named may be another.
//
// What a change costs is what it changes: paths over what has become dearer are forgotten, with all that is reached
// through them, and searched again from around. Something that changes far from the sources costs little, what changes
// beside the only source costs a run. Hence let the sources be what stays (the goal, with `towards`), and what moves be
// where paths are read off, which costs nothing. Fences that come or go, and walls that part the faces around a vertex,
// cut the mesh anew and lay points out anew, which takes some third of a run by itself. Not for use from several
// threads at once.
class Replanner {
 public:
  // Throws what WeightedSolver's constructor and distance() throw.
  Replanner(Domain domain, Weights weights, std::vector<Source> sources, ReplannerOptions options = {});
  ~Replanner();
  Replanner(Replanner&&) noexcept;
  Replanner& operator=(Replanner&&) noexcept;

  const Domain& domain() const noexcept;
  const Weights& weights() const noexcept;
  // Its `run` is what weighted_paths(field, targets) reads paths from.
  const WeightedField& field() const noexcept;
  // The share of the points on edges that the last change made anew; 1 after construction.
  double renewed() const noexcept;

  // Both throw as the constructor does, and then leave all as it was; after Error(Cancelled) the change is in, and the
  // next call computes everything.
  void change(Weights weights);
  void move(std::vector<Source> sources);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace brushfire
