// Unrolls the faces behind an obtuse corner into the corner's plane.
#include <brushfire/solvers/fast_marching/unfold.h>

#include <brushfire/core/planar.h>
#include <brushfire/mesh/detail/face_geometry.h>

#include <algorithm>
#include <cmath>

namespace brushfire::detail {
namespace {

constexpr Index next_corner(Index k) { return k == 2 ? 0 : k + 1; }
constexpr Index previous_corner(Index k) { return k == 0 ? 2 : k - 1; }

// Where the third corner of a face lies over its edge k, from corner k + 1 on if `mirrored`.
Vec2 apex_over_edge(const Mesh::FaceGeometry& face, Index k, bool mirrored) {
  const double at_from = face.lengths[previous_corner(k)], at_to = face.lengths[next_corner(k)];
  return brushfire::apex_over_edge(face.lengths[k], mirrored ? at_to : at_from, mirrored ? at_from : at_to,
                                   face.double_area);
}

}  // namespace

Unfolder::Unfolder(const Mesh& mesh)
    : mesh_(mesh),
      plain_(mesh.has_positions() && !mesh.has_slits()),
      positions_(mesh.positions()),
      faces_(mesh.faces()),
      corner_offsets_(mesh.corner_offsets()),
      corners_(mesh.all_corners()),
      scale_(1 / mesh.unit()) {}

Mesh::FaceGeometry Unfolder::geometry(Index f) const {
  if (!plain_) return mesh_.face_geometry(f);
  const std::array<Vec3, 3> edge = edges_of(positions_, faces_[f], scale_);
  const std::array<double, 3> lengths = lengths_of(edge);
  return {lengths, double_area_of(edge, lengths)};
}

// Among the corners of one of its ends.
Index Unfolder::neighbour(Index h) const {
  if (!plain_) return mesh_.neighbour(h);
  const Index f = h / 3, k = h - 3 * f, v = faces_[f][k], w = faces_[f][next_corner(k)];
  Index found = kNoIndex, count = 0;
  for (Index i = corner_offsets_[v]; i < corner_offsets_[v + 1]; ++i) {
    const Index other = corners_[i] / 3;
    const Face& t = faces_[other];
    // Without branches: there is no telling which face it is.
    const bool is = ((t[0] == w) | (t[1] == w) | (t[2] == w)) & (other != f);
    found = is ? corners_[i] : found;
    count += is;
  }
  if (count == 0) return h;
  if (count > 1 || !mesh_.is_face_usable(found / 3)) return mesh_.neighbour(h);
  return faces_[found / 3][next_corner(found % 3)] == w ? found : Mesh::previous(found);
}

Unfolding Unfolder::unfold(Index h, std::vector<UnfoldedTriangle>& triangles) const {
  const Index own_face = h / 3, own = h - 3 * own_face, corner = faces_[own_face][own];
  Mesh::FaceGeometry face = geometry(own_face);
  Unfolding result;
  const double first = face.lengths[own], second = face.lengths[previous_corner(own)];
  const double across = face.lengths[next_corner(own)];
  result.obtuse = first * first + second * second < across * across * (1 - kRightAngle);
  if (!result.obtuse || face.lengths[own] == 0) return result;
  // Left and right bound what is left of the angle; left_end and right_end are the edge that is crossed next.
  Index left = faces_[own_face][next_corner(own)], right = faces_[own_face][previous_corner(own)];
  Vec2 at_left{face.lengths[own], 0}, at_right = apex_over_edge(face, own, false);
  Vec2 left_end = at_left, right_end = at_right;
  Index left_vertex = left;  // the vertex at left_end
  Index edge = 3 * own_face + next_corner(own);
  while (result.crossed < kMaxUnfolded) {
    const Index g = neighbour(edge);
    const double crossed = face.lengths[edge % 3];
    if (g == edge || crossed == 0) return result;
    ++result.crossed;
    // The new vertex over the edge from its left end on.
    const Index behind = g / 3, k = g - 3 * behind;
    const bool from_left = faces_[edge / 3][edge % 3] == left_vertex;
    const bool same_way = faces_[behind][k] == faces_[edge / 3][edge % 3];
    face = geometry(behind);
    Vec2 apex = apex_over_edge(face, k, !same_way);
    if (!from_left) apex.x = crossed - apex.x;
    const Vec2 along = (1 / crossed) * (right_end - left_end);
    // The corner lies to the left of the way from left_end to right_end, the new vertex to its right.
    const Vec2 at = left_end + apex.x * along + apex.y * Vec2{along.y, -along.x};
    const Index vertex = faces_[behind][previous_corner(k)];
    if (vertex == corner) return result;

    const bool beyond_left = cross(at_left, at) <= 0, beyond_right = cross(at, at_right) <= 0;
    const bool splits_left = !beyond_left && !beyond_right && dot(at_left, at) > 0;
    const bool splits_right = !beyond_left && !beyond_right && dot(at, at_right) > 0;
    if (splits_left && vertex != left) triangles.push_back({corner, left, vertex, at_left, at});
    if (splits_right && vertex != right) triangles.push_back({corner, vertex, right, at, at_right});
    result.split = splits_left && splits_right;
    if (result.split) return result;
    const bool go_right = splits_left || (!splits_right && beyond_left);  // what is left lies between it and right
    const bool left_first = faces_[behind][k] == left_vertex;
    const Index to_left_vertex = 3 * behind + (left_first ? previous_corner(k) : next_corner(k));
    const Index to_right_vertex = 3 * behind + (left_first ? next_corner(k) : previous_corner(k));
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
