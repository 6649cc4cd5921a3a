// Shortening a given polyline until it is locally shortest, within its homotopy class.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/surface_path.h>

#include <span>

namespace brushfire {

// The shortest path that the polyline can be pulled into like a rubber band, its ends held (a closed one is held
// nowhere): straight across faces, and where it bends at a vertex the angle is at least pi on either side. It keeps the
// polyline's way around handles and holes, so it need not be the shortest of all. A closed curve that can be pulled
// together becomes a single point of length 0.
//
// `points`: consecutive ones share a face. Throws Error(InvalidArgument) where they do not or where there is none; what
// locate() throws. Vertices are gone round one by one, those with the sharpest corners first; each such step shortens
// the path, or is the last at that corner, and costs what the two pieces that meet there cross.
//
// Based on: Mitchell, Mount, Papadimitriou, "The discrete geodesic problem", 1987 (what a locally shortest path is);
// Xin, Wang, "Efficiently determining a locally exact shortest path on polyhedral surfaces", 2007 (going round a vertex
// on its other side); Sharp, Crane, "You can find geodesic paths in triangle meshes by just flipping edges", 2020
// (sharpest corners first); the same for arbitrary triangle complexes, where "side" is a way through the vertex's link.
SurfacePath shorten(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed = false);

// The same within walls, which hold it up. Throws Error(InvalidArgument) for a polyline that goes through one.
SurfacePath shorten(const Domain& domain, std::span<const SurfacePoint> points, bool closed = false);

}  // namespace brushfire
