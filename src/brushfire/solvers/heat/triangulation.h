// Intrinsic triangulations: triangles that are known by the lengths of their edges and by how they are glued.
//
// Based on: Bobenko, Springborn, "A discrete Laplace-Beltrami operator for simplicial surfaces", 2007 (edge flips on
// lengths); Sharp, Crane, "A Laplacian for nonmanifold triangle meshes", 2020 (the tufted cover).
#pragma once

#include <brushfire/mesh/mesh.h>

#include <array>
#include <cstddef>
#include <vector>

namespace brushfire::heat {

// Triangles with three halfedges each, numbered as those of a Mesh; a triangle may touch a vertex, or itself, twice.
struct Triangulation {
  Index vertex_count = 0;
  // How many triangles lie over one point of the surface: 2 in the tufted cover, whose sums count everything twice.
  int sheets = 1;
  std::vector<Index> tail;      // [halfedges] the vertex that it starts from
  std::vector<Index> twin;      // [halfedges] the other one of its edge, in opposite direction; kNoIndex: border
  std::vector<double> length;   // [halfedges] in mesh.unit(); twins have the same bits
  std::vector<double> bearing;  // [halfedges] or empty: its direction at its tail (tangent_frames.h); kept by flips

  std::size_t face_count() const { return tail.size() / 3; }
};

enum class Cover : std::uint8_t {
  Single,  // every face once. For oriented meshes whose edges have one or two faces
  AsItIs,  // Single where no edge is on a border, has three faces or mirrors one; else Tufted
  Tufted,  // every face twice, front and back, glued around every edge like the pages of an open book
};

// Throws Error(InvalidArgument) for Cover::Single and a mesh that it is not for.
Triangulation triangulation_of(const Mesh& mesh, Cover cover);
// Whether Cover::Single is for it.
bool is_oriented_manifold(const Mesh& mesh);

// Flips edges until the cotangents opposite of each sum to -kFlipTolerance or more: the Laplacian has no negative
// weight then. Returns the number of flips. O(edges + flips); polls for cancelling.
std::size_t flip_to_delaunay(Triangulation& t);
// Far above what the cotangents of four vertices on a circle round to, so that they are not flipped for ever; and the
// value that geometry-central takes, for the same triangulation.
inline constexpr double kFlipTolerance = 1e-6;

// A triangle laid flat: corner 0 at the origin, corner 1 at (length, 0), corner 2 above.
struct FlatTriangle {
  double length = 0;
  Vec2 apex;
  double double_area() const { return length * apex.y; }
};
FlatTriangle lay_flat(const Triangulation& t, std::size_t face);

// Of the edge of halfedge h, its own triangle's share: the cotangent of the angle opposite, halved.
double half_cotangent(const Triangulation& t, Index h);
// The same where twice the area of the triangle is known.
double half_cotangent(const Triangulation& t, Index h, double double_area);

// The mean over all edges.
double mean_edge_length(const Triangulation& t);

}  // namespace brushfire::heat
