// What a run promises, and which value it gives out between a proven lower and a proven upper bound.
// See "What is given out" in docs/tolerance.md.
#pragma once

#include <brushfire/solvers/distance.h>
#include <brushfire/solvers/windows/algebra/merge.h>
#include <brushfire/solvers/windows/propagation/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// The part of a tolerance that is kept back for rounding, so that the promise holds to the letter: what rounding does
// on even meshes, and what more it does on this one, to the nearest of vertices.
inline constexpr double kReserve = 4e-12;
inline double reserve_of(const Rounding& rounding) {
  return std::max(kReserve, 2 * (rounding.relative + rounding.doubt + rounding.each_face * rounding.faces));
}
// What adding the source's offset rounds away.
inline constexpr double kOffsetRounding = 8 * std::numeric_limits<double>::epsilon();

// What merges may spend: nothing in exact runs, nor where it would be less than `least` of the length.
inline MergeBudget budget_of(const DistanceOptions& options, const Rounding& rounding, double least) {
  if (options.method == Method::Exact) return {};
  const double promise = options.tolerance - 1.01 * reserve_of(rounding);
  const double share = options.bound == Bound::Estimate ? 2 * promise : promise;
  return {share < std::max(least, std::numeric_limits<double>::min()) ? 0 : share};
}

// A value, how far it may be off, and that as a share of the path's length.
struct CertifiedValue {
  Real value;
  double bound, relative;
};

// For lower <= distance <= upper, to rounding, of a place whose paths begin with the value `start`, all of them raised
// by `shift`; `share`: of the budget, 0 where the run was exact. A bound that is wanted stays on its side whatever
// rounding did. `is_beside`: the value is `start` or less, to rounding, and the place is none that is known to be at
// the source: parallel light beside its segment.
inline CertifiedValue certified_value(Real lower, Real upper, Real estimate, Real start, Real shift, double share,
                                      const Rounding& rounding, Bound wanted, bool is_beside) {
  lower = std::min(lower, upper);                                    // in exact runs they differ by rounding
  if (lower < start) lower = start, upper = std::max(upper, start);  // no path is shorter than nothing
  const Real length = lower - start;
  const bool exact = !(share > 0);
  if (exact) upper = lower;
  const double of_offset = kOffsetRounding * (std::abs(to_double(start)) + std::abs(to_double(shift)));
  const double rounded = (is_beside ? rounding.absolute : rounding.of(to_double(length))) + of_offset;
  Real value = lower;
  switch (wanted) {
    case Bound::Lower:
      value = std::max(lower - rounded, start - of_offset);
      break;
    case Bound::Upper:
      value = upper + rounded;
      break;
    case Bound::Estimate: {
      if (exact) break;
      // Anywhere within t of both ends: there is such a place because upper - lower <= 2 t length.
      const Real reach = 0.5 * share * length;
      const Real least = std::min(upper - reach, upper), most = std::max(lower + reach, lower);
      value = std::clamp(std::clamp(estimate, lower, upper), least, std::max(least, most));
      break;
    }
  }
  const double bound = to_double(std::max(value - lower, upper - value)) + rounded;
  return {value, bound, length > 0 ? (bound - of_offset) / to_double(length) : 0};
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
