// Where two windows on one edge have the same value.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Where the slopes of two windows are equal: the line through both sources meets the edge there. The difference of the
// values is monotone on either side, so its signs at two places and at this one decide everything between them.
// Returns a place outside of every edge (infinity) where there is none.
inline Real equal_slope(const Window& a, const Window& b) {
  const Real along = origin_weight(a.kind) * b.source.y - origin_weight(b.kind) * a.source.y;
  return along == 0 ? kInfinity : cross(a.source, b.source) / along;
}

// Values closer than this are a tie: rounding of the two square roots and sums that made them. Whoever wins a tie, the
// other is at most this much better.
inline Real tie(Real value) { return 8 * kEpsilon * abs(value); }

// What light that has come through a few frames may have been moved by, to and fro: some epsilons of the longest number
// that describes it. Of parallel light, whose values are differences of such numbers, that is more than any epsilon of
// the value.
inline Real moved(const Window& w) { return 32 * kEpsilon * (extent_of(w) + w.b1); }

// |x-a| - |x-b| = d  for x on the edge, squared twice: with L(x) = |x-a|^2 - |x-b|^2 - d^2 = slope x + rest, linear,
// L(x) = 2 d |x-b|, so L^2 = 4 d^2 |x-b|^2 with the root where L and d have the same sign. Origin at p, so that short
// intervals keep their digits. Returns x - p, in [0, length], or -1 where rounding leaves none or both roots.
inline Real tie_point_in_closed_form(Vec2 a, Vec2 b, Real d, Real p, Real length) {
  const Real ax = a.x - p, bx = b.x - p;
  const Real slope = 2 * (bx - ax);
  const Real rest = (ax - bx) * (ax + bx) + (a.y - b.y) * (a.y + b.y) - d * d;
  if (d == 0) return -rest / slope;
  const Real qa = slope * slope - 4 * d * d;
  const Real qb = slope * rest + 4 * d * d * bx;
  const Real qc = rest * rest - 4 * d * d * (bx * bx + b.y * b.y);
  const Real discriminant = qb * qb - qa * qc;
  if (!(discriminant >= 0)) return -1;
  const Real sum = -(qb + copysign(sqrt(discriminant), qb));
  const auto fits = [&](Real x) { return x >= 0 && x <= length && (slope * x + rest) * d >= 0; };
  const Real x1 = sum / qa, x2 = qc / sum;
  if (fits(x1) == fits(x2)) return -1;
  return fits(x1) ? x1 : x2;
}

// The place in [p,q] where a and b have the same value; fp, fq = a-b there, of opposite signs. A place that is off by
// rounding costs nothing: the windows' cones overlap beyond it.
Real tie_point(const Window& a, const Window& b, Real p, Real q, Real fp, Real fq);

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
