// Reachability by disjoint sets of vertices.
#include <brushfire/mesh/reachable.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/disjoint_sets.h>

#include <string>

namespace brushfire {

std::vector<std::uint8_t> reachable(const Mesh& mesh, std::span<const SurfacePoint> points) {
  detail::DisjointSets sets(mesh.vertex_count());
  Poll poll;
  for (const Face& face : mesh.faces()) {
    poll();
    sets.unite(face[0], face[1]);
    sets.unite(face[1], face[2]);
  }
  std::vector<std::uint8_t> is_source(mesh.vertex_count()), out(mesh.vertex_count());
  for (const SurfacePoint& p : points) {
    if (p.is_nowhere()) continue;
    if (p.face >= mesh.face_count()) {
      throw Error(ErrorCode::IndexOutOfRange,
                  "there is no face " + std::to_string(p.face) + ", the mesh has " + std::to_string(mesh.face_count()));
    }
    is_source[sets.find(mesh.faces()[p.face][0])] = 1;
  }
  for (Index v = 0; v < out.size(); ++v) {
    poll();
    out[v] = is_source[sets.find(v)];
  }
  return out;
}

}  // namespace brushfire
