// The flattest lower interpolant of two windows, in closed form.
#include <brushfire/solvers/windows/detail/merge.h>

#include <brushfire/core/planar.h>
#include <brushfire/solvers/windows/detail/ridge.h>

#include <algorithm>
#include <limits>

namespace brushfire::detail {
namespace {

// What rounding of the merged source may take from (M1): paid into the slack.
constexpr double kMergeRounding = 16 * std::numeric_limits<double>::epsilon();
// The share of a merge's loss at the joint by which the distance is expected to lie above the merged value (measured;
// no proof hangs on it).
constexpr double kExpectedLoss = 0.7;

// Smallest and largest of w - m between p and q, beyond those already in `low` and `high`: at the ends, and where the
// slopes are equal; between those the difference is monotone.
void extend(const Window& w, const Window& m, double p, double q, double at_joint, double& low, double& high) {
  low = std::min(low, at_joint);
  high = std::max(high, at_joint);
  const double x = equal_slope(w, m);
  if (!(x > p && x < q)) return;
  const double between = value_at(w, x) - value_at(m, x);
  low = std::min(low, between);
  high = std::max(high, between);
}

}  // namespace

bool merge(const Window& a, const Window& b, double start, const MergeBudget& budget, Window& merged) {
  if (a.kind != WindowKind::Circular || b.kind != WindowKind::Circular) return false;
  const double left = a.b0, right = b.b1, length = right - left;
  const double fa = a.d0, fb = b.d1, rise = fb - fa;
  const double slack = std::max(a.slack, b.slack);
  const double joint = std::min(a.d1, b.d0);
  const double room = budget.share * (std::min(fa, fb) - start) - slack;
  const double limit = budget.pace * room;
  if (!(limit > 0)) return false;
  // The merged window is convex, so below its chord: the loss at the joint is at least this.
  if ((joint - fa) * length - rise * (a.b1 - left) > limit * length) return false;
  const double steep = (length - rise) * (length + rise);
  if (!(steep > 0)) return false;

  // All windows with these end values form a family, the flatter the smaller sigma. To lie below a near the left end it
  // must not start out steeper: sigma >= that of the member tangent there. The same on the right. Beyond these, the
  // smaller of both sigmas: smaller ones still cost less but compound from merge to merge; a radius of twice the
  // distance is the most.
  double sigma = std::max(std::min(a.sigma, b.sigma), -std::max(fa, fb));
  const double slope_a = (left - a.source.x) / (fa - a.sigma), slope_b = (right - b.source.x) / (fb - b.sigma);
  const double over_a = rise - length * slope_a, over_b = length * slope_b - rise;
  if (over_a > 0) sigma = std::max(sigma, fa - steep / (2 * over_a));
  if (over_b > 0) sigma = std::max(sigma, fb - steep / (2 * over_b));

  const double r0 = fa - sigma, r1 = fb - sigma;
  const double q = heron(length, r0, r1);
  if (!(r0 > 0 && r1 > 0 && q > 0 && r0 + r1 > length)) return false;
  const double inverse = 1 / length;
  merged = a;
  merged.source = {left + 0.5 * (length + (r0 - r1) * (r0 + r1) * inverse), -0.5 * std::sqrt(q) * inverse};
  merged.sigma = sigma;
  merged.b1 = right;
  merged.d1 = fb;

  const double loss_a = a.d1 - value_at(merged, a.b1), loss_b = b.d0 - value_at(merged, b.b0);
  if (std::max(loss_a, loss_b) > limit) return false;
  double low = 0, high_a = 0, high_b = 0;
  extend(a, merged, left, a.b1, loss_a, low, high_a);
  extend(b, merged, b.b0, right, loss_b, low, high_b);
  const double rounding = kMergeRounding * joint;
  if (low < -rounding) return false;                                            // (M1), which only rounding can break
  const double paid = std::max(a.slack + high_a, b.slack + high_b) + rounding;  // (M3)
  if (paid - slack > limit || paid > budget.share * (minimum_of(merged) - start)) return false;
  merged.slack = paid;
  const double expected =
      ((a.b1 - left) * static_cast<double>(a.lift) + (right - b.b0) * static_cast<double>(b.lift)) * inverse +
      kExpectedLoss * std::max(0.0, std::min(loss_a, loss_b));
  merged.lift = static_cast<float>(expected);
  return true;
}

}  // namespace brushfire::detail
