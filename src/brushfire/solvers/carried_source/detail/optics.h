// What light does at the sides of a vertex that is laid out by itself: at a boundary, where faces are mirrored, where
// more than two meet, ...
#pragma once

#include <brushfire/solvers/carried_source/detail/sight.h>

#include <utility>
#include <vector>

namespace brushfire::carried_source {

// A direction at a vertex, and which light passes below an edge that runs that way.
struct Optic {
  double angle = 0, c = 0, s = 0;
  Index sector = 0;
  SightSets sets;
  Index lenses[2] = {kNoIndex, kNoIndex};  // at odd vertices, by Hand; 0: no light
};

// The lenses of all odd vertices.
class LensStore {
 public:
  LensStore() : lenses_(1) {}  // number 0: nothing comes through
  Index keep(const Lenses& lenses);
  std::vector<Lenses> take() { return std::move(lenses_); }

 private:
  std::vector<Lenses> lenses_;
};

class VertexOptics {
 public:
  VertexOptics(const Mesh& mesh, Index v, Fans fans, LensStore& lenses);

  const Fans& fans() const { return fans_; }
  const Optic& side(Index number) const { return sides_[number]; }
  // In any direction. A seam's is that of the first side.
  Optic in_direction(const Direction& named, LensStore& lenses) const;

 private:
  Fans fans_;
  std::vector<FanEnd> ends_;  // of an odd vertex
  std::vector<Optic> sides_;
};

}  // namespace brushfire::carried_source
