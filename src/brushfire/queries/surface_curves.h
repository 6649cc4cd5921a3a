// Curves on the surface made from chains of vertices, and from polylines drawn in space.
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/surface_path.h>

#include <span>

namespace brushfire {

// The curve along edges through these vertices. Throws Error(IndexOutOfRange) for one that does not exist, and
// Error(InvalidArgument) for none at all, and for two neighbours that no edge joins, with their places in the list.
SurfacePath curve_along(const Mesh& mesh, std::span<const Index> vertices, bool closed = false);

struct ProjectedCurve {
  SurfacePath path;
  double largest_gap = 0;  // how far the polyline is from the surface at most, of the places that were looked at
  Vec3 gap_position;       // of the polyline, where that is
};

// A polyline in space, projected onto the surface: its corners and, along pieces that are longer than the mesh's mean
// edge, enough points that no piece is longer, each at the nearest point of the surface; between them shortest paths.
// Whether a curve that lies far off the surface is meaningful is up to the caller: largest_gap says how far. Throws
// Error(InvalidArgument) for no points, a mesh without positions, and places between which no way leads; what
// NearestPointFinder throws. O(points log faces) and a short exact run for each.
ProjectedCurve project_curve(const Domain& domain, std::span<const Vec3> positions, bool closed = false,
                             const CancelToken* cancel = nullptr);

}  // namespace brushfire
