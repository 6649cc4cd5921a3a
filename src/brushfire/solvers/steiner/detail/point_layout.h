// Where the points on edges lie.
// Based on: Aleksandrov, Maheshwari, Sack (2005), Determining approximate shortest paths on weighted polyhedral
// surfaces: points that grow denser towards the vertices, in steps of a share of the distance to the other edges.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/solvers/steiner/detail/weighted_mesh.h>

#include <cstddef>
#include <vector>

namespace brushfire::steiner {

// How dense. With s the sine of the angle at a vertex (the least of the faces beside the edge), the interval at
// distance t from the vertex is `growth` * s * t + `least` * height long, with the least altitude of a face over the
// edges at the vertex. No edge has more than `most` intervals.
struct Density {
  double growth = 0.3, least = 0.05;
  Index most = 64;

  friend bool operator==(const Density&, const Density&) = default;
};

// Every edge has a row of points: its first vertex, points between, its last vertex; then room up to a multiple of
// kLanes, which lies at the last vertex. Points are numbered along the rows. Both sides of a fence have the same
// points.
class PointLayout {
 public:
  static constexpr Index kLanes = 4;

  // Throws Error(TooLarge) where the numbers, or the memory that a search needs, are too many.
  PointLayout(const WeightedMesh& weighted, const Density& density);

  Index row(Index edge) const { return rows_[edge]; }      // its first point
  Index count(Index edge) const { return counts_[edge]; }  // of its points, both ends among them
  Index room(Index edge) const { return rows_[edge + 1] - rows_[edge]; }
  Index longest_row() const { return longest_; }
  Index size() const { return rows_.back(); }
  double at(Index point) const { return at_[point]; }  // distance from the edge's first vertex, in mesh.unit()
  const double* at_row(Index edge) const { return at_.data() + rows_[edge]; }
  Index edge_of(Index point) const;  // O(log edges)

 private:
  std::vector<Index> rows_;    // [edges + 1]
  std::vector<Index> counts_;  // [edges]
  std::vector<double> at_;
  Index longest_ = 0;
};

}  // namespace brushfire::steiner
