// Directions at a vertex, and the shortest way around it from one to another.
#pragma once

#include <brushfire/queries/detail/sleeve.h>

#include <array>
#include <vector>

namespace brushfire::detail {

// A direction at a vertex: within the corner that halfedge `corner` names, `angle` from that halfedge.
struct Direction {
  Index corner = kNoIndex;
  double angle = 0;
};

// From a vertex of face f towards another point of f.
Direction direction_towards(const Mesh& mesh, Index vertex, Index f, const std::array<double, 3>& point);

// The direction in which a straight piece that begins (ends) at a vertex leaves it (comes from).
Direction direction_at_begin(const Mesh& mesh, const StraightPiece& straight);
Direction direction_at_end(const Mesh& mesh, const StraightPiece& straight);

// An angle that misses pi by less gains less than rounding loses: cutting the corner shortens the two pieces by a share
// of its square.
inline constexpr double kStraightAngle = 1e-8;

// The shortest way around a vertex from one direction to another: its angle and the edges that it crosses.
struct WayAround {
  double angle = kInfinity;  // +inf: there is none of less than pi
  std::vector<Step> steps;
};
WayAround shortest_way_around(const Mesh& mesh, Index vertex, const Direction& from, const Direction& to);

}  // namespace brushfire::detail
