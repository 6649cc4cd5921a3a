// Polygons to triangles, each of which remembers the polygon that it comes from.
#pragma once

#include <brushfire/core/types.h>

#include <span>
#include <vector>

namespace brushfire {

struct Triangulation {
  std::vector<Face> faces;
  std::vector<Index> origin;  // [faces] the polygon that each face was cut from
};

// Polygon p has the corners polygon_vertices[polygon_offset[p]] .. polygon_vertices[polygon_offset[p+1] - 1], in order;
// polygon_offset has one entry more than there are polygons and starts with 0. A polygon of n corners gives n - 2 faces
// of its own orientation, in the order of the polygons; fewer than three corners give none. Triangles pass unchanged,
// the same vertex named twice included.
//
// Convex, concave, planar or bent, with collinear or repeated corners: seen along its mean normal the polygon is cut by
// ear clipping, a quadrilateral along the shorter of its valid diagonals. Where the outline crosses itself there is no
// right answer, but always n - 2 faces. O(n log n) for ordinary outlines, O(n^2) at worst; memory O(n).
//
// Throws Error(InvalidMesh) naming the polygon with a corner >= positions.size(), and Error(InvalidArgument) for
// offsets that do not fit.
Triangulation triangulate_polygons(std::span<const Vec3> positions, std::span<const Index> polygon_offset,
                                   std::span<const Index> polygon_vertices);

}  // namespace brushfire
