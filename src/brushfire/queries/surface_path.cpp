// The length of a polyline on a mesh.
#include <brushfire/queries/surface_path.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/flat_face.h>

#include <string>

namespace brushfire {

double length_of(const Mesh& mesh, std::span<const SurfacePoint> points, bool closed) {
  std::vector<PointLocation> at;
  at.reserve(points.size());
  for (const SurfacePoint& p : points) at.push_back(locate(mesh, p, 0));
  double length = 0;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < at.size(); ++i) {
    const std::size_t j = (i + 1) % at.size();
    const Index f = common_face(mesh, at[i], at[j], at[i].face);
    if (f == kNoIndex) {
      throw Error(ErrorCode::InvalidArgument,
                  "points " + std::to_string(i) + " and " + std::to_string(j) + " of a path share no face");
    }
    length += distance_within(mesh, f, at[i], at[j]);
  }
  return length * mesh.unit();
}

}  // namespace brushfire
