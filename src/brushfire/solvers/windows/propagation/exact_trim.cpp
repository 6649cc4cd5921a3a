// One sweep over nearly disjoint windows.
#include <brushfire/solvers/windows/propagation/exact_trim.h>

#include <brushfire/solvers/windows/algebra/exact_cross.h>
#include <brushfire/solvers/windows/algebra/tie_point.h>
#include <brushfire/solvers/windows/propagation/trimming.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

Real value_of(const WindowColumns& w, Index i, Real at) { return w.value(i, at); }

// Windows with their source on the edge (is_on_edge()) are neither cut nor do they cut others.
bool on_edge(const WindowColumns& w, Index i) {
  return !w.is_linear(i) && -w.y[i] <= kOnEdge * (w.b1[i] - w.b0[i]) && w.x[i] > w.b0[i] && w.x[i] < w.b1[i];
}

}  // namespace

void ListTrimmer::operator()(WindowList& list, const EdgeBounds& edge, Real radius, BlockPool& blocks) {
  list.age = 0;
  drop_useless(list, edge, radius);
  if (!list.ordered) return replace_by_envelope(list, blocks);
  const WindowColumns w = list.columns();
  sweep(w, list.size);
  Index count = 0;
  for (const Index i : kept_) {
    if (count != i) w.move(count, i);
    ++count;
  }
  list.size = count;
}

// Leaves the values at the ends in d0_ and d1_.
void ListTrimmer::drop_useless(WindowList& list, const EdgeBounds& edge, Real radius) {
  const WindowColumns w = list.columns();
  if (d0_.size() < list.size + kRoomBehind) {
    for (std::vector<Real>* column : {&d0_, &d1_, &tie_point_, &tie_value_a_, &tie_value_b_, &plain_}) {
      column->resize(2 * list.size + kRoomBehind);
    }
  }
  end_values(w, list.size, d0_.data(), d1_.data());
  if (!BRUSHFIRE_ON_TARGET(Variant::Best, any_useless(w, d0_.data(), d1_.data(), list.size, edge, radius))) return;
  Index count = 0;
  for (Index i = 0; i < list.size; ++i) {
    const Real b0 = w.b0[i], b1 = w.b1[i], d0 = d0_[i], d1 = d1_[i];
    if (is_dominated(edge, b0, b1, d0, d1) || 0.5 * (d0 + d1 - (b1 - b0)) > radius) continue;
    if (count != i) w.move(count, i);
    d0_[count] = d0;
    d1_[count] = d1;
    ++count;
  }
  list.size = count;
}

void ListTrimmer::sweep(const WindowColumns& w, Index count) {
  constexpr std::size_t kDepth = 6;  // how many windows back are looked at
  const auto gone = [&](Index i) {
    return !(w.b1[i] - w.b0[i] > kSliver * (w.is_linear(i) ? w.b1[i] : d0_[i] - w.sigma[i]));
  };
  if (count > 1) {
    BRUSHFIRE_ON_TARGET(Variant::Best,
                        tie_points(w, d0_.data(), d1_.data(), count - 1,
                                   {tie_point_.data(), tie_value_a_.data(), tie_value_b_.data(), plain_.data()}));
  }
  // (What is said of linear windows there is not meant.)
  for (Index i = 0; w.mixed && i + 1 < count; ++i) {
    if (w.is_linear(i) || w.is_linear(i + 1)) plain_[i] = 0;
  }
  const bool all_may_be_cut = !BRUSHFIRE_ON_TARGET(Variant::Best, any_nearly_on_edge(w, count));
  kept_.clear();
  for (Index i = 0; i < count; ++i) {
    // Plain, if the one before is still there and what it lost on its left does not reach into this one.
    if (all_may_be_cut && !kept_.empty() && kept_.back() == i - 1 && plain_[i - 1] > 0 && w.b0[i - 1] <= w.b0[i]) {
      w.b1[i - 1] = w.b0[i] = tie_point_[i - 1];
      d1_[i - 1] = tie_value_a_[i - 1];
      d0_[i] = tie_value_b_[i - 1];
      if (!gone(i - 1) && !gone(i)) {
        kept_.push_back(i);
        continue;
      }
      if (gone(i - 1)) kept_.pop_back();
    }
    if (gone(i)) continue;
    const std::size_t last = kept_.size() > kDepth ? kept_.size() - kDepth : 0;
    bool alive = true;
    for (std::size_t k = kept_.size(); k-- > last && alive;) {
      const Index before = kept_[k];
      if (w.b0[i] >= w.b1[before]) break;
      if (w.b0[before] >= w.b1[i]) continue;
      if (!all_may_be_cut && (on_edge(w, before) || on_edge(w, i))) continue;
      settle(w, before, i);
      alive = !gone(i);
      if (gone(before)) kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(k));
    }
    if (alive) kept_.push_back(i);
  }
}

// Two windows that overlap: each loses what it was shown to lose, if that is at one of its ends.
void ListTrimmer::settle(const WindowColumns& w, Index a, Index b) {
  const Real p = std::max(w.b0[a], w.b0[b]), q = std::min(w.b1[a], w.b1[b]);
  const Real ap = p == w.b0[a] ? d0_[a] : value_of(w, a, p), bp = p == w.b0[b] ? d0_[b] : value_of(w, b, p);
  const Real aq = q == w.b1[a] ? d1_[a] : value_of(w, a, q), bq = q == w.b1[b] ? d1_[b] : value_of(w, b, q);
  const Real within = tie(std::max(ap, aq));
  const auto settled = [&](Real f) { return abs(f) <= within ? 0.0 : f; };
  const Real fp = settled(ap - bp), fq = settled(aq - bq);
  const auto cut_left = [&](Index i, Real to, Real value) {
    w.b0[i] = to;
    d0_[i] = value;
  };
  const auto cut_right = [&](Index i, Real to, Real value) {
    w.b1[i] = to;
    d1_[i] = value;
  };
  if (fp * fq < 0) {
    const Vec2 s{w.x[a], w.y[a]}, t{w.x[b], w.y[b]};
    const bool both_circular = !w.is_linear(a) && !w.is_linear(b);
    Real z = both_circular ? p + tie_point_in_closed_form(s, t, w.sigma[b] - w.sigma[a], p, q - p) : -kInfinity;
    Real az = value_of(w, a, z), bz = value_of(w, b, z);
    if (!(z >= p && z <= q && abs(az - bz) <= within)) {
      z = tie_point(w.window(a), w.window(b), p, q, fp, fq);
      az = value_of(w, a, z);
      bz = value_of(w, b, z);
    }
    const bool a_first = fp < 0;
    const Index first = a_first ? a : b, second = a_first ? b : a;
    if (w.b1[first] == q) cut_right(first, z, a_first ? az : bz);
    if (w.b0[second] == p) cut_left(second, z, a_first ? bz : az);
    return;
  }
  // One is lower at both ends; the other may win between them, where the slopes are equal, if its source is the nearer.
  bool a_wins = fp < 0 || fq < 0;
  const bool draw = fp == 0 && fq == 0;
  const bool linear = w.is_linear(a) || w.is_linear(b);
  if (draw || linear || (a_wins ? w.sigma[b] > w.sigma[a] : w.sigma[a] > w.sigma[b])) {
    const Real along = w.y[b] - w.y[a];
    const Real x = linear       ? equal_slope(w.window(a), w.window(b))
                   : along == 0 ? kInfinity
                                : (w.x[a] * w.y[b] - w.y[a] * w.x[b]) / along;
    const Real fx = x > p && x < q ? settled(value_of(w, a, x) - value_of(w, b, x)) : 0;
    if (draw) {
      a_wins = fx < 0 || (fx == 0 && w.pseudo_source[a] <= w.pseudo_source[b]);
    } else if (a_wins ? fx > 0 : fx < 0) {
      return;
    }
  }
  const Index loser = a_wins ? b : a;
  if (q == w.b1[loser]) {
    cut_right(loser, p, a_wins ? bp : ap);
  } else if (p == w.b0[loser]) {
    cut_left(loser, q, a_wins ? bq : aq);
  }
}

void ListTrimmer::replace_by_envelope(WindowList& list, BlockPool& blocks) {
  windows_.clear();
  uncut_.clear();
  const WindowColumns w = list.columns();
  for (Index i = 0; i < list.size; ++i) (on_edge(w, i) ? uncut_ : windows_).push_back(w.window(i));
  const std::span<Window> result = envelope_(windows_);
  list.size = static_cast<Index>(result.size() + uncut_.size());
  list.ordered = true;
  if (list.size > list.block.capacity()) {
    blocks.release(list.block);
    list.block = blocks.allocate(list.size);
  }
  const WindowColumns out = list.block.columns();
  Index count = 0;
  for (const Window& window : result) out.set(count++, window);
  for (const Window& window : uncut_) out.set(count++, window);
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
