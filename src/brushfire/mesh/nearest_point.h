// From a position in space to the nearest point of the surface.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <memory>
#include <span>
#include <vector>

namespace brushfire {

struct NearestPoint {
  SurfacePoint point;
  double distance = 0;  // from the position to the point, in the mesh's units
};

// Built once per mesh in O(faces log faces); immutable, copies share, safe to use from many threads at once.
//
// The distance is that to the nearest of all faces, exact to rounding, degenerate faces included (a face without area
// is its edges). Of faces equally near the lowest is named. A position at a vertex gives the vertex, one on an edge the
// edge: weights that the rounding of the coordinates cannot tell from zero are zero.
class NearestPointFinder {
 public:
  // Throws Error(InvalidArgument) for a mesh without positions or without faces.
  explicit NearestPointFinder(const Mesh& mesh);

  // Throws Error(InvalidArgument) for a coordinate that is not finite, or a position more than 1e60 times as far out
  // as the mesh. O(log faces) near the surface.
  NearestPoint operator()(Vec3 position) const;

  // The same for many positions, in their order; an error names the first bad one.
  std::vector<NearestPoint> operator()(std::span<const Vec3> positions) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace brushfire
