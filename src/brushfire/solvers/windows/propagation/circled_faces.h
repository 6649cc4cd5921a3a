// The faces around vertices that a run's sources are beside.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/windows/propagation/structure.h>

#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// From a source at a distance e from a vertex light may go round the vertex in circles of that length, more often than
// any tolerance for rounding can tell, and where e is rounding itself for ever ("Why every run ends" in
// docs/tolerance.md). So the faces there count as thin for the run: windows remember that they have crossed them.
class CircledFaces {
 public:
  // Forgets the sources of the run before and marks the faces of these. O(sources), and faces at vertices beside them.
  void mark(std::span<const detail::LocatedSource> sources, WindowStructure& structure);
  void clear(WindowStructure& structure);

 private:
  void mark(const PointLocation& at, WindowStructure& structure);
  void mark(Index v, Real distance, WindowStructure& structure);

  std::vector<Index> faces_;    // those that are not thin by themselves
  std::vector<Index> corners_;  // room to work in
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
