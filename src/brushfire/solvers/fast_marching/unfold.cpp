// Unrolls the faces behind an obtuse corner into the corner's plane.
#include <brushfire/solvers/fast_marching/unfold.h>

#include <brushfire/core/planar.h>
#include <brushfire/solvers/detail/start.h>

#include <algorithm>

namespace brushfire::detail {
Unfolding unfold_obtuse_corner(const Mesh& mesh, Index h, std::vector<UnfoldedTriangle>& triangles) {
  const Index corner = mesh.from(h);
  const double length = mesh.length(h);
  Unfolding result;
  if (length == 0) return result;
  // Left and right bound what is left of the angle; left_end and right_end are the edge that is crossed next.
  Index left = mesh.to(h), right = mesh.from(Mesh::previous(h));
  Vec2 at_left{length, 0}, at_right = apex_over(mesh, h, h);
  Vec2 left_end = at_left, right_end = at_right;
  Index left_vertex = left;  // the vertex at left_end
  Index edge = Mesh::next(h);
  while (result.crossed < kMaxUnfolded) {
    const Index g = mesh.neighbour(edge);
    const double crossed = mesh.length(edge);
    if (g == edge || crossed == 0) return result;
    ++result.crossed;
    // apex_over() has from(edge) at the origin; here the edge runs from left_end to right_end or the other way round.
    Vec2 apex = apex_over(mesh, edge, g);
    if (mesh.from(edge) != left_vertex) apex.x = crossed - apex.x;
    const Vec2 along = (1 / crossed) * (right_end - left_end);
    // The corner lies to the left of the way from left_end to right_end, the new vertex to its right.
    const Vec2 at = left_end + apex.x * along + apex.y * Vec2{along.y, -along.x};
    const Index vertex = mesh.from(Mesh::previous(g));
    if (vertex == corner) return result;

    const bool beyond_left = cross(at_left, at) <= 0, beyond_right = cross(at, at_right) <= 0;
    const bool splits_left = !beyond_left && !beyond_right && dot(at_left, at) > 0;
    const bool splits_right = !beyond_left && !beyond_right && dot(at, at_right) > 0;
    if (splits_left && vertex != left) triangles.push_back({corner, left, vertex, at_left, at});
    if (splits_right && vertex != right) triangles.push_back({corner, vertex, right, at, at_right});
    result.split = splits_left && splits_right;
    if (result.split) return result;
    const bool go_right = splits_left || (!splits_right && beyond_left);  // what is left lies between it and right
    const Index to_left_vertex = mesh.from(g) == left_vertex ? Mesh::previous(g) : Mesh::next(g);
    const Index to_right_vertex = mesh.from(g) == left_vertex ? Mesh::next(g) : Mesh::previous(g);
    if (go_right) {
      if (splits_left) left = vertex, at_left = at;
      left_end = at;
      left_vertex = vertex;
      edge = to_right_vertex;
    } else {
      if (splits_right) right = vertex, at_right = at;
      right_end = at;
      edge = to_left_vertex;
    }
  }
  return result;
}

}  // namespace brushfire::detail
