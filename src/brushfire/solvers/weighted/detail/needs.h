// What it would take to meet a tolerance.
#pragma once

#include <brushfire/solvers/weighted/weighted_distance.h>

namespace brushfire::weighted {

// By the run that has given `field`, and the greatest error bound of the one before; +inf: there was none.
WeightedNeeds needs_of(const WeightedField& field, double tolerance, double bound_before);

}  // namespace brushfire::weighted
