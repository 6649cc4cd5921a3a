// The crossing of two windows: closed form, checked, with a bracketed search behind it.
#include <brushfire/solvers/windows/algebra/tie_point.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
Real tie_point(const Window& a, const Window& b, Real p, Real q, Real fp, Real fq) {
  const auto difference = [&](Real x) { return value_at(a, x) - value_at(b, x); };
  if (a.kind == WindowKind::Circular && b.kind == WindowKind::Circular) {
    const Real x = p + tie_point_in_closed_form(a.source, b.source, b.sigma - a.sigma, p, q - p);
    if (x >= p && x <= q && abs(difference(x)) <= tie(value_at(a, x))) return x;
  }
  // Illinois: false position that halves the weight of an end which has stayed twice; bisection from then on.
  constexpr int kFalsePositions = 24, kSteps = 90;
  Real x = p;
  int stayed = 0;
  for (int step = 0; step < kSteps; ++step) {
    x = step < kFalsePositions ? p + (q - p) * (fp / (fp - fq)) : 0.5 * (p + q);
    x = std::clamp(x, p, q);
    const Real f = difference(x);
    if (abs(f) <= 0.25 * tie(value_at(a, x)) || x == p || x == q) return x;
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

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
