// Mesh: an immutable triangle complex, described for solvers by edge lengths, areas and which edges meet.
//
// Example:
//     const std::vector<brushfire::Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//     const std::vector<brushfire::Face> faces{{0, 1, 2}, {0, 2, 3}};
//     const brushfire::Mesh mesh(positions, faces);
//     for (const brushfire::Index h : mesh.corners(0)) {  // the halfedges that leave vertex 0
//       std::printf("to vertex %u: %g\n", mesh.to(h), mesh.length(h) * mesh.unit());
//     }
#pragma once

#include <brushfire/core/types.h>  // IWYU pragma: export

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace brushfire {

struct MeshReport;

// What the faces around a vertex form. Angles around a vertex ("saddle: more than 2 pi") mean something on a circle
// or an arc only; anywhere else every fan has to be visited on its own.
enum class Link : std::uint8_t {
  Empty,   // no face (faces with a repeated vertex do not count)
  Circle,  // one closed fan: an interior vertex
  Arc,     // one open fan: a boundary vertex
  Other,   // several fans (a bow-tie), or a fan with an edge of three and more faces
};

// The smallest box along the axes that holds some points; inside out (+inf, -inf) where there are none.
struct Box {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
};

// Any set of triangles over a set of vertices: closed or not, manifold or not, consistently oriented or not, with
// degenerate, duplicate and unreferenced parts. Nothing is repaired: distances are those of the given complex, and
// report() says what is in it.
//
// Immutable after construction; copies share their data; safe to read from many threads at once. What is derived
// (connectivity, lengths, links, the report) is built on first use, so that a solver pays for what it needs.
//
// Halfedges are arithmetic: face f has halfedges 3f, 3f+1, 3f+2; halfedge 3f+k runs from corner k to corner k+1 of its
// face and also names that corner. A face whose three indices are not distinct has no area and no inside; it keeps
// its number, and it conducts along its edges.
//
// Lengths and areas are in units of unit(), a power of two near the mean edge length, so that solvers see numbers near
// one whatever the scale of the coordinates; multiplying by unit() is exact.
class Mesh {
 public:
  // No vertices, no faces.
  Mesh();

  // Copies the arrays: positions[vertex_count], faces[face_count]. Throws Error(InvalidMesh) naming the first vertex
  // with a coordinate that is not finite, or beyond 2^990 (1e298), or the first face with an index >= vertex_count, and
  // Error(TooLarge) beyond 2^32/3 faces. O(vertices + faces).
  Mesh(std::span<const Vec3> positions, std::span<const Face> faces);

  // The same of arrays that the mesh takes over: nothing is copied. Where it throws, they are still the caller's.
  Mesh(std::vector<Vec3>&& positions, std::vector<Face>&& faces);

  // A mesh that has lengths and no coordinates: lengths[f][k] is the length of the edge from corner k to corner k+1 of
  // face f, finite and >= 0 (0 where the two corners are the same vertex). Throws Error(InvalidMesh) where faces
  // disagree on a shared edge by more than 1e-9 of it or break the triangle inequality by more than that. Areas come
  // from Kahan's formula; how many digits that costs on flat faces stands in report().length_precision.
  static Mesh from_lengths(Index vertex_count, std::span<const Face> faces,
                           std::span<const std::array<double, 3>> lengths);

  // The same mesh with the edge of each of these halfedges opened into a slit: its faces no longer meet over it, every
  // side is boundary; its two vertices stay whole. (cut.h opens walls, and parts the vertices in them.) Throws
  // Error(IndexOutOfRange).
  Mesh with_slits(std::span<const Index> halfedges) const;

  // The same mesh under other numbers: vertex i is vertex vertices[i] of this one, with vertex_rank the inverse, and
  // face f of this one gets number face_rank[f]; corners keep their order in their faces. The same unit(). All must be
  // permutations.
  Mesh renumbered(std::span<const Index> vertices, std::span<const Index> vertex_rank,
                  std::span<const Index> face_rank) const;

  Index vertex_count() const noexcept;
  Index face_count() const noexcept;
  Index halfedge_count() const noexcept { return 3 * face_count(); }

  // The same mesh with these faces only (ascending), numbered anew in their order: the same vertices, unit() and slits.
  Mesh with_faces(std::span<const Index> faces) const;

  // False for a mesh from lengths; positions() is empty then.
  bool has_positions() const noexcept;
  // Whether with_slits() has opened edges of it.
  bool has_slits() const noexcept;
  std::span<const Vec3> positions() const noexcept;  // [vertex_count]
  std::span<const Face> faces() const noexcept;      // [face_count]
  const Box& bounds() const noexcept;                // of the positions. O(1).

  static constexpr Index face_of(Index h) { return h / 3; }
  static constexpr Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static constexpr Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index from(Index h) const { return faces()[h / 3][h % 3]; }
  Index to(Index h) const { return from(next(h)); }

  // opposite[h], [halfedge_count]: links the halfedges over one edge (one pair of vertices) in a ring. A boundary
  // edge is its own opposite; two faces name each other; on a non-manifold edge following opposite visits all. Two
  // faces lie the same way round where their halfedges run in opposite directions; where from(h) == from(opposite[h])
  // the neighbour is mirrored. Halfedges of a face with a repeated vertex are not in any ring (their own opposite).
  std::span<const Index> opposite() const;
  // A single entry. If the array has not been built, the entry is found among the faces at the edge's ends, so that a
  // few look-ups do not cost the whole array. O(faces at a vertex).
  Index opposite(Index h) const;
  // The halfedge of the other face of an edge of two faces; h itself at any other edge.
  Index neighbour(Index h) const;

  // The corners (outgoing halfedges) at vertex v, ascending. Corners of faces with a repeated vertex are included.
  std::span<const Index> corners(Index v) const;
  // The same for all vertices: those of v are numbers offsets[v] to offsets[v + 1] of all_corners().
  std::span<const Index> corner_offsets() const;  // [vertex_count + 1]
  std::span<const Index> all_corners() const;     // [halfedge_count]

  // The first corner at v that is in a face with three distinct vertices; the first one of all where there is none;
  // kNoIndex at a vertex in no face. The first call searches the faces where corner lists have not been built: often it
  // is the only one.
  Index first_corner(Index v) const;

  // What the faces around each vertex form, [vertex_count].
  std::span<const Link> links() const;

  // A power of two within a factor 2 of the mean edge length (in 2^-1000 .. 2^1000); 1 where all edges have length 0.
  // The mean is taken over a few thousand faces, evenly spread over the list, where these are typical of the whole.
  double unit() const;
  // Edge length of every halfedge, [halfedge_count], and twice the area of every face, [face_count], in unit() and
  // unit()^2. Both sides of an edge have the same bits.
  std::span<const double> lengths() const;
  std::span<const double> double_areas() const;
  // A single one, with the same bits; computed where the arrays have not been built.
  double length(Index h) const;
  double double_area(Index f) const;

  // The same for one face, whether or not those arrays have been built: for one look at every face, which is not worth
  // 64 bytes per vertex for good.
  struct FaceGeometry {
    std::array<double, 3> lengths;  // of the face's halfedges
    double double_area;
  };
  FaceGeometry face_geometry(Index f) const;

  // The angle at the corner that halfedge h starts from, in [0, pi]; pi/3 in a face whose vertices all coincide.
  double corner_angle(Index h) const;

  // What is in the mesh (see report.h). O(vertices + faces), once.
  const MeshReport& report() const;

  bool is_face_usable(Index f) const {  // three distinct vertices
    const Face& t = faces()[f];
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  }

 private:
  struct Arrays;
  struct Data;
  explicit Mesh(std::shared_ptr<const Data> data);
  std::shared_ptr<const Data> data_;
};

}  // namespace brushfire
