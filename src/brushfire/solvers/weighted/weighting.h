// Weighting: costs in place of distances, for everything that takes DistanceOptions.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const brushfire::Weights weights{.face = std::vector<double>(mesh.face_count(), 2.0)};
//     const auto weighting = std::make_shared<const brushfire::Weighting>(mesh, weights);
//     const brushfire::Samples spread = brushfire::farthest_points(mesh, 10, {}, {.weighting = weighting});
//     std::printf("all is within a cost of %g\n", spread.covering_radius);
#pragma once

#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/steiner/weights.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <memory>
#include <optional>

namespace brushfire {

namespace detail {
class CostRuns;
}

struct WeightingOptions {
  double tolerance = 0.01;                        // as WeightedOptions::tolerance
  bool towards = false;                           // as WeightedOptions::towards
  std::optional<Method> marching = std::nullopt;  // as WeightedOptions::marching
};

// A domain and what it costs to go there, prepared once: a run reads it and changes nothing, so that any number of
// threads may compute from one of these. In DistanceOptions it turns distances into what WeightedSolver computes: upper
// bounds, or lower ones where DistanceOptions::bound says so, and then with their error bounds; max_distance and
// radii are costs. Method, tolerance, precision and threads of those options do not count. What needs the windows of
// exact distances (keep_paths, keep_windows) is refused: weighted_paths() has the paths.
//
// Faces and crossings of cost +inf are walls like any others: domain() has them beside those that were given, and
// queries must be asked in it.
class Weighting {
 public:
  // Throws as check(mesh, weights) does, for a tolerance that is out of range, and Error(TooLarge) where the points
  // need more memory than there is. O(points on edges).
  Weighting(const Domain& domain, Weights weights, const WeightingOptions& options = {});
  virtual ~Weighting() = default;

  const Domain& domain() const { return domain_; }
  const Weights& weights() const { return weights_; }
  const WeightingOptions& options() const { return options_; }

  // A solver of its own for a thread: O(1), what was prepared is shared.
  WeightedSolver solver() const { return prototype_.twin(); }

  // What queries ask of it, who link what computes costs only where there is a Weighting: hence virtual.

  // The same solver, which answers as distance() does.
  virtual std::unique_ptr<detail::CostRuns> runs() const;
  // The same costs for domain().open() as a mesh without walls, in its numbers. O(points).
  virtual std::shared_ptr<const Weighting> on_open() const;
  // What it costs to go along an edge within a face of domain().mesh(), between two of its corners (0, 1, 2).
  virtual double along(Index face, Index from, Index to) const;

 private:
  Domain domain_;
  Weights weights_;
  WeightingOptions options_;
  WeightedSolver prototype_;
};

// The walls among weights: faces and crossings that cost +inf.
Barriers walls_of(const Weights& weights);
// A domain with further walls in it, named by the numbers of domain.mesh(). O(vertices + faces).
Domain with_walls(const Domain& domain, Barriers more);

}  // namespace brushfire
