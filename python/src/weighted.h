// _core.WeightedSolver, and what is shared with what follows changes of weights.
#pragma once

#include "bind.h"

#include <brushfire/queries/weighted_path.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <memory>
#include <mutex>

namespace brushfire::python {

// `slope`: the name of a pace, or slopes and the paces there. Throws Error(InvalidArgument) and Error(IndexOutOfRange).
Weights weights_from(const Domain& domain, const std::optional<Vector<double>>& face,
                     const Vector<std::int64_t>& edge_vertices, const Vector<double>& along,
                     const Vector<double>& crossing, const std::string& slope,
                     const std::optional<Vector<double>>& slopes, const std::optional<Vector<double>>& paces,
                     double steepest, bool tacking, const std::optional<Vector<double>>& grain);

// Calls from several threads wait for each other.
class Weighted {
 public:
  Weighted(const Domain& domain, const std::optional<Vector<double>>& face, const Vector<std::int64_t>& edge_vertices,
           const Vector<double>& along, const Vector<double>& crossing, const std::string& slope,
           const std::optional<Vector<double>>& slopes, const std::optional<Vector<double>>& paces, double steepest,
           bool tacking, const std::optional<Vector<double>>& grain)
      : solver_(domain, weights_from(domain, face, edge_vertices, along, crossing, slope, slopes, paces, steepest,
                                     tacking, grain)) {}

  const Mesh& mesh() const { return solver_.domain().mesh(); }

  // The last one is kept.
  std::shared_ptr<const Weighting> weighting(const WeightingOptions& options) {
    const std::lock_guard lock(mutex_);
    if (!weighting_ || weighting_->options().tolerance != options.tolerance ||
        weighting_->options().towards != options.towards || weighting_->options().marching != options.marching) {
      weighting_ = std::make_shared<const Weighting>(solver_.domain(), solver_.weights(), options);
    }
    return weighting_;
  }

  template <class Use>
  auto with(Use&& use) {
    const std::lock_guard lock(mutex_);
    return use(solver_);
  }

 private:
  WeightedSolver solver_;
  std::shared_ptr<const Weighting> weighting_;
  std::mutex mutex_;
};

// (path, cost, lower, legs: face, length, weight, toll, edge [legs, 2]).
nb::tuple path_arrays(const WeightedPath& path);

}  // namespace brushfire::python
