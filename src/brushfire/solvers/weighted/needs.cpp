// Bounds come nearer by the square of the step: a quarter for each refinement, where they do.
#include <brushfire/solvers/weighted/detail/needs.h>

#include <algorithm>
#include <cmath>

namespace brushfire::weighted {
namespace {

// Each refinement makes bounds so many times as near, as far as theory goes.
constexpr double kNearer = 4;
// Where it is less than this, rounding or a needle says what bounds are.
constexpr double kHardly = 1.1;
// Twice the points on an edge are four times the pairs; windows that may lose a quarter are half as long.
constexpr double kTimePoints = 4, kTimeWindows = 2;
// Points on edges beyond those cannot be counted.
constexpr double kMostRefinements = 30;

}  // namespace

WeightedNeeds needs_of(const WeightedField& field, double tolerance, double bound_before) {
  WeightedNeeds needs;
  const double bound = field.max_error_bound;
  if (field.lower.empty() || bound <= tolerance) return needs;
  const double nearer = bound_before < kInfinity ? bound_before / bound : kNearer;
  const double more = std::ceil(std::log(bound / tolerance) / std::log(std::clamp(nearer, kHardly, kNearer)));
  needs.is_reachable = nearer >= kHardly && more <= kMostRefinements;
  needs.refinements = static_cast<unsigned>(std::min(more, kMostRefinements));
  const double time = field.engine == WeightedEngine::Points ? kTimePoints : kTimeWindows;
  needs.time = std::pow(time, needs.refinements);
  if (field.points > 0 && needs.is_reachable) needs.points = field.points << needs.refinements;
  return needs;
}

}  // namespace brushfire::weighted
