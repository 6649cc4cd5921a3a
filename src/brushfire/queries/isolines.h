// Isolines: the curves of equal value of a field, as ordered polylines.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_path.h>

#include <span>
#include <vector>

namespace brushfire {

// One connected curve of one level. Smaller values lie on its left, seen from where the faces run counter-clockwise:
// the curve around a single source runs counter-clockwise.
struct Isoline {
  double level = 0;
  Index level_index = 0;  // its place in the caller's list
  SurfacePath line;       // closed, or from border to border
};

// The level sets of the field that is linear in every face and has these values at the vertices, [vertex_count]. Curves
// come in the order of `levels`, those of one level in the order of their lowest face.
//
// A vertex exactly at a level counts as above it, so a curve never branches or crosses itself; where that makes curves
// of no extent (around a peak or along a ridge exactly at the level) they are left out, and no two consecutive points
// of a curve are the same. Points nearer to a vertex than kWeightSnap of their edge are that vertex. Curves end at
// boundary edges, at edges of three and more faces (each face's piece is a curve's end there), and where a face has a
// value of +inf. Faces that name a vertex twice have no inside and no piece.
//
// Straight pieces between the edges: a circle is met to second order in the edge length. Throws Error(InvalidArgument)
// where there is not one value per vertex, for a value that is NaN or -inf, and for a level that is not finite. O(faces
// + vertices log(levels) + points).
std::vector<Isoline> isolines(const Mesh& mesh, std::span<const double> values, std::span<const double> levels);

// The same within walls: curves end at them, and none enters what is blocked. `values`: one per vertex of domain.open()
// (DistanceField::side_distance), or one per vertex, which then counts on both sides of a wall.
std::vector<Isoline> isolines(const Domain& domain, std::span<const double> values, std::span<const double> levels);

// The multiples of `step` in the range of the finite values, the smallest value left out: step, 2 step, ... for a
// distance field. Throws Error(InvalidArgument) where step is not a finite number > 0, Error(TooLarge) for more than a
// million levels.
std::vector<double> levels_every(std::span<const double> values, double step);

// `count` levels that divide the range of the finite values into count + 1 equal parts; none where all are equal.
std::vector<double> levels_between(std::span<const double> values, Index count);

}  // namespace brushfire
