// Sleeves: the faces that a piece of a path runs through, and the shortest path through them.
#pragma once

#include <brushfire/mesh/detail/wide_face.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <unordered_map>
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
  Crossing first, last;  // of its steps, where there are any
  DoubleDouble length;   // mesh.unit(); wide, so that what a round gains at the smallest corner is seen
};

// Frames of halfedges, computed once: shortening lays out the same faces again and again.
class FrameCache {
 public:
  explicit FrameCache(const Mesh& mesh) : mesh_(mesh) {}
  const WideFrame& of(Index h);

 private:
  const Mesh& mesh_;
  std::unordered_map<Index, WideFrame> frames_;
};

// The shortest path through the sleeve: straight pieces that meet at vertices. Also splits where a straight piece
// runs over a vertex (passes it at kTouch of the way to the nearer end), so that every vertex on the path is an end of
// a piece.
// O(steps x pieces) at worst, O(steps) where pieces are long.
std::vector<StraightPiece> shortest_in_sleeve(const Mesh& mesh, Sleeve sleeve, FrameCache& frames);
inline constexpr double kTouch = 1e-9;  // the bend; its cost is the square of that: below rounding

// The points of a straight piece from begin to end, begin left out where it repeats `points.back()`.
void append_points(const Mesh& mesh, const StraightPiece& straight, FrameCache& frames,
                   std::vector<SurfacePoint>& points);

// Where a straight piece leaves its first face, by the weights there, and enters its last face.
std::array<double, 3> point_after_begin(const Mesh& mesh, const StraightPiece& straight);
std::array<double, 3> point_before_end(const Mesh& mesh, const StraightPiece& straight);

}  // namespace brushfire::detail
