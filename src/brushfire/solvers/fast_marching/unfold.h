// Support for obtuse corners: triangles that reach through the opposite edge into the faces behind it.
//
// Based on: Kimmel, Sethian (1998), Computing Geodesic Paths on Manifolds, section 4.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire::detail {

// A triangle of the plane into which the faces behind an obtuse corner were unrolled: the corner lies at (0,0), the
// other two vertices where these say. The straight lines from the corner to points between them stay in those faces.
struct UnfoldedTriangle {
  Index corner_vertex = kNoIndex;
  Index first = kNoIndex, second = kNoIndex;
  Vec2 at_first, at_second;
};

inline constexpr double kRightAngle = 1e-9;  // rounding of coordinates tilts right angles by less than this

// The halfedge that names the obtuse corner of face f, kNoIndex where there is none (right angles, up to rounding, are
// not obtuse). squared_length[k]: of halfedge 3f + k.
inline Index obtuse_corner(const std::array<double, 3>& squared_length, Index f) {
  const auto [aa, bb, cc] = squared_length;
  // Only the corner across the longest edge can be.
  const double ab = aa >= bb ? aa : bb, most = ab >= cc ? ab : cc;
  const double others = ab >= cc ? cc + (aa >= bb ? bb : aa) : aa + bb;
  const Index across = ab >= cc ? (aa >= bb ? 2u : 0u) : 1u;
  return others < most * (1 - kRightAngle) ? 3 * f + across : kNoIndex;
}

struct Unfolding {
  int crossed = 0;     // edges that were crossed
  bool split = false;  // false: it ended at a boundary, a non-manifold edge or after kMaxUnfolded faces
};

// Unrolls faces, one corner after the other.
class Unfolder {
 public:
  explicit Unfolder(const Mesh& mesh, Variant variant = Variant::Best);

  // Splits the obtuse angle at the corner of halfedge h into acute ones: unrolls faces behind the opposite edge, one by
  // one, until a vertex appears that splits it, and the same with what is left of the angle. Appends the triangles.
  Unfolding unfold(Index h, std::vector<UnfoldedTriangle>& triangles) const;

 private:
  Mesh::FaceGeometry geometry(Index f) const;
  Index neighbour(Index h) const;  // Mesh::neighbour()

  const Mesh& mesh_;
  // What it looks up itself, where the mesh has positions and no slits.
  bool plain_, in_registers_;
  std::span<const Vec3> positions_;
  std::span<const Face> faces_;
  std::span<const Index> corner_offsets_, corners_;
  double scale_;
};

inline constexpr int kMaxUnfolded = 64;

}  // namespace brushfire::detail
