// What a straight step costs before its weight: its length, or the pace at its slope.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/steiner/slope_pace.h>

#include <algorithm>
#include <cmath>

namespace brushfire::steiner {

struct Travel {
  const SlopePace* pace = nullptr;  // null: lengths
  bool towards = false;             // what is searched from is gone to: uphill is downhill

  // `rise`: the height gained on the way on which the search goes.
  double cost(double length, double rise) const {
    if (pace == nullptr || length == 0) return length;
    const double on_map = std::sqrt(std::max(0.0, (length - rise) * (length + rise)));
    const double gained = towards ? -rise : rise;
    return on_map > 0 ? on_map * (*pace)(gained / on_map) : kInfinity;
  }
};

}  // namespace brushfire::steiner
