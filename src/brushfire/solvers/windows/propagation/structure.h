// What a run needs to know of the mesh: face records, at which vertices paths may bend, and the parts of the mesh.
#pragma once

#include <brushfire/mesh/detail/locality_order.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/partition/face_partition.h>
#include <brushfire/solvers/windows/propagation/face.h>
#include <brushfire/solvers/windows/propagation/rounding.h>
#include <brushfire/solvers/windows/propagation/wheels.h>

#include <span>
#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

// How a vertex that is reached sends light on. A shortest path bends at a vertex only where it leaves at an angle of pi
// or more on either side, so a Saddle lights what lies between. Full lights everything: that is more than needed, but
// every ray that leaves a vertex is a real path, so it is always right; it is used where angles mean nothing or are
// not known well enough.
// Fans: what Saddle is to one fan, for several of them and for books.
enum class VertexType : std::uint8_t { None, Saddle, Boundary, Fans, Full };

// Vertices and faces are renumbered so that neighbours are near each other in memory; corners keep their places in
// their faces. "Inner" numbers are used everywhere in a run, the mesh's own only to and from the caller.
//
// The faces are cut into parts on which threads work side by side; a vertex has an inner number in each of the parts
// that its faces belong to: see FacePartition.
struct WindowStructure {
  // 2^part_bits faces are a part.
  explicit WindowStructure(const Mesh& mesh, unsigned part_bits);

  // A vertex counts once in each of its parts.
  Index vertex_count() const { return static_cast<Index>(vertex_type.size()); }
  Index inner_vertex(Index v) const { return order.vertex_rank[v]; }  // in the first of its parts
  Index outer_vertex(Index v) const { return order.vertices[v]; }
  Index inner_face(Index f) const;  // O(log faces): sources and targets ask, the run itself hardly ever
  Index outer_face(Index f) const { return order.faces[f]; }
  Index inner_halfedge(Index h) const { return 3 * inner_face(h / 3) + h % 3; }
  Index outer_halfedge(Index h) const { return 3 * order.faces[h / 3] + h % 3; }

  Index part_count() const { return partition.count(); }
  Index part_of_face(Index f) const { return partition.part_of_face(f); }
  Index part_of_vertex(Index v) const { return partition.part_of_vertex(v); }  // O(log parts)
  std::span<WindowFace> faces_of(Index part);

  // A vertex at which so many faces meet that looking up each of them would take too long, by its outer number, with
  // its corners.
  struct Crowd {
    Index vertex;
    std::vector<Index> corners;
    std::vector<Index> ghosts;  // [parts] where it has several; kNoIndex: none there
  };
  // Whether these are one vertex.
  bool is_same(Index v, Index w) const {
    return v == w || (partition.has_ghosts() && outer_vertex(v) == outer_vertex(w));
  }
  // The corners at v by inner halfedges, ascending; of all faces, or of those in one part. What is returned lasts until
  // `room` is used again.
  std::span<const Index> corners_of(Index v, std::vector<Index>& room) const;
  std::span<const Index> corners_of(Index v, Index part, std::vector<Index>& room) const;
  // Whether three faces or more meet at the edge of halfedge h.
  bool is_spine(Index h) const {
    const Index g = faces[h / 3].opposite[h % 3];
    return faces[g / 3].opposite[g % 3] != h;
  }
  // v's number in a part; kNoIndex: it has none there.
  Index ghost_in(Index part, Index v) const;

  Mesh mesh;                            // the caller's
  LocalityOrder order;                  // vertices: [vertex_count()] inner to outer
  std::vector<WindowFace> faces;        // [face_count]
  std::vector<VertexType> vertex_type;  // [vertex_count()]
  partition::FacePartition partition;
  std::vector<Crowd> crowds;   // ascending
  Wheels wheels;               // of the largest of them
  bool has_spines = false;     // some edge has three faces or more
  bool has_needles = false;    // as a rule, or around some vertex: light passes many vertices in one bucket
  double bucket_width = 1;     // half a typical edge, or less where faces are needles
  Unevenness unevenness;       // of the faces' edges
  double typical_deficit = 0;  // the median of |2 pi - angles around a vertex|, of inner vertices

 private:
  const Crowd* crowd_at(Index v) const;
  void cut_into_parts();
  void renumber(const std::vector<Index>& places);
  void find_ghosts_of_crowds();
};

// The angle at corner i.
double angle_at(const WindowFace& f, Index i);

// A corner whose edges differ by more than this factor: rounding of the lengths turns directions there by up to
// kUnevenEdges epsilons, too much to tell what is in a shadow.
inline constexpr double kUnevenEdges = 1e3 / kFiner;
// A face whose altitude is less than this share of its longest edge: what it is made of is rounding of the lengths, and
// so are its angles.
inline constexpr double kNoArea = 1e-13 * kFiner;
// Angle sums beyond 2 pi (pi on a boundary) by less than this are rounding; a shadow so narrow hides nothing for longer
// than that share of the distance.
inline constexpr double kFlat = 1e-13 * kFiner;

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
