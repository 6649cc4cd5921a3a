// What is left of the windows of an edge: trimmed against each other, and merged with their neighbours.
#pragma once

#include <brushfire/solvers/windows/algebra/envelope.h>
#include <brushfire/solvers/windows/algebra/merge.h>
#include <brushfire/solvers/windows/algebra/sweep.h>
#include <brushfire/solvers/windows/algebra/window.h>

#include <cstddef>
#include <span>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// L2, L8. From left to right, each with the one before it as long as that works. Returns how many are left.
template <class Merge>
std::size_t merge_neighbours(std::span<Window> w, Merge&& merge) {
  std::size_t last = 0;
  for (std::size_t i = 1; i < w.size(); ++i) {
    w[++last] = w[i];
    while (last > 0 && w[last].b0 - w[last - 1].b1 <= 2 * kSliver * sliver_scale(w[last]) &&
           merge(w[last - 1], w[last], Joint{w[last - 1].b1, w[last - 1].d1, w[last].d0})) {
      w[last - 1] = w[last];
      --last;
    }
  }
  return w.empty() ? 0 : last + 1;
}

// L2, L5, L8. `merge(a, b, joint)` puts both into b, or returns false.
template <class Merge>
std::span<Window> merge_all(std::span<Window> windows, Envelope& envelope, Merge&& merge) {
  constexpr std::size_t kFew = 8;  // more are sorted by the envelope
  if (windows.size() <= kFew) {
    for (std::size_t i = 1; i < windows.size(); ++i) {
      for (std::size_t j = i; j > 0 && windows[j].b0 < windows[j - 1].b0; --j) std::swap(windows[j], windows[j - 1]);
    }
    Sweep sweep(windows, merge);
    const bool done = sweep();
    windows = windows.first(sweep.count());
    if (done) return windows;
  }
  windows = envelope(windows);
  return windows.first(merge_neighbours(windows, merge));
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
