// Domain: where one may go, which is a mesh, or what walls leave of it.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/cut.h>
#include <brushfire/mesh/mesh.h>           // IWYU pragma: export
#include <brushfire/mesh/surface_point.h>  // IWYU pragma: export

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace brushfire {

// The faces that a mask closes: those of which not all three vertices are open (open_vertices[v] != 0), ascending, for
// Barriers::faces. Throws Error(InvalidArgument) where there is not one value per vertex.
std::vector<Index> closed_faces(const Mesh& mesh, std::span<const std::uint8_t> open_vertices);

// A mesh and the walls in it. Everything that takes a Domain speaks of vertices, faces and points of the whole mesh, in
// its numbers; nothing goes through a wall, and what lies behind one (a blocked face, a vertex that is in blocked faces
// only) is nowhere: it reads +inf. Solvers run on the mesh with the walls cut out (see cut.h): a point of a wall is one
// point on each side of it, a source there feeds all of them, and the distance there is the least of them.
//
// A Mesh is a Domain without walls. Immutable; copies share their data; safe from many threads.
class Domain {
 public:
  Domain(Mesh mesh) : mesh_(std::move(mesh)) {}  // NOLINT(google-explicit-constructor): what takes it takes a Mesh
  // Throws as cut() does. O(vertices + faces).
  Domain(Mesh mesh, const Barriers& barriers);

  const Mesh& mesh() const { return mesh_; }  // the whole
  // What is left of it: faces and copies of vertices have numbers of their own (cut()). The mesh itself without walls.
  const Mesh& open() const { return cut_ ? cut_->mesh : mesh_; }
  bool has_walls() const { return cut_ != nullptr; }
  const CutMesh* cut() const { return cut_.get(); }  // null: no walls

  // A point of the mesh as points of open(): one on each side of a wall, none behind one or for a point that is
  // nowhere. Throws as locate() does.
  std::vector<SurfacePoint> on_open(const SurfacePoint& point) const;

  // The way back from open().
  Index vertex(Index open_vertex) const { return cut_ ? cut_->original_vertex[open_vertex] : open_vertex; }
  Index face(Index open_face) const { return cut_ ? cut_->original_face[open_face] : open_face; }
  void to_mesh(std::span<SurfacePoint> points) const;

  // Whether the vertex is in a face that is not blocked.
  bool is_open(Index vertex) const { return !open().corners(vertex).empty(); }

  // Values per vertex of the mesh on those of open(): every copy gets that of its original. Values that already are
  // per vertex of open() are left as they are. Throws Error(InvalidArgument) for any other number of values.
  std::vector<double> spread(std::span<const double> values) const;

 private:
  Mesh mesh_;
  std::shared_ptr<const CutMesh> cut_;
};

// What walls leave of a mesh.
struct OpenPart {
  Index closed_faces = 0;
  Index closed_vertices = 0;  // in closed faces only
  Index components = 0;       // of what is open
  double area = 0;            // of what is open, in units of the mesh squared
  double largest_area = 0;    // of its largest component
  Index islanders = 0;        // open vertices outside of that: nothing leads there from it
};
OpenPart open_part(const Domain& domain);

}  // namespace brushfire
