// Trimming: of the windows on one edge, the parts that are the least somewhere.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// L5. The lower envelope of windows on one edge, by merging envelopes of halves: O(n log n) windows, whatever their
// order and overlap (two windows cross at most twice, so envelopes stay short). Keeps its buffers between calls.
class Envelope {
 public:
  // The envelope, from left to right, disjoint; valid until the next call. Windows are equal only within rounding
  // (tie()): the one with the lower pseudo-source wins then. Parts narrower than a sliver are dropped.
  std::span<Window> operator()(std::span<const Window> windows);

 private:
  struct Part {
    const Window* window;
    Real b0, b1, d0, d1;
  };
  void merge(std::size_t begin, std::size_t middle, std::size_t end);
  void decide(const Part& a, const Part& b, Real p, Real q, Real ap, Real bp, Real aq, Real bq);
  void add(const Window& w, Real b0, Real b1, Real d0, Real d1);

  std::vector<Part> parts_, merged_;
  std::vector<std::size_t> starts_, next_starts_;
  std::vector<Window> result_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
