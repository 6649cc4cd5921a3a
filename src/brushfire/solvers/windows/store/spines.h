// What has passed the edges at which three faces or more meet: the spines.
#pragma once

#include <brushfire/solvers/windows/algebra/tie_point.h>
#include <brushfire/solvers/windows/algebra/window.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Light that leaves a face over a spine enters all of its other faces, the ones back where it came from among them.
// Sheets that meet at many spines bring it to each of them once a sheet; were all of it let through, there would be
// twice as much behind every spine. By L10 (docs/tolerance.md) it is enough to let pass what is shorter than all that
// has passed the edge before, from whichever face and into whichever.
class SpineMemory {
 public:
  // Two vertices, and a window in the frame from the lower to the higher. Takes from its ends what is nowhere shorter
  // than what was learned before; false where nothing is left. Of equal light that of the lowest label stays.
  bool learn(Index low, Index high, Window& w, Index label) {
    Edge& edge = edges_[std::uint64_t{low} << 32 | high];
    const bool may_be_cut = !is_on_edge(w);
    for (auto k = first_near(edge, w); k != edge.known.end() && k->window.b0 < w.b1;) {
      const Real p = std::max(k->window.b0, w.b0), q = std::min(k->window.b1, w.b1);
      if (!(p < q) || !is_no_longer(*k, w, label, p, q)) {
        ++k;
        continue;
      }
      const bool from_start = p <= w.b0, to_end = q >= w.b1;
      if (from_start && to_end) return false;
      if (!may_be_cut || (!from_start && !to_end)) {
        ++k;
        continue;
      }
      cut(w, from_start ? q : w.b0, from_start ? w.b1 : p);
      if (is_sliver(w)) return false;
      k = first_near(edge, w);  // those before it may reach the end now
    }
    remember(edge, w, label);
    return true;
  }
  void clear() { edges_.clear(); }

 private:
  struct Known {
    Window window;
    Index label;
  };
  struct Edge {
    std::vector<Known> known;  // by the start of the interval
    Real widest = 0;
  };

  // The first one that may reach into w.
  static std::vector<Known>::iterator first_near(Edge& edge, const Window& w) {
    return std::lower_bound(edge.known.begin(), edge.known.end(), w.b0 - edge.widest,
                            [](const Known& k, Real b0) { return k.window.b0 < b0; });
  }

  // What it is nowhere longer than need not be known any more.
  static void remember(Edge& edge, const Window& w, Index label) {
    const auto begin = std::lower_bound(edge.known.begin(), edge.known.end(), w.b0,
                                        [](const Known& k, Real b0) { return k.window.b0 < b0; });
    auto end = begin;
    while (end != edge.known.end() && end->window.b0 < w.b1) ++end;
    const auto gone = std::remove_if(begin, end, [&](const Known& k) {
      return k.window.b1 <= w.b1 && is_no_longer({w, label}, k.window, k.label, k.window.b0, k.window.b1);
    });
    edge.widest = std::max(edge.widest, w.b1 - w.b0);
    edge.known.insert(edge.known.erase(gone, end) - (gone - begin), {w, label});
  }

  // Light that comes another way has been turned through other frames: that must not look like an improvement.
  static constexpr double kTurns = 32 * kEpsilon;

  // Whether k is at most as long as w on [p,q]: the difference has its extremes at the ends and where slopes are equal.
  static bool is_no_longer(const Known& k, const Window& w, Index label, Real p, Real q) {
    const Real moved = kTurns * (extent_of(w) + w.b1 + std::max(w.d0, w.d1));
    const Real within = k.label <= label ? moved : -moved;
    const auto fits = [&](Real x) { return value_at(k.window, x) <= value_at(w, x) + within; };
    if (!fits(p) || !fits(q)) return false;
    const Real x = equal_slope(k.window, w);
    return !(x > p && x < q) || fits(x);
  }

  static void cut(Window& w, Real b0, Real b1) {
    if (b0 > w.b0) w.d0 = value_at(w, b0);
    if (b1 < w.b1) w.d1 = value_at(w, b1);
    w.b0 = b0;
    w.b1 = b1;
  }

  std::unordered_map<std::uint64_t, Edge> edges_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
