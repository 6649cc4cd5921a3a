// Obtuse corners: what lights them from farther away, over the faces behind their opposite edge.
//
// Based on: Kimmel, Sethian (1998), Computing Geodesic Paths on Manifolds, section 4.
#pragma once

#include <brushfire/solvers/carried_source/detail/fans.h>

#include <vector>

namespace brushfire::carried_source {

// One of the two vertices that support an obtuse corner over unrolled faces. The corner's vertex lies at (0,0).
struct UnrolledEnd {
  Index vertex = kNoIndex;
  Vec2 at;
  bool same_turn = true;            // whether its angles run counter-clockwise in the plane
  Direction to_corner, to_other;    // its own, to the obtuse corner and to the other one of the two
  Direction from_corner;            // of the obtuse corner's vertex
  Index side_to_corner = kNoIndex;  // the side of a fan along the edge; kNoIndex: there is no such edge
  Index side_to_other = kNoIndex;
};

struct UnrolledTriangle {
  Index corner = kNoIndex;       // the obtuse one, as a halfedge
  bool corner_same_turn = true;  // as same_turn, of its vertex
  UnrolledEnd right, left;       // seen from the corner, counter-clockwise
};

class Unroller {
 public:
  Unroller(const Mesh& mesh, const Fans& fans) : mesh_(mesh), fans_(fans), lengths_(mesh.lengths()) {}

  bool is_obtuse(Index corner) const;
  // Appends the triangles that split the angle at an obtuse corner. Whether they split it into acute ones; false where
  // it ended before: at a boundary, at an edge of more faces, after `most`. `crossed`: how many
  // faces it looked at.
  bool unroll(Index corner, int most, std::vector<UnrolledTriangle>& triangles, int& crossed) const;

 private:
  // A vertex of the unrolled faces, and how its fan lies in the plane.
  struct Anchor {
    Index vertex = kNoIndex;
    Vec2 at;
    bool same_turn = true;
    Index fan = 0;
    double angle = 0, in_plane = 0;  // of one and the same direction
    Index side_to_corner = kNoIndex;
  };
  Anchor anchor(Index corner, bool mirrored, Vec2 at, Vec2 next) const;
  Direction direction(const Anchor& from, Vec2 towards) const;
  UnrolledEnd end(Index corner, const Anchor& at, const Anchor& other, Index side_to_other) const;

  const Mesh& mesh_;
  const Fans& fans_;
  std::span<const double> lengths_;
};

}  // namespace brushfire::carried_source
