// Trimming of whole lists: windows lose the parts that others on the same edge reach by a shorter way.
#pragma once

#include <brushfire/solvers/windows/algebra/dominance.h>
#include <brushfire/solvers/windows/algebra/envelope.h>
#include <brushfire/solvers/windows/store/exact_lists.h>

#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// L5, L7 for the lists of exact runs. A list in order, nearly an envelope already, is gone through once from left to
// right: of two windows that overlap, one loses what it was shown to lose, at both ends of the overlap and where slopes
// are equal, as long as it stays in one piece; otherwise the overlap stays. Windows may overlap: each is a set of real
// paths, so what is not dropped costs time only. Lists out of order are replaced by their lower envelope.
class ListTrimmer {
 public:
  // Nothing beyond `radius` is wanted. The list may move to another block of the pool.
  void operator()(WindowList& list, const EdgeBounds& edge, Real radius, BlockPool& blocks);
  // Only what paths to the ends of the edge make superfluous, if any are given, and what is not wanted.
  void drop_useless(WindowList& list, const EdgeBounds& edge, Real radius);

 private:
  void sweep(const WindowColumns& w, Index count);
  void settle(const WindowColumns& w, Index a, Index b);
  void replace_by_envelope(WindowList& list, BlockPool& blocks);

  std::vector<Real> d0_, d1_;  // values at the ends
  // Of each window and the next one: where they cross, their values there; whether that is all there is to it.
  std::vector<Real> tie_point_, tie_value_a_, tie_value_b_, plain_;
  std::vector<Index> kept_;
  std::vector<Window> windows_, uncut_;
  Envelope envelope_;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
