// Where fronts start and where they are read: straight lines inside one face and across one edge.
#pragma once

#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <span>
#include <vector>

namespace brushfire::detail {

struct Seed {
  Index vertex = kNoIndex;
  double distance = 0;  // in mesh.unit()
  // Of vertices that are seen across edges: the corner, as a halfedge, through which the point is seen from there, and
  // the angle from that halfedge to the point.
  Index corner = kNoIndex;
  double turn = 0;
};

// What a point sees of an edge: the point lies at `start`, on or below the edge, in the frame of the edge from its
// vertex `first` on; `left` and `right` are directions from the point that bound what it sees.
struct Sight {
  Index edge = kNoIndex, first = kNoIndex;
  Vec2 start, left, right;
  int crossed = 0;
};

// Looks around points, one after the other, in memory that it keeps: what it returns lasts until the next call.
class SeedSearch {
 public:
  // The corners of all faces that hold the point, with their straight distances (a vertex: itself; a point of an edge:
  // the corners of every face of that edge). Digits are kept however near to an edge or a corner the point is.
  std::span<const Seed> in_own_faces(const Mesh& mesh, const PointLocation& at);

  // In addition the vertices that the point sees in a straight line across up to `crossings` edges, nearest faces
  // first, kMaxSights faces at most, not farther than `limit` (in mesh.unit()). A front that starts near an edge, or
  // inside the faces that an obtuse corner is unfolded through, needs them: there the distances of two vertices do not
  // tell where it started.
  std::span<const Seed> in_sight(const Mesh& mesh, const PointLocation& at, int crossings, double limit);

 private:
  std::vector<Seed> seeds_;
  std::vector<Sight> sights_;
};

inline constexpr std::size_t kMaxSights = 1024;

// The edges opposite of a point inside a face (all three) or on an edge (the two others of every face there), without
// those of length 0: visit(halfedge, the point in the frame of that halfedge).
template <class Visit>
void for_edges_around(const Mesh& mesh, const PointLocation& at, const Visit& visit) {
  const auto add = [&](Index h, const std::array<double, 3>& weights) {
    if (mesh.length(h) > 0) visit(h, point_over(mesh, h, weights));
  };
  if (at.on == PointLocation::On::Interior) {
    for (Index h = 3 * at.face; h < 3 * at.face + 3; ++h) add(h, at.weights);
    return;
  }
  Index g = at.halfedge;
  do {
    const std::array<double, 3> weights = on_other_halfedge(mesh, at, g).weights;
    add(Mesh::next(g), weights);
    add(Mesh::previous(g), weights);
    g = mesh.opposite(g);
  } while (g != at.halfedge);
}

// The straight distance of two points that share a face, or of a point inside a face and one that it sees across one
// edge, in mesh.unit(); +inf for all others.
double straight_distance(const Mesh& mesh, const PointLocation& a, const PointLocation& b);

}  // namespace brushfire::detail
