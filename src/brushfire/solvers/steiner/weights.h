// Weights: what it costs to go over a face, along an edge and across one.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/steiner/slope_pace.h>

#include <array>
#include <optional>
#include <vector>

namespace brushfire {

// What an edge costs, apart from its faces; named by its two vertices.
struct EdgeCost {
  std::array<Index, 2> vertices{};
  // Per unit of length along the edge: a road, a river bank. > 0; more than a face beside it costs means nothing, since
  // one can go along the edge in that face; +inf: as in the faces. A face beside it must not be a wall.
  double along = kInfinity;
  // Added whenever the edge is crossed, from a face on one side to one on another: a fence, a ford. >= 0; +inf: a wall.
  // Nobody slips through at a vertex: the edges crossed around it are paid. Where a fence ends one can go round it.
  double crossing = 0;
};

// A metric in a face that is not the same in all directions: a unit of length along `direction` (as far as that lies in
// the face's plane) costs the face's weight, one at right angles to it `across` times as much, and one at an angle a to
// it sqrt(cos^2 a + across^2 sin^2 a) times as much. Every symmetric metric of a plane is one of these. Both ways cost
// the same.
struct Grain {
  Vec3 direction{};   // of any length; at right angles to the face, or 0: no grain
  double across = 1;  // > 0
};

// The cost of a path is the sum over its pieces of length times weight, plus what crossings cost. Weights of 1 and no
// edges are distances.
struct Weights {
  // [face_count] per unit of length in the face, > 0; +inf: a wall, as in Barriers::faces. Empty: 1 everywhere.
  std::vector<double> face = {};
  std::vector<EdgeCost> edges = {};  // of an edge that is named twice the lowest of `along`, the highest of `crossing`
  // Where set, a unit of length does not cost its weight, but that times what the pace is at its slope, for a unit of
  // length on the map. z is up, and the mesh must have positions. Paths from a to b and from b to a then differ.
  std::optional<SlopePace> pace = std::nullopt;

  // [face_count], or empty: 1 in all directions. Upper bounds only, and not together with `pace`; the mesh must have
  // positions.
  std::vector<Grain> grain = {};

  // Whether directions make no difference. Only then there are lower bounds, and paths that are straightened.
  bool is_isotropic() const { return !pace && grain.empty(); }
  // The weight of all faces where they have one and the same, no edge is special and no direction counts; else 0.
  double uniform() const;
};

// Throws Error(InvalidArgument) that names the face or the edge: not one weight per face, a weight that is not > 0 (the
// points of a face of weight 0 would all be one place: give it a small weight instead), a negative cost of crossing,
// two vertices that no edge joins, a road between walls; Error(IndexOutOfRange) for a vertex that does not exist.
void check(const Mesh& mesh, const Weights& weights);

// The halfedges over the edge of two vertices, in any direction, ascending; none where no edge joins them.
std::vector<Index> halfedges_between(const Mesh& mesh, Index a, Index b);

}  // namespace brushfire
