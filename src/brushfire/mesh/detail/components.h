// Connected components of a mesh, through faces and the vertices that they share.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <vector>

namespace brushfire::detail {

struct Components {
  Index count = 0;
  std::vector<Index> of_vertex;  // [vertex_count], numbered by their lowest vertices; kNoIndex: in no face
};

inline Components components_of(const Mesh& mesh) {
  std::vector<Index> parent(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) parent[v] = v;
  const auto root = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& t : mesh.faces()) {
    for (const Index v : {t[1], t[2]}) {
      const Index a = root(t[0]), b = root(v);
      parent[a < b ? b : a] = a < b ? a : b;
    }
  }
  Components result{0, std::vector<Index>(mesh.vertex_count(), kNoIndex)};
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index r = root(v);
    if (r == v && mesh.corners(v).empty()) continue;
    if (r == v) result.of_vertex[v] = result.count++;
    result.of_vertex[v] = result.of_vertex[r];
  }
  return result;
}

}  // namespace brushfire::detail
