// Welding: vertices that are near one another become one, so that faces that only touch are connected.
#pragma once

#include <brushfire/mesh/mesh.h>  // IWYU pragma: export

#include <vector>

namespace brushfire {

struct Welded {
  Mesh mesh;
  // vertex_map[v], [vertex_count of the given mesh]: which vertex of `mesh` vertex v became.
  std::vector<Index> vertex_map;
  Index joined = 0;  // how many vertices fewer there are
};

// Goes through the vertices in order: one that lies within `tolerance` (>= 0, in units of the mesh; 0 joins equal
// positions) of a vertex that was kept joins the first such one, any other is kept. So positions never move by more
// than the tolerance, and chains of near vertices do not run together. The vertices of `mesh` are the kept ones in
// order; its faces keep their numbers, also where two corners have become one vertex. Throws Error(InvalidArgument) for
// a mesh without positions or a tolerance that is no number >= 0. O(vertices) expected.
Welded weld(const Mesh& mesh, double tolerance);

}  // namespace brushfire
