// Trimming and merging in one pass: the few windows of an edge in a run with a tolerance.
#pragma once

#include <brushfire/solvers/windows/algebra/merge.h>
#include <brushfire/solvers/windows/algebra/tie_point.h>
#include <brushfire/solvers/windows/algebra/window.h>

#include <span>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Sweeps windows in ascending order of b0 from left to right. The swept ones are disjoint; the next one is compared
// with the last of them, and merged with it, and the result with the one before, as long as that works (L8). Only
// where two windows cross, and only once, is asked before a merge; where, only after one has been refused (L2, L5).
// Rare constellations (one window in the middle of another one) are left to the envelope.
//
// merge(a, b, joint): merge_into() of merge.h.
template <class Merge>
class Sweep {
 public:
  Sweep(std::span<Window> windows, Merge merge) : w_(windows), merge_(std::move(merge)) {}

  // True: the first count() windows are what is left. False: the first count() windows have the same envelope as all
  // did, but are neither sorted nor disjoint.
  bool operator()() {
    for (std::size_t i = 0; i < w_.size(); ++i) {
      if (add(i)) continue;
      for (; i < w_.size(); ++i) w_[count_++] = w_[i];
      return false;
    }
    return true;
  }
  std::size_t count() const { return count_; }

 private:
  // False where the envelope has to decide.
  bool add(std::size_t i) {
    Window& b = w_[i];
    while (count_ > 0) {
      Window& a = w_[count_ - 1];
      const Step step = b.b0 >= a.b1 ? after(a, b) : b.b0 < a.b0 ? before(a, b) : over(a, b);
      if (step == Step::Envelope) return false;
      if (step == Step::Done) return true;
      if (step == Step::Keep) break;
    }
    if (count_ < i) w_[count_] = b;
    ++count_;
    return true;
  }

  enum class Step { Again, Keep, Done, Envelope };  // compare b again, append b, b is gone, give up

  Step after(const Window& a, Window& b) {
    if (b.b0 - a.b1 > 2 * kSliver * sliver_scale(b) || !merge_(a, b, {a.b1, a.d1, b.d0})) return Step::Keep;
    --count_;
    return Step::Again;
  }

  // a has been trimmed on the left, and b begins before it: beside the one that has trimmed a.
  Step before(const Window& a, Window& b) {
    if (count_ < 2) return Step::Envelope;
    const Window& c = w_[count_ - 2];
    const Real p = b.b0, q = a.b0;
    if (c.b1 < q || c.b0 > p || b.b1 < q) return Step::Envelope;
    const Real bq = value_at(b, q), x = equal_slope(c, b);
    if (!(value_at(c, p) < b.d0 && c.d1 < bq) || (x > p && x < q)) return Step::Envelope;
    b.b0 = q;
    b.d0 = bq;
    return b.b1 > q && !is_sliver(b) ? Step::Again : Step::Done;
  }

  // a and b overlap on [p,q].
  Step over(Window& a, Window& b) {
    const Real p = b.b0, q = std::min(a.b1, b.b1);
    const Real ap = p > a.b0 ? value_at(a, p) : a.d0, bp = b.d0;
    const Real aq = q < a.b1 ? value_at(a, q) : a.d1, bq = q < b.b1 ? value_at(b, q) : b.d1;
    const Real within = tie(std::max(ap, aq));
    const Real fp = abs(ap - bp) <= within ? 0 : ap - bp, fq = abs(aq - bq) <= within ? 0 : aq - bq;
    if (fp < 0 && fq > 0 && q == a.b1) return cross(a, b, p, q, fp, fq);
    if (fp * fq < 0) return Step::Envelope;
    const bool a_lower = fp < 0 || fq < 0 || (fp == 0 && fq == 0 && a.pseudo_source <= b.pseudo_source);
    const Real x = equal_slope(a, b);
    if (x > p && x < q) {  // the other one may be lower between
      const Real fx = value_at(a, x) - value_at(b, x);
      if (a_lower ? fx > within : fx < -within) return Step::Envelope;
    }
    if (a_lower) {
      b.b0 = q;
      b.d0 = bq;
      return b.b1 > q && !is_sliver(b) ? Step::Again : Step::Done;
    }
    if (a.b1 > q) return Step::Envelope;
    a.b1 = p;
    a.d1 = ap;
    if (!(p > a.b0) || is_sliver(a)) --count_;
    return Step::Again;
  }

  // a is lower at p and b at q.
  Step cross(Window& a, Window& b, Real p, Real q, Real fp, Real fq) {
    const Real near = p + (q - p) * (fp / (fp - fq));
    if (merge_(a, b, {near, value_at(a, near), value_at(b, near)})) {
      --count_;
      return Step::Again;
    }
    const Real z = tie_point(a, b, p, q, fp, fq);
    a.b1 = b.b0 = z;
    a.d1 = value_at(a, z);
    b.d0 = value_at(b, z);
    if (!(z > a.b0) || is_sliver(a)) --count_;
    return b.b1 > z && !is_sliver(b) ? Step::Keep : Step::Done;
  }

  std::span<Window> w_;
  Merge merge_;
  std::size_t count_ = 0;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
