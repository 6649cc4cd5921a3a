// What a run promises, and which value it gives out between a proven lower and a proven upper bound.
// See "What is given out" in docs/tolerance.md.
#pragma once

#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/detail/merge.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

// The part of a tolerance that is kept back for rounding, so that the promise holds to the letter.
inline constexpr Real kRounding = 4e-12;
// What adding the source's offset rounds away.
inline constexpr Real kOffsetRounding = 8 * std::numeric_limits<Real>::epsilon();
// The relative error of exact runs, measured to be 1e-13 at most.
inline constexpr Real kExactBound = 1e-12;

// What merges may spend: nothing in exact runs, nor where it would be less than `least` of the length.
inline MergeBudget budget_of(const DistanceOptions& options, Real least) {
  if (options.method == Method::Exact) return {};
  const Real promise = options.tolerance - 1.01 * kRounding;
  const Real share = options.bound == Bound::Estimate ? 2 * promise : promise;
  return {share < least ? 0 : share};
}

// A value, how far it may be off, and that as a share of the path's length.
struct Reading {
  Real value, bound, relative;
};

// For lower <= distance <= upper of a place whose paths begin with the value `start`; `share`: of the budget, 0 where
// the run was exact.
inline Reading read(Real lower, Real upper, Real estimate, Real start, Real share, Bound wanted) {
  const Real of_offset = kOffsetRounding * abs(start);
  lower = std::min(lower, upper);  // in exact runs they differ by rounding
  const Real length = lower - start;
  if (!(share > 0)) return {lower, kExactBound * length + of_offset, kExactBound};
  Real value = lower;
  switch (wanted) {
    case Bound::Lower:
      break;
    case Bound::Upper:
      value = upper;
      break;
    case Bound::Estimate: {
      // Anywhere within t of both ends: there is such a place because upper - lower <= 2 t length.
      const Real reach = 0.5 * share * length;
      const Real least = std::min(upper - reach, upper), most = std::max(lower + reach, lower);
      value = std::clamp(std::clamp(estimate, lower, upper), least, std::max(least, most));
      break;
    }
  }
  const Real bound = std::max(value - lower, upper - value) + kRounding * length;
  return {value, bound + of_offset, length > 0 ? bound / length : 0};
}

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
