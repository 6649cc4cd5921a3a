// Vertices that are near one another become one.
#include <brushfire/mesh/weld.h>

#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/point_grid.h>

#include <algorithm>
#include <utility>

namespace brushfire {

Welded weld(const Mesh& mesh, double tolerance) {
  if (!(tolerance >= 0) || tolerance == kInfinity) {
    throw Error(ErrorCode::InvalidArgument, "the tolerance of a weld is no number >= 0");
  }
  if (!mesh.has_positions()) throw Error(ErrorCode::InvalidArgument, "a mesh from lengths has no positions to weld");
  const auto positions = mesh.positions();
  Welded welded;
  welded.vertex_map.resize(mesh.vertex_count());
  std::vector<Vec3> kept;
  detail::PointGrid grid(positions, tolerance);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    Index joins = kNoIndex;
    grid.for_each_near(positions[v], [&](Index w, double) { joins = std::min(joins, w); });
    if (joins != kNoIndex) {
      welded.vertex_map[v] = welded.vertex_map[joins];
      continue;
    }
    welded.vertex_map[v] = static_cast<Index>(kept.size());
    kept.push_back(positions[v]);
    grid.add(v);
  }
  welded.joined = mesh.vertex_count() - static_cast<Index>(kept.size());
  std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  for (Face& f : faces) {
    for (Index& v : f) v = welded.vertex_map[v];
  }
  welded.mesh = Mesh(std::move(kept), std::move(faces));
  return welded;
}

}  // namespace brushfire
