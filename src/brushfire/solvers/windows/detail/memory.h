// What has come over the edges of thin faces in a run.
#pragma once

#include <brushfire/solvers/windows/detail/ridge.h>
#include <brushfire/solvers/windows/detail/window.h>

#include <limits>
#include <unordered_map>
#include <vector>

namespace brushfire::detail::BRUSHFIRE_NUMBERS {

// Around a needle, or through two faces without area over the same vertices, light comes back to where it was hardly
// longer or no longer at all, as often as you like; nothing that compares with vertices would stop it. Over the edges
// of thin faces, therefore, every window is remembered, and one that is nowhere shorter than an earlier one is dropped:
// trimming (L5), only that the earlier one may have moved on. (Among windows that tie, the first stays, so it is safe.)
class WindowMemory {
 public:
  // False where an earlier window of h makes this one superfluous; else it is remembered.
  bool learn(Index h, const Window& w) {
    std::vector<Window>& known = known_[h];
    for (const Window& k : known) {
      if (covers(k, w)) return false;
    }
    known.push_back(w);
    return true;
  }
  void clear() { known_.clear(); }

 private:
  static constexpr Real kTurns = 32 * std::numeric_limits<Real>::epsilon();

  static bool covers(const Window& k, const Window& w) {
    // Light that has come round has been turned through a few frames: its source and its ends have moved by some
    // epsilons of the longest number there. That must not look like an improvement, or it would go round for ever and
    // improve each time; dropping a true one of that size costs no more than that.
    const Real moved = kTurns * (norm(w.source) + w.b1);
    if (k.b0 > w.b0 + moved || k.b1 < w.b1 - moved) return false;
    const auto no_worse = [&](Real x) { return value_at(k, x) <= value_at(w, x) + moved; };
    if (!no_worse(w.b0) || !no_worse(w.b1)) return false;
    const Real x = equal_slope(k, w);
    return !(x > w.b0 && x < w.b1) || no_worse(x);
  }

  std::unordered_map<Index, std::vector<Window>> known_;
};

}  // namespace brushfire::detail::BRUSHFIRE_NUMBERS
