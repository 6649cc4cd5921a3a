// One sweep over nearly disjoint windows.
#include <brushfire/solvers/windows/detail/exact_trim.h>

#include <brushfire/solvers/windows/detail/exact_cross.h>
#include <brushfire/solvers/windows/detail/ridge.h>

#include <algorithm>

namespace brushfire::detail {
namespace {

double value_of(const WindowColumns& w, Index i, double at) { return w.sigma[i] + length_of(at - w.x[i], w.y[i]); }

}  // namespace

void ListTrimmer::operator()(WindowList& list, const EdgeBounds& edge, double radius, BlockPool& blocks) {
  load(list, edge, radius);
  list.age = 0;
  if (!list.ordered) return replace_by_envelope(list, blocks);
  sweep(list.block.columns());
  store(list);
}

// The windows that no path through an end of the edge makes superfluous.
void ListTrimmer::load(const WindowList& list, const EdgeBounds& edge, double radius) {
  const WindowColumns w = list.block.columns();
  if (d0_.size() < list.size) {
    d0_.resize(2 * list.size);
    d1_.resize(2 * list.size);
  }
  end_values(w, list.size, d0_.data(), d1_.data());
  parts_.clear();
  for (Index i = 0; i < list.size; ++i) {
    const double b0 = w.b0[i], b1 = w.b1[i], d0 = d0_[i], d1 = d1_[i];
    if (is_dominated(edge, b0, b1, d0, d1) || 0.5 * (d0 + d1 - (b1 - b0)) > radius) continue;
    parts_.push_back({i, b0, b1, d0, d1});
  }
}

void ListTrimmer::sweep(const WindowColumns& w) {
  constexpr std::size_t kDepth = 6;  // how many windows back are looked at
  const auto gone = [&](const Part& p) { return !(p.b1 - p.b0 > kSliver * (p.d0 - w.sigma[p.window])); };
  std::size_t kept = 0;
  for (std::size_t next = 0; next < parts_.size(); ++next) {
    Part part = parts_[next];
    if (gone(part)) continue;
    const std::size_t last = kept > kDepth ? kept - kDepth : 0;
    bool alive = true;
    for (std::size_t k = kept; k-- > last && alive;) {
      Part& before = parts_[k];
      if (part.b0 >= before.b1) break;
      if (before.b0 >= part.b1) continue;
      settle(w, before, part);
      alive = !gone(part);
      if (gone(before)) {
        std::copy(parts_.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                  parts_.begin() + static_cast<std::ptrdiff_t>(kept), parts_.begin() + static_cast<std::ptrdiff_t>(k));
        --kept;
      }
    }
    if (alive) parts_[kept++] = part;
  }
  parts_.resize(kept);
}

// Two windows that overlap.
void ListTrimmer::settle(const WindowColumns& w, Part& a, Part& b) {
  const double p = std::max(a.b0, b.b0), q = std::min(a.b1, b.b1);
  const Index i = a.window, j = b.window;
  const double ap = p == a.b0 ? a.d0 : value_of(w, i, p), bp = p == b.b0 ? b.d0 : value_of(w, j, p);
  const double aq = q == a.b1 ? a.d1 : value_of(w, i, q), bq = q == b.b1 ? b.d1 : value_of(w, j, q);
  const double within = tie(std::max(ap, aq));
  const auto settled = [&](double f) { return std::abs(f) <= within ? 0.0 : f; };
  const double fp = settled(ap - bp), fq = settled(aq - bq);
  // What a window loses goes if it is at an end of it.
  const auto cut_left = [](Part& part, double to, double value) {
    part.b0 = to;
    part.d0 = value;
  };
  const auto cut_right = [](Part& part, double to, double value) {
    part.b1 = to;
    part.d1 = value;
  };
  const auto lose = [&](Part& loser, double at_p, double at_q) {
    if (q == loser.b1) {
      cut_right(loser, p, at_p);
    } else if (p == loser.b0) {
      cut_left(loser, q, at_q);
    }
  };
  if (fp * fq < 0) {
    const Vec2 s{w.x[i], w.y[i]}, t{w.x[j], w.y[j]};
    double z = p + ridge_in_closed_form(s, t, w.sigma[j] - w.sigma[i], p, q - p);
    double az = value_of(w, i, z), bz = value_of(w, j, z);
    if (!(z >= p && z <= q && std::abs(az - bz) <= within)) {
      z = ridge(w.window(i), w.window(j), p, q, fp, fq);
      az = value_of(w, i, z);
      bz = value_of(w, j, z);
    }
    Part &first = fp < 0 ? a : b, &second = fp < 0 ? b : a;
    if (first.b1 == q) cut_right(first, z, fp < 0 ? az : bz);
    if (second.b0 == p) cut_left(second, z, fp < 0 ? bz : az);
    return;
  }
  // One is lower at both ends; the other may win between them, where the slopes are equal, if its source is the nearer.
  bool a_wins = fp < 0 || fq < 0;
  const bool draw = fp == 0 && fq == 0;
  if (draw || (a_wins ? w.sigma[j] > w.sigma[i] : w.sigma[i] > w.sigma[j])) {
    const double along = w.y[j] - w.y[i];
    const double x = along == 0 ? kInfinity : (w.x[i] * w.y[j] - w.y[i] * w.x[j]) / along;
    const double fx = x > p && x < q ? settled(value_of(w, i, x) - value_of(w, j, x)) : 0;
    if (draw) {
      a_wins = fx < 0 || (fx == 0 && w.root[i] <= w.root[j]);
    } else if (a_wins ? fx > 0 : fx < 0) {
      return;
    }
  }
  if (a_wins) {
    lose(b, bp, bq);
  } else {
    lose(a, ap, aq);
  }
}

void ListTrimmer::store(WindowList& list) const {
  const WindowColumns w = list.block.columns();
  Index kept = 0;
  for (const Part& part : parts_) {
    if (kept != part.window) w.move(kept, part.window);
    w.b0[kept] = part.b0;
    w.b1[kept] = part.b1;
    ++kept;
  }
  list.size = kept;
}

void ListTrimmer::replace_by_envelope(WindowList& list, BlockPool& blocks) {
  const WindowColumns w = list.block.columns();
  windows_.clear();
  for (const Part& part : parts_) windows_.push_back(w.window(part.window));
  const std::span<Window> result = envelope_(windows_);
  list.size = static_cast<Index>(result.size());
  list.ordered = true;
  if (list.size > list.block.capacity()) {
    blocks.release(list.block);
    list.block = blocks.allocate(list.size);
  }
  const WindowColumns out = list.block.columns();
  for (Index i = 0; i < list.size; ++i) out.set(i, result[i]);
}

}  // namespace brushfire::detail
