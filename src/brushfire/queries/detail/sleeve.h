// Sleeves: the faces that a piece of a path runs through, and the shortest path through them.
#pragma once

#include <brushfire/core/detail/double_double.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <optional>
#include <vector>

namespace brushfire::detail {

// From one face into the next over their common edge: `out` is the edge's halfedge in the face that is left, `in` the
// one in the face that is entered.
struct Step {
  Index out = kNoIndex, in = kNoIndex;
};

// The faces that a piece of a path between two points runs through.
struct Sleeve {
  PointLocation begin, end;  // begin lies in first_face, end in the last face
  Index first_face = kNoIndex;
  std::vector<Step> steps;

  Index last_face() const { return steps.empty() ? first_face : Mesh::face_of(steps.back().in); }
};

// Takes away what a shortest path in the same sleeve never needs: steps over an edge and back again, and faces at both
// ends that the end point can do without.
void tidy(const Mesh& mesh, Sleeve& sleeve);

// A point of a step's edge by its weights at the ends of `out`: both, since 1 minus a small one has lost it.
struct Crossing {
  double from = 1, to = 0;
};

// A sleeve that holds, unfolded into the plane, the straight line from begin to end.
struct StraightPiece {
  Sleeve sleeve;
  std::vector<Crossing> crossing;  // [steps]
  DoubleDouble length;             // mesh.unit(); wide, so that what a round gains at the smallest corner is seen
};

// The shortest path through the sleeve: straight pieces that meet at vertices. Also splits where a straight piece
// runs over a vertex (passes it at kTouch of the way to the nearer end), so that every vertex on the path is an end of
// a piece.
// O(steps x pieces) at worst, O(steps) where pieces are long.
std::vector<StraightPiece> shortest_in_sleeve(const Mesh& mesh, Sleeve sleeve);
inline constexpr double kTouch = 1e-9;  // the bend; its cost is the square of that: below rounding

// The points of a straight piece from begin to end, begin left out where it repeats `points.back()`.
void append_points(const Mesh& mesh, const StraightPiece& straight, std::vector<SurfacePoint>& points);

// Where a straight piece leaves its first face, by the weights there, and enters its last face.
std::array<double, 3> point_after_begin(const Mesh& mesh, const StraightPiece& straight);
std::array<double, 3> point_before_end(const Mesh& mesh, const StraightPiece& straight);

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
  double angle = kInfinity;  // +inf: the directions are not connected around the vertex
  std::vector<Step> steps;
};
WayAround shortest_way_around(const Mesh& mesh, Index vertex, const Direction& from, const Direction& to);

}  // namespace brushfire::detail
