// The lower envelope by a bottom-up merge sort whose "merge" sweeps two envelopes from left to right.
#include <brushfire/solvers/windows/algebra/envelope.h>

#include <brushfire/solvers/windows/algebra/tie_point.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

void Envelope::add(const Window& w, Real b0, Real b1, Real d0, Real d1) {
  if (!(b1 > b0)) return;
  if (!merged_.empty() && merged_.back().window == &w && merged_.back().b1 == b0) {
    merged_.back().b1 = b1;
    merged_.back().d1 = d1;
    return;
  }
  merged_.push_back({&w, b0, b1, d0, d1});
}

// The lower of a and b on [p,q], where both are visible; xp, xq: their values at p and q.
void Envelope::decide(const Part& a, const Part& b, Real p, Real q, Real ap, Real bp, Real aq, Real bq) {
  const Window &wa = *a.window, &wb = *b.window;
  const Real within = tie(std::max(ap, aq));
  const auto settled = [&](Real f) { return abs(f) <= within ? 0.0 : f; };
  const Real fp = settled(ap - bp), fq = settled(aq - bq);
  if (fp * fq < 0) {
    const Real z = tie_point(wa, wb, p, q, fp, fq);
    const Real az = value_at(wa, z), bz = value_at(wb, z);
    if (fp < 0) {
      add(wa, p, z, ap, az);
      add(wb, z, q, bz, bq);
    } else {
      add(wb, p, z, bp, bz);
      add(wa, z, q, az, aq);
    }
    return;
  }
  // One is lower at both ends; the other may win between them, where the slopes are equal, and only there.
  const Real x = equal_slope(wa, wb);
  const Real ax = x > p && x < q ? value_at(wa, x) : 0, bx = x > p && x < q ? value_at(wb, x) : 0;
  const Real fx = settled(ax - bx);
  const bool a_at_ends =
      fp < 0 || fq < 0 || (fp == 0 && fq == 0 && (fx < 0 || (fx == 0 && wa.pseudo_source <= wb.pseudo_source)));
  const Window& outer = a_at_ends ? wa : wb;
  const Window& inner = a_at_ends ? wb : wa;
  const Real op = a_at_ends ? ap : bp, oq = a_at_ends ? aq : bq;
  const Real gain = a_at_ends ? fx : -fx;  // > 0: the inner one wins at x
  if (gain <= 0) return add(outer, p, q, op, oq);
  const Real gp = a_at_ends ? -fp : fp, gq = a_at_ends ? -fq : fq;  // inner - outer at the ends, >= 0
  const Real z0 = gp > 0 ? tie_point(inner, outer, p, x, gp, -gain) : p;
  const Real z1 = gq > 0 ? tie_point(inner, outer, x, q, -gain, gq) : q;
  add(outer, p, z0, op, value_at(outer, z0));
  add(inner, z0, z1, value_at(inner, z0), value_at(inner, z1));
  add(outer, z1, q, value_at(outer, z1), oq);
}

void Envelope::merge(std::size_t begin, std::size_t middle, std::size_t end) {
  std::size_t i = begin, j = middle;
  while (i < middle && j < end) {
    Part &a = parts_[i], &b = parts_[j];
    if (a.b1 <= b.b0) {
      add(*a.window, a.b0, a.b1, a.d0, a.d1);
      ++i;
    } else if (b.b1 <= a.b0) {
      add(*b.window, b.b0, b.b1, b.d0, b.d1);
      ++j;
    } else if (a.b0 < b.b0) {
      const Real d = value_at(*a.window, b.b0);
      add(*a.window, a.b0, b.b0, a.d0, d);
      a.b0 = b.b0;
      a.d0 = d;
    } else if (b.b0 < a.b0) {
      const Real d = value_at(*b.window, a.b0);
      add(*b.window, b.b0, a.b0, b.d0, d);
      b.b0 = a.b0;
      b.d0 = d;
    } else {
      const Real q = std::min(a.b1, b.b1);
      const Real aq = a.b1 == q ? a.d1 : value_at(*a.window, q), bq = b.b1 == q ? b.d1 : value_at(*b.window, q);
      decide(a, b, a.b0, q, a.d0, b.d0, aq, bq);
      a.b0 = b.b0 = q;
      a.d0 = aq;
      b.d0 = bq;
      if (a.b1 == q) ++i;
      if (b.b1 == q) ++j;
    }
  }
  for (; i < middle; ++i) add(*parts_[i].window, parts_[i].b0, parts_[i].b1, parts_[i].d0, parts_[i].d1);
  for (; j < end; ++j) add(*parts_[j].window, parts_[j].b0, parts_[j].b1, parts_[j].d0, parts_[j].d1);
}

std::span<Window> Envelope::operator()(std::span<const Window> windows) {
  parts_.clear();
  starts_.clear();
  for (const Window& w : windows) {
    starts_.push_back(parts_.size());
    parts_.push_back({&w, w.b0, w.b1, w.d0, w.d1});
  }
  starts_.push_back(parts_.size());
  while (starts_.size() > 2) {
    merged_.clear();
    next_starts_.clear();
    std::size_t k = 0;
    for (; k + 2 < starts_.size(); k += 2) {
      next_starts_.push_back(merged_.size());
      // A part never joins one of another pair: the windows differ.
      merge(starts_[k], starts_[k + 1], starts_[k + 2]);
    }
    if (k + 1 < starts_.size()) {
      next_starts_.push_back(merged_.size());
      for (std::size_t i = starts_[k]; i < starts_[k + 1]; ++i) merged_.push_back(parts_[i]);
    }
    next_starts_.push_back(merged_.size());
    parts_.swap(merged_);
    starts_.swap(next_starts_);
  }
  result_.clear();
  for (const Part& part : parts_) {
    Window w = *part.window;
    w.b0 = part.b0;
    w.b1 = part.b1;
    w.d0 = part.d0;
    w.d1 = part.d1;
    if (!is_sliver(w)) result_.push_back(w);
  }
  return result_;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
