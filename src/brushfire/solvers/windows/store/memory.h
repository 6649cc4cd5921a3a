// What has come over the edges of thin faces in a run.
#pragma once

#include <brushfire/solvers/windows/algebra/tie_point.h>
#include <brushfire/solvers/windows/algebra/window.h>

#include <algorithm>
#include <span>
#include <unordered_map>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// Around a needle, or through two faces without area over the same vertices, light comes back to where it was hardly
// longer or no longer at all, any number of times; no comparison with vertices would stop it. Over the edges
// of thin faces, therefore, every window is remembered, and a later one loses what earlier ones reach on no longer
// way: trimming (L5), only that the earlier ones may have moved on. (Among windows that tie, the first stays, so it is
// safe.) Every window that goes on is then the shortest so far at both of its ends.
class WindowMemory {
 public:
  // Takes from w what earlier windows of h make superfluous, at its two ends; false where nothing is left. What is left
  // is remembered.
  bool learn(Index h, Window& w) {
    Edge& edge = known_[h];
    const std::span<const Window> near = edge.around(w.b0, w.b1, moved(w));
    for (const Window& k : near) {
      if (covers(k, w)) return false;
    }
    if (!near.empty() && !is_on_edge(w) && !trim(near, w)) return false;
    edge.add(w);
    return true;
  }
  void clear() { known_.clear(); }

 private:
  // What has moved() must not look like an improvement, or light would go round for ever and improve each time;
  // dropping a true one of that size costs no more than that.
  static bool covers(const Window& k, const Window& w) {
    const Real m = moved(w);
    if (k.b0 > w.b0 + m || k.b1 < w.b1 - m) return false;
    const auto no_worse = [&](Real x) { return value_at(k, x) <= value_at(w, x) + m; };
    if (!no_worse(w.b0) || !no_worse(w.b1)) return false;
    const Real x = equal_slope(k, w);
    return !(x > w.b0 && x < w.b1) || no_worse(x);
  }

  // From both ends inwards, as long as one of the known windows is no worse there. (Windows with their source on the
  // edge say nothing about the light beyond: their light leaves through that one point.)
  static bool trim(std::span<const Window> known, Window& w) {
    const Real m = moved(w);
    // They come from left to right: one round brings the left end as far as it goes, few more the right one. Less than
    // m is no progress.
    constexpr int kRounds = 4;
    bool again = true;
    for (int round = 0; again && round < kRounds; ++round) {
      again = false;
      for (const Window& k : known) {
        if (is_on_edge(k) || k.b1 <= w.b0 || k.b0 >= w.b1) continue;
        if (k.b0 <= w.b0 + m) {
          const Real to = no_worse_until(k, w, w.b0, std::min(k.b1, w.b1), m);
          if (to > w.b0 + m) w.b0 = to, w.d0 = value_at(w, to), again = true;
        }
        if (!(w.b1 > w.b0) || is_sliver(w)) return false;
        if (k.b1 >= w.b1 - m) {
          const Real to = no_worse_until(k, w, w.b1, std::max(k.b0, w.b0), m);
          if (to < w.b1 - m) w.b1 = to, w.d1 = value_at(w, to), again = true;
        }
        if (!(w.b1 > w.b0) || is_sliver(w)) return false;
      }
    }
    return true;
  }

  // How far from one place of the edge towards another k is no worse than w all the way.
  static Real no_worse_until(const Window& k, const Window& w, Real from, Real to, Real m) {
    const auto difference = [&](Real x) { return value_at(k, x) - value_at(w, x) - m; };
    const Real at_from = difference(from);
    if (at_from > 0) return from;
    const Real x = equal_slope(k, w);  // the difference is monotone before it and behind it
    const bool between = (x - from) * (to - x) > 0;
    for (const Real end : {between ? x : to, to}) {
      const Real at_end = difference(end);
      if (at_end > 0) return crossing_of(k, w, from, end, at_from, at_end);
    }
    return to;
  }
  // Nearer to `from` than where they cross, if anything.
  static Real crossing_of(const Window& k, const Window& w, Real from, Real end, Real at_from, Real at_end) {
    if (!(at_from < 0)) return from;
    return from < end ? tie_point(k, w, from, end, at_from, at_end) : tie_point(k, w, end, from, at_end, at_from);
  }

  // What is known of one halfedge, by where it begins.
  struct Edge {
    std::vector<Window> windows;
    Real widest = 0;

    // Those that may reach into [b0,b1].
    std::span<const Window> around(Real b0, Real b1, Real m) const {
      const auto before = [](const Window& k, const Real& x) { return k.b0 < x; };
      const auto begin = std::lower_bound(windows.begin(), windows.end(), b0 - widest - m, before);
      const auto end = std::lower_bound(begin, windows.end(), b1 + m, before);
      return {begin, end};
    }
    void add(const Window& w) {
      const auto after = [](const Real& x, const Window& k) { return x < k.b0; };
      windows.insert(std::upper_bound(windows.begin(), windows.end(), w.b0, after), w);
      widest = std::max(widest, w.b1 - w.b0);
    }
  };

  std::unordered_map<Index, Edge> known_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
