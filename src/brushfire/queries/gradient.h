// Gradients of a field that is linear in every face, and the way down from a point.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// Per face the direction and rate of steepest ascent, in the plane of the face: [face_count], change of value per unit
// of length of the mesh. About 1 long for a distance field, pointing away from the source. Zero for faces without area
// and faces with a value of +inf. Throws Error(InvalidArgument) for a mesh without positions, and as
// steepest_descent(). O(faces).
std::vector<Vec3> face_gradients(const Mesh& mesh, std::span<const double> values);

// The same at the vertices: the mean of the gradients of the faces around, weighted by their area; faces with a value
// of +inf do not count. Zero where no face around has a gradient. [vertex_count]. Throws as face_gradients().
std::vector<Vec3> vertex_gradients(const Mesh& mesh, std::span<const double> values);

// A direction at a surface point, into one face.
struct SurfaceDirection {
  Index face = kNoIndex;  // kNoIndex: there is none
  // The change of the point's weights in that face per unit of length of the mesh, summing to zero: the point
  // {face, weights + s * weight_rates} lies s farther on.
  std::array<double, 3> weight_rates{0, 0, 0};
  double slope = 0;  // change of value per unit of length
};

// The direction in which the field falls fastest from the point: of all directions in all faces around it, those along
// edges included; the lowest face of equals. None where the field falls nowhere (a source), and where no face around
// has finite values. At an interior point of a distance field: towards the source.
// Throws Error(InvalidArgument) where there is not one value per vertex, for a value there that is NaN or -inf, and as
// locate() does. O(faces at the point) after a check of the values' number.
SurfaceDirection steepest_descent(const Mesh& mesh, std::span<const double> values, const SurfacePoint& point);

// The same within walls: [face_count] and [vertex_count] of the whole mesh; at a wall, on the side where the value is
// least, and zero for faces and vertices behind one. `values` as for isolines().
std::vector<Vec3> face_gradients(const Domain& domain, std::span<const double> values);
std::vector<Vec3> vertex_gradients(const Domain& domain, std::span<const double> values);

// And the way down within walls: at a point of a wall, on the side where the value is least. `values` as for
// isolines().
SurfaceDirection steepest_descent(const Domain& domain, std::span<const double> values, const SurfacePoint& point);

// The direction as a unit vector in space. The mesh must have positions.
Vec3 in_space(const Mesh& mesh, const SurfaceDirection& direction);

}  // namespace brushfire
