// The crossing of two windows: closed form, checked, with a bracketed search behind it.
#include <brushfire/solvers/windows/detail/ridge.h>

namespace brushfire::detail {
namespace {

// |x-a| - |x-b| = D, D = b.sigma - a.sigma, squared twice: with L(x) = |x-a|^2 - |x-b|^2 - D^2 = slope x + rest,
// linear, L(x) = 2 D |x-b|, so L^2 = 4 D^2 |x-b|^2 with the root where L and D have the same sign. Origin at p, so that
// short intervals keep their digits. Returns -1 where rounding leaves none or both roots.
double closed_form(const Window& a, const Window& b, double p, double length) {
  const double d = b.sigma - a.sigma;
  const double ax = a.source.x - p, bx = b.source.x - p, ay = a.source.y, by = b.source.y;
  const double slope = 2 * (bx - ax);
  const double rest = (ax - bx) * (ax + bx) + (ay - by) * (ay + by) - d * d;
  if (d == 0) return -rest / slope;
  const double qa = slope * slope - 4 * d * d;
  const double qb = slope * rest + 4 * d * d * bx;
  const double qc = rest * rest - 4 * d * d * (bx * bx + by * by);
  const double discriminant = qb * qb - qa * qc;
  if (!(discriminant >= 0)) return -1;
  const double sum = -(qb + std::copysign(std::sqrt(discriminant), qb));
  const auto fits = [&](double x) { return x >= 0 && x <= length && (slope * x + rest) * d >= 0; };
  const double x1 = sum / qa, x2 = qc / sum;
  if (fits(x1) == fits(x2)) return -1;
  return fits(x1) ? x1 : x2;
}

}  // namespace

double ridge(const Window& a, const Window& b, double p, double q, double fp, double fq) {
  const auto difference = [&](double x) { return value_at(a, x) - value_at(b, x); };
  if (a.kind == WindowKind::Circular && b.kind == WindowKind::Circular) {
    const double x = p + closed_form(a, b, p, q - p);
    if (x >= p && x <= q && std::abs(difference(x)) <= tie(value_at(a, x))) return x;
  }
  // Illinois: false position that halves the weight of an end which has stayed twice; bisection from then on.
  constexpr int kFalsePositions = 24, kSteps = 90;
  double x = p;
  int stayed = 0;
  for (int step = 0; step < kSteps; ++step) {
    x = step < kFalsePositions ? p + (q - p) * (fp / (fp - fq)) : 0.5 * (p + q);
    x = std::clamp(x, p, q);
    const double f = difference(x);
    if (std::abs(f) <= 0.25 * tie(value_at(a, x)) || x == p || x == q) return x;
    if ((f < 0) == (fp < 0)) {
      p = x;
      fp = f;
      if (stayed > 0) fq *= 0.5;
      stayed = 1;
    } else {
      q = x;
      fq = f;
      if (stayed < 0) fp *= 0.5;
      stayed = -1;
    }
  }
  return x;
}

}  // namespace brushfire::detail
