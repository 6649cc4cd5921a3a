// MeshReport: what is in a mesh, in numbers, and remarks on what a user should know about it.
#pragma once

#include <brushfire/core/types.h>

#include <string>
#include <vector>

namespace brushfire {

struct MeshReport {
  Index vertices = 0;
  Index faces = 0;
  Index edges = 0;                 // distinct pairs of vertices joined by a face
  Index components = 0;            // sets of faces connected through vertices
  Index boundary_edges = 0;        // one face
  Index nonmanifold_edges = 0;     // three and more faces
  Index misoriented_edges = 0;     // two faces that run the same way along the edge
  Index nonmanifold_vertices = 0;  // the link is neither a circle nor an arc
  Index isolated_vertices = 0;     // in no face: unreachable, they read +inf
  Index repeated_index_faces = 0;  // two corners are the same vertex
  Index zero_area_faces = 0;       // three distinct vertices on a line (exactly, in doubles)
  Index zero_length_edges = 0;     // two distinct vertices at the same place
  Index duplicate_faces = 0;       // the same three vertices as an earlier face
  Index duplicate_positions = 0;   // vertices at exactly the place of an earlier one
  // Boundary vertices that all but touch another one which no edge joins them to: nearer than a thousandth of the edges
  // at either. weld() with near_tolerance, the largest of these distances, joins them. 0 where it looks like soup.
  Index near_positions = 0;
  double near_tolerance = 0;
  bool looks_like_soup = false;  // unwelded: most edges are boundary and most positions repeat
  double min_edge_length = 0, mean_edge_length = 0, max_edge_length = 0;  // units of the input
  double area = 0;                                                        // units of the input, squared
  long long euler_characteristic = 0;                                     // referenced vertices - edges + faces
  // Relative precision to be expected of distances: 1e-12 with coordinates; from lengths 64 machine epsilons over the
  // smallest relative altitude.
  double length_precision = 0;

  // One sentence each on whatever is unusual, most important first; empty for a clean closed mesh.
  std::vector<std::string> remarks() const;
};

}  // namespace brushfire
