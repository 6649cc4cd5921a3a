// True Delaunay triangulations of points in the plane: the meshes on which the circular update is exact.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/shapes.h>

#include <cstdint>
#include <span>

namespace brushfire {

// The Delaunay triangulation of the points' convex hull, in the plane z = 0, counter-clockwise. The points are first
// moved to a grid of 2^28 steps across their extent (each keeps its number; the positions that come back are the moved
// ones), and there every decision is exact: no point of the result lies inside the circle through the corners of a
// face. Of points that fall on one place, one is in faces and the others are in none. Points on a line give no face.
// Throws Error(InvalidArgument) for a coordinate that is not finite. Based on: Boost.Polygon's Voronoi diagram
// (Fortune's sweep with exact predicates), whose dual this is.
Shape delaunay(std::span<const Vec2> points);

namespace shapes {

// The unit square, `per_side` equal steps along each side (4 * per_side boundary vertices, counter-clockwise from
// (0,0)), then `interior` evenly scattered vertices.
Shape delaunay_square(Index per_side, Index interior, std::uint64_t seed = 1);

// The square of Novotni and Klein's figures 6 and 7: 604 vertices, 80 of them on the boundary.
Shape paper_square();

// `points` uniformly random points in the unit disc, and their convex hull: triangles of every shape.
Shape delaunay_disc(Index points, std::uint64_t seed = 1);

}  // namespace shapes
}  // namespace brushfire
