// What light does at the sides of every vertex: computed once for each, and used by the records of both ends.
#pragma once

#include <brushfire/solvers/carried_source/detail/sight.h>

#include <unordered_map>
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

class Optics {
 public:
  Optics(const Mesh& mesh, const Fans& fans);

  const Optic& side(Index v, Index number) const { return sides_[begin_[v] + number]; }
  Optic of(Index v, const Direction& named);

  // A closed fan's first side may be named as its last, with the sum of all angles. (Odd vertices have two.)
  bool is_seam(Index v, const Direction& at) const;

  std::vector<Lenses> take_lenses() { return std::move(lenses_); }

 private:
  Direction shared(Index v, const Direction& at) const { return is_seam(v, at) ? fans_.within(v, at.fan, 0) : at; }
  Index keep(const Lenses& lenses);

  const Mesh& mesh_;
  const Fans& fans_;
  std::vector<std::size_t> begin_;  // [vertex_count + 1]
  std::vector<Optic> sides_;
  std::vector<Lenses> lenses_;
  std::unordered_map<Index, std::vector<FanEnd>> fan_ends_;  // of odd vertices
};

}  // namespace brushfire::carried_source
