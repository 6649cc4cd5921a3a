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

// |x-a| - |x-b| = d  for x on the edge, squared twice: with L(x) = |x-a|^2 - |x-b|^2 - d^2 = slope x + rest, linear,
// L(x) = 2 d |x-b|, so L^2 = 4 d^2 |x-b|^2 with the root where L and d have the same sign. Origin at p, so that short
// intervals keep their digits. Returns x - p, in [0, length], or -1 where rounding leaves none or both roots.
inline double ridge_in_closed_form(Vec2 a, Vec2 b, double d, double p, double length) {
  const double ax = a.x - p, bx = b.x - p;
  const double slope = 2 * (bx - ax);
  const double rest = (ax - bx) * (ax + bx) + (a.y - b.y) * (a.y + b.y) - d * d;
  if (d == 0) return -rest / slope;
  const double qa = slope * slope - 4 * d * d;
  const double qb = slope * rest + 4 * d * d * bx;
  const double qc = rest * rest - 4 * d * d * (bx * bx + b.y * b.y);
  const double discriminant = qb * qb - qa * qc;
  if (!(discriminant >= 0)) return -1;
  const double sum = -(qb + std::copysign(std::sqrt(discriminant), qb));
  const auto fits = [&](double x) { return x >= 0 && x <= length && (slope * x + rest) * d >= 0; };
  const double x1 = sum / qa, x2 = qc / sum;
  if (fits(x1) == fits(x2)) return -1;
  return fits(x1) ? x1 : x2;
}

// The place in [p,q] where a and b have the same value; fp, fq = a-b there, of opposite signs. A place that is off by
// rounding costs nothing: the windows' cones overlap beyond it.
double ridge(const Window& a, const Window& b, double p, double q, double fp, double fq);

}  // namespace brushfire::detail
