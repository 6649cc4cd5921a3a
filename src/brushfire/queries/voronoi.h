// Geodesic Voronoi diagrams: which source is nearest where, the borders in between, and how large the cells are.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/shared_face.h>
#include <brushfire/mesh/surface_path.h>
#include <brushfire/solvers/distance.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// Where two cells meet: closed, or from one end (a point of three cells, the boundary, the edge of what is reached) to
// another.
struct VoronoiBorder {
  std::array<Index, 2> sources;  // places in the caller's list, the lower first
  SurfacePath line;
};

struct VoronoiDiagram {
  std::vector<double> distance;  // [vertex_count] from the nearest source; +inf: none reaches
  std::vector<Index> source;     // [vertex_count] its place in the caller's list, the lowest of equals; kNoIndex: none
  std::vector<double> area;      // [sources] of each cell, in units of the mesh squared; 0 for a dominated source
  std::vector<VoronoiBorder> borders;  // ascending by sources
  // The dual: three cells that meet in a face, the lowest source first, then the way round in which the face runs;
  // ascending, each once. Its edges are the pairs of `borders`. For sources that lie densely enough it triangulates the
  // surface (an intrinsic Delaunay triangulation of the sources).
  std::vector<Face> dual;
  std::vector<SharedFace> shared_faces;  // ascending by face; those that borders run through
};

// Labels are those of distance(); borders and areas are finer than faces: in a face whose corners have different
// sources the distance from each of them is taken as linear between its own values at the corners, so a border is met
// to second order in the edge length. A cell that lies between vertices only is not seen. Faces with an unreached
// corner belong to no cell; cells do not reach through walls. Costs one field, and for every source one more, limited
// to its cell's reach. `options` and errors are those of distance(); targets are ignored.
VoronoiDiagram voronoi(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options = {});

}  // namespace brushfire
