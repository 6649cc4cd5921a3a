// How the length of one shortest path changes when vertices move: first and second derivatives, exact.
//
// Example:
//     const brushfire::Mesh mesh = brushfire::read_mesh("scan.ply").mesh;
//     const std::vector<brushfire::Source> sources{{brushfire::vertex_point(mesh, 0)}};
//     brushfire::DistanceOptions options;
//     options.method = brushfire::Method::Exact;
//     options.keep_paths = true;
//     const brushfire::DistanceField field = brushfire::distance(mesh, sources, options);
//     const brushfire::PathLength length = brushfire::path_length(mesh, field, 2);
//     const std::vector<double> hessian = length.hessian();
//     std::printf("%zu vertices count, the first bends at %g\n", length.vertices().size(), hessian[0]);
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/distance.h>

#include <array>
#include <span>
#include <vector>

namespace brushfire {

// The length of a path that is straight in the faces it goes through, laid flat, as a function of the positions of the
// vertices. The path stays the shortest one while they move, so the places where it crosses edges move, too: they are
// what a Schur complement of the length's second derivatives eliminates. Here that has a closed form: a straight leg
// that is moved stays straight, so that by how much it turns differs from one face to the next by the turn of the
// edge between them only.
//
// Vertices that the path bends at stay on it, and its ends keep their weights in their faces. Immutable; safe from many
// threads.
class PathLength {
 public:
  // `points`: of the path, as path_to() and path_between() give them: straight pieces within faces, which meet on edges
  // and at vertices. Throws Error(InvalidArgument) for a mesh without positions, points that share no face or lie
  // within one (other than the ends), and a piece of no length, whose direction is not known; and as locate() does.
  // O(points).
  PathLength(const Mesh& mesh, std::span<const SurfacePoint> points);

  double length() const { return length_; }  // in the mesh's units
  // The vertices that the length depends on, ascending: ends, corners, and the ends of all edges crossed. [k]
  std::span<const Index> vertices() const { return vertices_; }
  // The change per unit of length that each of them moves. [k]
  std::span<const Vec3> gradient() const { return gradient_; }

  // How the gradient changes while the vertices move by `moves`, [k]: the second derivatives times those. [k]. Throws
  // Error(InvalidArgument) for another number of moves. O(points).
  std::vector<Vec3> hessian_times(std::span<const Vec3> moves) const;
  // The matrix of all second derivatives, row by row, x, y and z of a vertex together: [3 k * 3 k], symmetric.
  // O(points^2).
  std::vector<double> hessian() const;

  // Whether the path goes straight on through a vertex: it will pass it on the one side or on the other, depending on
  // where that moves. First derivatives do not see it, second ones are those of a path that is kept at the vertex. Also
  // where the faces at the vertex form neither a circle nor an arc, so that what is straight is not known.
  bool is_one_sided() const { return one_sided_; }

  // The same with vertices of other numbers, several of which may become one: number[i] for vertex i.
  PathLength renumbered(std::span<const Index> number) const;

 private:
  // The part of the path within one face: from one point to the next is share[0] * x[0] + .. of the face's corners x.
  struct Piece {
    std::array<Index, 3> corner{};  // position in vertices_; one without a share stands for another
    std::array<double, 3> share{};  // which sum to 0
    Vec3 direction;                 // of length 1
    Vec3 aside;                     // at a right angle to it in the face; along a leg all point to the same side
    double length = 0;
  };
  // Where it begins: at an edge, from vertex `from` to `to`; or where a leg begins.
  struct Crossing {
    Index from = kNoIndex, to = kNoIndex;  // positions in vertices_; kNoIndex: a leg begins here
    double width = 0;                      // of the edge as the path sees it: at a right angle; < 0: seen from behind
    Vec3 fold;                             // by how much the direction before differs from that after
  };

  static Vec3 moved(const Piece& piece, std::span<const Vec3> x);
  void add_piece(const Mesh& mesh, const PointLocation& a, const PointLocation& b, Index preferred);
  void cross_edge(const Mesh& mesh, const PointLocation& at);
  void number_vertices();
  void add_up();
  void move_leg(std::size_t first, std::size_t last, std::span<const Vec3> moves, std::span<Vec3> change) const;

  std::vector<Piece> pieces_;
  std::vector<Crossing> crossings_;  // [pieces_]
  std::vector<Index> vertices_;
  std::vector<Vec3> gradient_;
  double length_ = 0;
  bool one_sided_ = false;
};

// Of the shortest path to a vertex of the domain, in the numbers of its mesh. `field`: of a run in this domain with
// Method::Exact and keep_paths (or Windows with tolerance 0). No source counts as one that moves: it keeps its weights
// in its face, and its offset is no part of the length. On the cut locus the path is one of several
// (one_sided_vertices() tells). Throws Error(InvalidArgument) for a vertex that no source reaches, a field without
// paths or of another mesh, and as the constructor does. O(edges crossed).
PathLength path_length(const Domain& domain, const DistanceField& field, Index target);

}  // namespace brushfire
