// Offsets of any size: what is far from the lengths of the mesh is kept out of the engines.
#pragma once

#include <brushfire/solvers/detail/engine.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace brushfire::detail {

// Engines compute in mesh.unit(), where an offset of 1e308 may have no number, and where one of 1e40 has none in float.
// Such a run is split: every source gets the least offset of its component as its base, the engine sees how far it is
// above that, and the base is added to what comes back. A source so far above that another one dominates it wherever
// it reaches is moved down to where that is still so: what the engine sees is never beyond the size of the mesh.
class Offsets {
 public:
  // Takes the offset of every located source, in the mesh's units, and sets it as the engine sees it. O(sources log
  // sources); the first time that several sources have an offset beyond kTame also O(faces). The mesh is the same in
  // every call.
  void split(const Mesh& mesh, std::span<LocatedSource> located);

  // By source, in the mesh's units; empty: 0.
  std::span<const double> bases() const { return bases_; }

  // A value of the engine's from this source (kNoIndex: none), in the mesh's units.
  // `bound`: on which side of it, whatever the sum rounds to.
  double value(double engine_value, Index source, double unit, Bound bound = Bound::Estimate) const {
    double above = engine_value * unit;
    // The only products that round: those below the numbers with all digits.
    if (bound != Bound::Estimate && above < std::numeric_limits<double>::min() && above / unit != engine_value) {
      above = bound == Bound::Upper ? std::nextafter(above, kInfinity) : std::max(0.0, std::nextafter(above, 0.0));
    }
    if (bases_.empty() || source == kNoIndex || !(above < kInfinity)) return above;
    const double sum = bases_[source] + above;
    if (bound == Bound::Estimate) return sum;
    return std::nextafter(sum, bound == Bound::Lower ? -kInfinity : kInfinity);
  }
  // The engine's bound of such a value, with what adding the base, or a number too small for its digits, rounds away.
  double bound(double engine_bound, double engine_value, double value, double unit) const;

  // The radius for the engine: where bases differ it serves all, and what lies beyond its own is left to the caller.
  double radius(double max_distance, double unit) const;

  // Offsets up to this many units go to the engine as they are: in float, their sums with lengths are rounded by less
  // than a ten thousandth of a mean edge.
  static constexpr double kTame = 0x1p10;

 private:
  void look_at(const Mesh& mesh);

  std::vector<double> bases_;
  std::vector<Index>
      component_;          // [vertex_count] where it has been needed: the lowest vertex that hangs together with it
  double beyond_all_ = 0;  // farther than any two points of a component are from each other
};

}  // namespace brushfire::detail
