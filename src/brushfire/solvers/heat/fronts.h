// From the heat method's function, which is known up to a constant in each component, to distances: every source reads
// its own value.
#pragma once

#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/heat/system.h>

#include <span>
#include <vector>

namespace brushfire::heat {

// A source as the vertices of a face around it.
struct Origin {
  struct Corner {
    Index vertex = kNoIndex;
    double weight = 0;
    double distance = 0;  // of the source, straight
  };
  std::array<Corner, 3> corners;
  int count = 0;  // of corners with a weight
  double offset = 0;
  Index label = 0;
};

// Of located sources, in their order. Throws Error(InvalidArgument) for one on a border that is kept cold.
std::vector<Origin> origins_of(const Mesh& mesh, const System& system, std::span<const detail::LocatedSource> sources);

// Where the heat of each begins, later by its offset: heat falls by e with every sqrt(t).
Sparks sparks_of(const System& system, std::span<const Origin> origins);

// Writes distance and source of every vertex of components that have a source; the others stay as they are. `potential`
// has every width-th value, from its first on.
//
// Which source a vertex belongs to is found by flooding the function from all sources at once; every source's part is
// moved so that the source reads its offset. (One constant for a whole component, which is all that the equation leaves
// open, fits one source only.) A source that another one's front reaches first has no part of its own. No value is
// below the least offset. O(n), O(n log n) where a component has several sources.
void read_off(const Mesh& mesh, const System& system, std::span<const Origin> origins,
              std::span<const double> potential, std::size_t width, std::span<double> distance,
              std::span<Index> source);

}  // namespace brushfire::heat
