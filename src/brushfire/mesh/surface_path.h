// SurfacePath: a polyline on a mesh.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>  // IWYU pragma: export

#include <span>
#include <vector>

namespace brushfire {

// Consecutive points share a face and are joined straight within it; so are the last and the first where it is closed.
struct SurfacePath {
  std::vector<SurfacePoint> points;  // empty: there is no path
  double length = kInfinity;         // in the mesh's units; +inf: there is no path
  bool closed = false;
};

// The length of a polyline on the mesh, in the mesh's units; 0 for a single point. Throws Error(InvalidArgument) that
// names the first pair of consecutive points that share no face, and what locate() throws.
double length_of(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed = false);

// The lengths of its straight pieces, one fewer than points (as many where it is closed), which sum to that.
std::vector<double> leg_lengths(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed = false);

}  // namespace brushfire
