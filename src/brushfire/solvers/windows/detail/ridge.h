// Where two windows on one edge have the same value.
#pragma once

#include <brushfire/solvers/windows/detail/window.h>

namespace brushfire::detail {

// Where the slopes of two windows are equal: the line through both sources meets the edge there. The difference of the
// values is monotone on either side, so its signs at two places and at this one decide everything between them.
// Returns a place outside of every edge (infinity) where there is none.
inline double equal_slope(const Window& a, const Window& b) {
  const double along = origin_weight(a.kind) * b.source.y - origin_weight(b.kind) * a.source.y;
  return along == 0 ? kInfinity : cross(a.source, b.source) / along;
}

// Values closer than this are a tie: rounding of the two square roots and sums that made them. Whoever wins a tie, the
// other is at most this much better.
inline double tie(double value) { return 8 * std::numeric_limits<double>::epsilon() * std::abs(value); }

// The place in [p,q] where a and b have the same value; fp, fq = a-b there, of opposite signs. A place that is off by
// rounding costs nothing: the windows' cones overlap beyond it.
double ridge(const Window& a, const Window& b, double p, double q, double fp, double fq);

}  // namespace brushfire::detail
