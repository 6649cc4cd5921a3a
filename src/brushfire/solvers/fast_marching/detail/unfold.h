// Support for obtuse corners: triangles that reach through the opposite edge into the faces behind it.
//
// Based on: Kimmel, Sethian (1998), Computing Geodesic Paths on Manifolds, section 4.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire::fast_marching {

// A triangle of the plane into which the faces behind an obtuse corner were unrolled: the corner lies at (0,0), the
// other two vertices where these say. The straight lines from the corner to points between them stay in those faces.
struct UnfoldedTriangle {
  Index corner_vertex = kNoIndex;
  Index first = kNoIndex, second = kNoIndex;
  Vec2 at_first, at_second;
};

inline constexpr double kRightAngle = 1e-9;  // rounding of coordinates tilts right angles by less: not obtuse yet

struct Unfolding {
  bool obtuse = true;  // false: the corner is not, nothing was done
  int crossed = 0;     // edges that were crossed
  bool split = false;  // false: it ended at a boundary, a non-manifold edge or after as many faces as it may
};

// Unrolls faces, one corner after the other.
class Unfolder {
 public:
  explicit Unfolder(const Mesh& mesh);

  // Splits the angle at the corner of halfedge h, where it is obtuse, into acute ones: unrolls faces behind the
  // opposite edge, one by one, until a vertex appears that splits it, and the same with what is left of the angle.
  // Appends the triangles. `most`: faces.
  Unfolding unfold(Index h, int most, std::vector<UnfoldedTriangle>& triangles) const;

  bool is_plain() const { return plain_; }  // positions, and no slits
  // The other face at the edge of face f between v and w; kNoIndex where there is not exactly one.
  Index face_over(Index f, Index v, Index w) const;
  Mesh::FaceGeometry geometry(Index f) const;  // as the mesh's, quicker

 private:
  // The face over an edge that runs from the left to the right of who looks at it.
  struct Behind {
    Index face = kNoIndex, vertex = kNoIndex;  // kNoIndex: none; the vertex that is not on the edge
    double to_left = 0, to_right = 0;          // from that vertex to the edge's ends
    double double_area = 0;
  };
  Behind look_over(Index f, Index left, Index right) const;

  const Mesh& mesh_;
  // What it looks up itself, where the mesh has positions and no slits.
  bool plain_;
  std::span<const Vec3> positions_;
  std::span<const Face> faces_;
  std::span<const Index> corner_offsets_, corners_;
  double scale_;
};

}  // namespace brushfire::fast_marching
