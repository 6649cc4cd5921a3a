// Straightest geodesics: walking straight on from a point, and the logarithmic map that undoes it.
#pragma once

#include <brushfire/mesh/surface_path.h>
#include <brushfire/solvers/distance.h>

#include <vector>

namespace brushfire {

// Directions at a point are angles in radians.
// - Inside a face and on an edge: counter-clockwise (as the point's face runs) from the direction of its edge from
//   corner 0 to corner 1; the faces around an edge are laid flat, so the full turn is 2 pi.
// - At a vertex: from the edge along its first corner (mesh.corners(v).front(); on a boundary: one of the two boundary
//   edges), the way that corner's face opens, adding up the angles of the faces: the full turn is total_angle().
//   Faces with a repeated vertex do not count.
double total_angle(const Mesh& mesh, const SurfacePoint& point);

// The angle of a direction in space, projected onto the surface: onto the face, or at a vertex onto the face that it
// points into most. The mesh needs positions. Throws Error(InvalidArgument) for a direction of length 0, and for one
// that is at right angles to the surface.
double angle_of(const Mesh& mesh, const SurfacePoint& point, const Vec3& direction);

// Whether the angles at a point grow counter-clockwise, as the faces there run: they do, except at some boundary
// vertices and where faces are oriented the other way round.
bool is_counter_clockwise(const Mesh& mesh, const SurfacePoint& point);

enum class TraceEnd : std::uint8_t {
  Length,       // the whole length was walked
  Boundary,     // the surface ended
  NonManifold,  // an edge of three and more faces, or a vertex without a circle of faces: "straight on" has no meaning
};

struct Trace {
  SurfacePath path;
  TraceEnd end = TraceEnd::Length;
};

// The straightest geodesic from a point in a direction for a length (mesh's units): straight across faces laid flat;
// over an interior vertex with the same angle on either side. Angles outside [0, total_angle) wrap around at interior
// points; outside the surface at a boundary vertex the trace ends at once. Throws Error(InvalidArgument) for an angle
// that is not finite, a length that is not finite and >= 0, or a vertex without a circle or arc of faces; what locate()
// throws. O(edges crossed).
//
// Based on: Polthier, Schmies, "Straightest geodesics on polyhedral surfaces", 1998.
Trace straightest(const Mesh& mesh, const SurfacePoint& from, double angle, double length);
// The same within walls, which are boundary. Throws Error(InvalidArgument) for a point behind a wall, and for one on a
// wall that parts the surface there: directions at it have no common angles.
Trace straightest(const Domain& domain, const SurfacePoint& from, double angle, double length);

// Polar coordinates of every vertex around a source.
struct LogMap {
  std::vector<double> radius;  // [vertex_count] exact distance; +inf: unreachable or beyond max_radius
  std::vector<double> angle;   // [vertex_count] the direction in which the shortest path leaves the source, as above;
                               // NaN where there is no path, 0 at the source itself
  double total_angle = 0;      // the full turn at the source
};

// Inside the injectivity radius of a point, straightest(source, angle[v], radius[v]) ends at v; behind a saddle or a
// boundary, angles are those of the vertex that the path bends at. Throws as distance() and straightest() do.
// The cost of the exact field, and O(edges crossed) for every vertex.
//
// In a domain with walls the source must not lie on one that parts the surface there: Error(InvalidArgument). A vertex
// on a wall has the polar coordinates of its nearer side.
LogMap log_map(const Domain& domain, const SurfacePoint& source, double max_radius = kInfinity,
               const CancelToken* cancel = nullptr);

// The same of the reached vertices only, which ascend: after the solver's first call a small disc costs little however
// large the mesh is.
struct SparseLogMap {
  std::vector<Index> vertex;   // [reached]
  std::vector<double> radius;  // [reached]
  std::vector<double> angle;   // [reached]
  double total_angle = 0;
};
SparseLogMap log_map(DistanceSolver& solver, const SurfacePoint& source, double max_radius,
                     const CancelToken* cancel = nullptr);
// Of `how` the max_distance, threads, progress and cancel count.
SparseLogMap log_map(DistanceSolver& solver, const SurfacePoint& source, const DistanceOptions& how);

}  // namespace brushfire
