// Where the search for a leg may begin: at the point, and at vertices and edges that cannot be told from it.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <array>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

namespace brushfire::windows {

// A point by one of its faces.
struct PointInFace {
  Index face;
  std::array<double, 3> weights;
};

// All of them; a face that has a vertex twice comes once for every corner.
std::vector<PointInFace> names_of(const Mesh& mesh, const PointLocation& at);

std::array<double, 3> corner_weights(Index k);

// The point itself, or a vertex at no distance from it.
struct LegOrigin {
  PointLocation at;
  double before = 0;          // the way from the point
  Index previous = kNoIndex;  // over which other one
  double rounded = 0;         // of `before`, what lies between places of edges and vertices that they cannot tell apart
};

class LegOrigins {
 public:
  // `value`: of the point.
  LegOrigins(const Mesh& mesh, const PointLocation& at, double value);

  Index size() const { return static_cast<Index>(origins_.size()); }
  const LegOrigin& operator[](Index i) const { return origins_[i]; }
  // Of the ways to them.
  double rounding() const { return rounding_; }
  // Whether vertex v is one that has the point's value, as far as anyone knows: no leg ends there.
  bool has_value_of(Index v) const;

 private:
  double no_distance() const;
  double no_distance(const LegOrigin& from, Index face) const;
  void spread(Index i);  // from origin i
  // Keeps the nearest of each vertex and edge.
  void offer(const LegOrigin& origin);
  void offer_across(const PointInFace& f, Index h, Index previous);
  PointLocation at_corner(Index corner) const;
  Index edge_of(Index h) const;

  const Mesh& mesh_;
  double value_;
  double rounding_ = 0;
  std::vector<LegOrigin> origins_;
  std::unordered_map<Index, Index> at_vertex_, on_edge_;  // which of them
  // Whose neighbours are to be looked at; what is not its `before` any more is done.
  std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>> open_;
};

}  // namespace brushfire::windows
