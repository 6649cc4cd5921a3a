// Barriers: where fronts and paths may not go. They are cut out of the mesh once, so that solvers see only boundary.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

struct Barriers {
  std::vector<Index> vertices{};              // nothing passes: all their faces are blocked
  std::vector<Index> faces{};                 // nothing enters
  std::vector<std::array<Index, 2>> edges{};  // by their two vertices: both sides can be reached, nothing crosses
};

// A mesh with its barriers cut out, and the way back. Where a barrier parts the faces around a vertex into several
// sectors, every sector gets a copy of the vertex of its own, so a closed wall is tight, also where it is closed at
// vertices only; where it merely ends, the vertex stays whole. Fans that met in one vertex before still do.
struct CutMesh {
  Mesh mesh;
  // [mesh.vertex_count()] the original of each vertex. The first copy keeps its number, so vertex v of the original is
  // vertex v here; further copies follow behind. A vertex whose faces are all blocked stays, in no face.
  std::vector<Index> original_vertex;
  std::vector<Index> original_face;  // [mesh.face_count()] ascending
  std::vector<Index> cut_face;       // [original faces] its number here; kNoIndex: blocked

  // Values per vertex here to values per original vertex: the least of the copies'.
  std::vector<double> to_original(std::span<const double> values) const;

  // The same for a distance and the source that belongs to it: the copy with the least distance, then the lowest
  // source.
  void to_original(std::span<const double> distance, std::span<const Index> source,
                   std::vector<double>& original_distance, std::vector<Index>& original_source) const;

  // A point here as a point of the original mesh.
  SurfacePoint to_original(const SurfacePoint& point) const;

  // A point of the original mesh as points here: one inside a face; one per side on a slit (a source there feeds both);
  // none in a blocked face. Throws as locate() does.
  std::vector<SurfacePoint> from_original(const Mesh& original, const SurfacePoint& point) const;
};

// Cuts the barriers out of the mesh. Throws Error(IndexOutOfRange) for a vertex or face that does not exist and
// Error(InvalidArgument) for two vertices that no edge joins. O(vertices + faces + barriers).
CutMesh cut(const Mesh& mesh, const Barriers& barriers);

}  // namespace brushfire
