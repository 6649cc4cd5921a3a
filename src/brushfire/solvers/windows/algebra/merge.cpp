// The flattest lower interpolant of two windows, in closed form.
#include <brushfire/solvers/windows/algebra/merge.h>

#include <brushfire/core/detail/planar.h>
#include <brushfire/solvers/windows/algebra/tie_point.h>

#include <algorithm>
#include <limits>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

// What rounding of the merged source may take from (M1): paid into the slack.
constexpr double kMergeRounding = 16 * kEpsilon;
// The share of a merge's loss at the joint by which the distance is expected to lie above the merged value (measured;
// no proof hangs on it).
constexpr double kExpectedLoss = 0.68;

// Two fronts that are lines, as one: the chord of their values. It is nowhere above the lesser (M1) where a is at least
// as steep as it is, and b at most; what it loses is most at the joint (M3).
bool merge_parallel(const Window& a, Window& b, const Joint& joint, Real start, const MergeBudget& budget) {
  const Real left = a.b0, right = b.b1, fa = a.d0, fb = b.d1, length = right - left;
  const Real slope = (fb - fa) / length, lesser = std::min(joint.a, joint.b);
  const Real steep = (1 - slope) * (1 + slope);
  if (!(steep > 0)) return false;
  const Real rounding = kMergeRounding * (lesser + right);
  const auto chord = [&](Real x) { return fa + slope * (x - left); };
  if (a.d1 - chord(a.b1) < -rounding || b.d0 - chord(b.b0) < -rounding) return false;
  const Real loss_a = std::max(Real{0}, joint.a - chord(joint.at));
  const Real loss_b = std::max(Real{0}, joint.b - chord(std::max(joint.at, b.b0)));
  const Real slack = std::max(a.slack, b.slack), room = budget.share * (std::min(fa, fb) - start) - slack;
  const Real paid = std::max(a.slack + loss_a, b.slack + loss_b) + rounding;
  if (paid - slack > budget.pace * room || paid > budget.share * (std::min(fa, fb) - start)) return false;
  const Real expected =
      ((joint.at - left) * static_cast<Real>(a.lift) + (right - joint.at) * static_cast<Real>(b.lift)) / length +
      kExpectedLoss * std::min(loss_a, loss_b);
  b.b0 = left;
  b.d0 = fa;
  b.source = {-slope, -sqrt(steep)};
  b.sigma = fa - slope * left;
  b.slack = paid;
  b.lift = static_cast<float>(expected);
  b.pseudo_source = a.pseudo_source;
  b.trail = kNoIndex;
  return true;
}

// The sigma of the merged window of a and b with end values fa and fb; steep: length^2 - (fb - fa)^2 > 0.
//
// All windows with these end values form a family, the flatter the smaller sigma. To lie below a near the left end it
// must not start out steeper: sigma >= that of the member tangent there. The same on the right. Beyond these, the
// smaller of both sigmas: smaller ones still cost less but compound from merge to merge; a radius of twice the
// distance is the most.
template <bool kCircular>
[[gnu::always_inline]] inline Real merged_sigma(const Window& a, const Window& b, Real fa, Real fb, Real steep) {
  const Real left = a.b0, right = b.b1, length = right - left, rise = fb - fa;
  const auto radius = [](const Window& w, Real end_value) {  // what a linear one has is infinite
    return kCircular || w.kind == WindowKind::Circular ? end_value - w.sigma : Real{1};
  };
  const auto run = [](const Window& w, Real end) {  // slope at the end, times the radius
    return kCircular || w.kind == WindowKind::Circular ? end - w.source.x : -w.source.x;
  };
  Real sigma = kCircular ? std::max(std::min(a.sigma, b.sigma), -std::max(fa, fb)) : -std::max(fa, fb);
  const Real ra = radius(a, fa), rb = radius(b, fb);
  // With slope run / ra at the left end, the rise beyond the tangent's, times ra; steep / (2 * over) follows.
  const Real over_a = rise * ra - length * run(a, left);
  const Real over_b = length * run(b, right) - rise * rb;
  if (over_a > 0) sigma = std::max(sigma, fa - 0.5 * steep * ra / over_a);
  if (over_b > 0) sigma = std::max(sigma, fb - 0.5 * steep * rb / over_b);
  return sigma;
}

// Into a circular one. Compiled once for the usual case, in which both are circular.
template <bool kCircular>
[[gnu::always_inline]] inline bool merge_circular(const Window& a, Window& b, const Joint& joint, Real start,
                                                  const MergeBudget& budget) {
  const Real left = a.b0, right = b.b1, length = right - left;
  const Real fa = a.d0, fb = b.d1, rise = fb - fa;
  const Real slack = std::max(a.slack, b.slack);
  const Real lesser = std::min(joint.a, joint.b);
  const Real room = budget.share * (std::min(fa, fb) - start) - slack;
  const Real limit = budget.pace * room;
  if (!(limit > 0)) return false;
  // The merged window is convex, so below its chord: the loss at the joint is at least this.
  if ((lesser - fa) * length - rise * (joint.at - left) > limit * length) return false;
  const Real steep = (length - rise) * (length + rise);
  if (!(steep > 0)) return false;

  const Real sigma = merged_sigma<kCircular>(a, b, fa, fb, steep);
  const Real r0 = fa - sigma, r1 = fb - sigma;
  const Real q = heron(length, r0, r1);
  if (!(r0 > 0 && r1 > 0 && q > 0 && r0 + r1 > length)) return false;
  const Real inverse = 1 / length;
  Window merged;
  merged.b0 = left;
  merged.b1 = right;
  merged.d0 = fa;
  merged.d1 = fb;
  merged.sigma = sigma;
  merged.source = {left + 0.5 * (length + (r0 - r1) * (r0 + r1) * inverse), -0.5 * sqrt(q) * inverse};

  const Real at_joint = value_at(merged, joint.at);
  const Real loss_a = joint.a - at_joint;
  const Real loss_b = joint.b - (b.b0 > joint.at ? value_at(merged, b.b0) : at_joint);
  if (std::max(loss_a, loss_b) > limit) return false;
  // (M1) over the whole of both windows, (M3) up to the joint: the extremes of a difference are among both ends and the
  // place of equal slopes, between which it is monotone.
  Real low = std::min(loss_a, loss_b), high_a = std::max(loss_a, Real{0}), high_b = std::max(loss_b, Real{0});
  if (a.b1 > joint.at) low = std::min(low, a.d1 - value_at(merged, a.b1));
  if (b.b0 < joint.at) low = std::min(low, b.d0 - value_at(merged, b.b0));
  const Real xa = equal_slope(a, merged), xb = equal_slope(b, merged);
  if (xa > left && xa < a.b1) {
    const Real between = value_at(a, xa) - value_at(merged, xa);
    low = std::min(low, between);
    if (xa < joint.at) high_a = std::max(high_a, between);
  }
  if (xb > b.b0 && xb < right) {
    const Real between = value_at(b, xb) - value_at(merged, xb);
    low = std::min(low, between);
    if (xb > joint.at) high_b = std::max(high_b, between);
  }
  const Real rounding = kMergeRounding * lesser;
  if (low < -rounding) return false;
  const Real paid = std::max(a.slack + high_a, b.slack + high_b) + rounding;  // (M3)
  if (paid - slack > limit || paid > budget.share * (minimum_of(merged) - start)) return false;
  const Real expected =
      ((joint.at - left) * static_cast<Real>(a.lift) + (right - joint.at) * static_cast<Real>(b.lift)) * inverse +
      kExpectedLoss * std::max(Real{0}, std::min(loss_a, loss_b));
  b.b0 = left;
  b.d0 = fa;
  b.source = merged.source;
  b.sigma = sigma;
  b.slack = paid;
  b.lift = static_cast<float>(expected);
  b.kind = WindowKind::Circular;
  b.pseudo_source = a.pseudo_source;
  b.trail = kNoIndex;
  return true;
}

[[gnu::noinline]] bool merge_with_parallel(const Window& a, Window& b, const Joint& joint, Real start,
                                           const MergeBudget& budget) {
  const bool both = a.kind == WindowKind::Linear && b.kind == WindowKind::Linear;
  if (both && merge_parallel(a, b, joint, start, budget)) return true;
  return merge_circular<false>(a, b, joint, start, budget);
}

}  // namespace

bool merge_into(const Window& a, Window& b, const Joint& joint, Real start, const MergeBudget& budget) {
  if (a.kind == WindowKind::Linear || b.kind == WindowKind::Linear) {
    return merge_with_parallel(a, b, joint, start, budget);
  }
  return merge_circular<true>(a, b, joint, start, budget);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
