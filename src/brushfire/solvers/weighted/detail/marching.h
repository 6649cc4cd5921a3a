// Costs by fast marching: no bounds, at its speed.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/steiner/detail/weighted_mesh.h>
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <memory>
#include <span>

namespace brushfire::weighted {

// Throws Error(InvalidArgument) where edges have costs of their own or slopes count.
std::unique_ptr<detail::Engine> make_march(const steiner::WeightedMesh& mesh, const Weights& weights);

// Throws Error(InvalidArgument) for curves, and as WeightedSolver::distance() does.
WeightedField march(const std::shared_ptr<const steiner::WeightedMesh>& mesh, detail::Engine& engine,
                    std::span<const Source> sources, const WeightedOptions& options);

}  // namespace brushfire::weighted
