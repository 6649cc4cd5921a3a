// Vertices of a domain on the sides of its walls, for what heat carries; one value of several back to one.
#pragma once

#include <brushfire/mesh/domain.h>

#include <utility>
#include <vector>

namespace brushfire::heat {

// The vertices of domain.open() that lie at a vertex of the mesh, ascending. Throws Error(IndexOutOfRange) for one that
// does not exist, Error(InvalidArgument) for one in no face or behind walls.
std::vector<Index> sides_of(const Domain& domain, Index vertex);

// The one there is. Throws Error(InvalidArgument) where walls part the surface: its sides have no common directions.
Index only_side_of(const Domain& domain, Index vertex);

// Values per vertex of domain.open() to values per vertex of the mesh: of each that of the side that is `nearer` than
// the others, where nearer(a, b) compares two vertices of domain.open(); of equal ones the first.
template <class Value, class Nearer>
std::vector<Value> of_nearest_sides(const Domain& domain, std::vector<Value> values, const Nearer& nearer) {
  const Index count = domain.mesh().vertex_count(), sides = domain.open().vertex_count();
  if (sides == count) return values;
  std::vector<Index> nearest(count);
  for (Index v = 0; v < sides; ++v) {
    Index& best = nearest[domain.vertex(v)];
    if (v < count || nearer(v, best)) best = v;
  }
  std::vector<Value> found;
  found.reserve(count);
  for (const Index side : nearest) found.push_back(values[side]);
  return found;
}

}  // namespace brushfire::heat
