// SurfacePoint: the one way to say where on a mesh.
#pragma once

#include <brushfire/mesh/mesh.h>  // IWYU pragma: export

#include <array>

namespace brushfire {

// A point of face `face`: weights[k] belongs to corner k, each >= 0, summing to one. Points of an edge or a vertex have
// several such names; they all mean the same point.
struct SurfacePoint {
  Index face = kNoIndex;
  std::array<double, 3> weights{0, 0, 0};

  // Whether it is in no face, as a default-constructed SurfacePoint is. As a target such a point reads +inf.
  bool is_nowhere() const { return face == kNoIndex && weights == std::array<double, 3>{0, 0, 0}; }
};

// Weights at or below kWeightSnap read as 0 (a point that near to a vertex is the vertex: rounding of barycentric
// coordinates cannot place it any better); below -kWeightError they are an error.
inline constexpr double kWeightSnap = 1e-12;
inline constexpr double kWeightError = 1e-9;

// What a surface point lies on, after snapping.
struct PointLocation {
  enum class On : std::uint8_t { Vertex, Edge, Interior };
  On on = On::Interior;
  Index vertex = kNoIndex;    // the vertex, where on == Vertex
  Index halfedge = kNoIndex;  // of the point's face, where on == Edge
  double t = 0;               // the share of the way along that halfedge, in (0,1)
  Index face = kNoIndex;
  std::array<double, 3> weights{0, 0, 0};  // snapped and normalised
};

// Validates and snaps. A point of a face that names a vertex twice is one of an edge (or a vertex), and is given a face
// of that edge with three distinct vertices where there is one: `face` and `weights` may then be others than the
// point's. Throws Error(IndexOutOfRange) for a face that does not exist, Error(InvalidArgument) for weights that are
// not finite, below -kWeightError, or do not sum to 1 within 1e-9. Points of a path, whose weights were computed and
// not measured, are located with a snap of 0: on an edge that is 1e12 times longer than its neighbours, no weight is
// too small.
PointLocation locate(const Mesh& mesh, const SurfacePoint& point, double snap = kWeightSnap);

// Vertex v as a point of one of its faces. Throws Error(IndexOutOfRange) where there is no such vertex, and
// Error(InvalidArgument) where the vertex is in no face: nothing can be reached from there.
SurfacePoint vertex_point(const Mesh& mesh, Index v);

// Vertex v as a target: nowhere (see SurfacePoint) where it is in no face, which no source reaches. Throws
// Error(IndexOutOfRange) where there is no such vertex.
SurfacePoint target_point(const Mesh& mesh, Index v);

// Where the point is, in the mesh's coordinates. The mesh must have positions.
Vec3 position(const Mesh& mesh, const SurfacePoint& point);

// The straight distances, within the point's own face, to its three corners, in mesh.unit(): exact to rounding also
// where the point is far closer to an edge or a corner than to the rest.
std::array<double, 3> corner_distances(const Mesh& mesh, const PointLocation& point);

}  // namespace brushfire
