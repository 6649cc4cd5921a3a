// Unrolls the faces behind an obtuse corner into the corner's plane.
#include <brushfire/solvers/fast_marching/detail/unfold.h>

#include <brushfire/core/detail/planar.h>
#include <brushfire/mesh/detail/face_geometry.h>

#include <algorithm>
#include <cmath>

namespace brushfire::fast_marching {
namespace {

constexpr Index kCrowd = 64;

constexpr Index next_corner(Index k) { return k == 2 ? 0 : k + 1; }
constexpr Index previous_corner(Index k) { return k == 0 ? 2 : k - 1; }

// The halfedge of a face between two of its vertices.
Index halfedge_between(Index f, const Face& t, Index v, Index w) {
  for (Index k = 0; k < 3; ++k) {
    const Index from = t[k], to = t[next_corner(k)];
    if ((from == v && to == w) || (from == w && to == v)) return 3 * f + k;
  }
  return 3 * f;
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
  return plain_ ? detail::geometry_of(positions_, faces_[f], scale_) : mesh_.face_geometry(f);
}

// Among the faces at one of the edge's ends; where there are too many, the mesh knows better.
Index Unfolder::face_over(Index f, Index v, Index w) const {
  if (plain_ && corner_offsets_[v + 1] - corner_offsets_[v] <= kCrowd) {
    Index found = kNoIndex, count = 0;
    for (Index i = corner_offsets_[v]; i < corner_offsets_[v + 1]; ++i) {
      const Index other = corners_[i] / 3;
      const Face& t = faces_[other];
      // Without branches: there is no telling which face it is.
      const bool is = ((t[0] == w) | (t[1] == w) | (t[2] == w)) & (other != f);
      found = is ? other : found;
      count += is;
    }
    if (count == 0 || (count == 1 && mesh_.is_face_usable(found))) return found;
  }
  const Index h = halfedge_between(f, faces_[f], v, w), g = mesh_.neighbour(h);
  return g != h ? g / 3 : kNoIndex;
}

Unfolder::Behind Unfolder::look_over(Index f, Index left, Index right) const {
  Behind behind;
  behind.face = face_over(f, left, right);
  if (behind.face == kNoIndex) return behind;
  const Face& t = faces_[behind.face];
  behind.vertex = t[0] + t[1] + t[2] - left - right;
  if (plain_) {
    const Mesh::FaceGeometry face = detail::geometry_of(positions_, {left, right, behind.vertex}, scale_);
    behind.to_right = face.lengths[1], behind.to_left = face.lengths[2];
    behind.double_area = face.double_area;
    return behind;
  }
  const Mesh::FaceGeometry face = mesh_.face_geometry(behind.face);
  const Index at_left = halfedge_between(0, t, left, behind.vertex);
  behind.to_left = face.lengths[at_left];
  behind.to_right = face.lengths[halfedge_between(0, t, right, behind.vertex)];
  behind.double_area = face.double_area;
  return behind;
}

Unfolding Unfolder::unfold(Index h, int most, std::vector<UnfoldedTriangle>& triangles) const {
  Index f = h / 3;
  const Index own = h - 3 * f, corner = faces_[f][own];
  const Mesh::FaceGeometry face = geometry(f);
  Unfolding result;
  const double first = face.lengths[own], second = face.lengths[previous_corner(own)];
  const double across = face.lengths[next_corner(own)];
  result.obtuse = first * first + second * second < across * across * (1 - kRightAngle);
  if (!result.obtuse || first == 0) return result;
  // Left and right bound what is left of the angle; left_end and right_end are the edge that is crossed next.
  Index left = faces_[f][next_corner(own)], right = faces_[f][previous_corner(own)];
  Vec2 at_left{first, 0}, at_right = apex_over_edge(first, second, across, face.double_area);
  Index left_end = left, right_end = right;
  Vec2 at_left_end = at_left, at_right_end = at_right;
  double crossed = across;  // the length of that edge
  while (result.crossed < most && crossed > 0) {
    const Behind behind = look_over(f, left_end, right_end);
    if (behind.face == kNoIndex) return result;
    ++result.crossed;
    f = behind.face;
    if (behind.vertex == corner) return result;
    // The corner lies to the left of the way from left_end to right_end, the new vertex to its right.
    const Vec2 apex = apex_over_edge(crossed, behind.to_left, behind.to_right, behind.double_area);
    const Vec2 along = (1 / crossed) * (at_right_end - at_left_end);
    const Vec2 at = at_left_end + apex.x * along + apex.y * Vec2{along.y, -along.x};

    const bool beyond_left = cross(at_left, at) <= 0, beyond_right = cross(at, at_right) <= 0;
    const bool splits_left = !beyond_left && !beyond_right && dot(at_left, at) > 0;
    const bool splits_right = !beyond_left && !beyond_right && dot(at, at_right) > 0;
    if (splits_left && behind.vertex != left) triangles.push_back({corner, left, behind.vertex, at_left, at});
    if (splits_right && behind.vertex != right) triangles.push_back({corner, behind.vertex, right, at, at_right});
    result.split = splits_left && splits_right;
    if (result.split) return result;
    const bool go_right = splits_left || (!splits_right && beyond_left);  // what is left lies between it and right
    if (go_right) {
      if (splits_left) left = behind.vertex, at_left = at;
      left_end = behind.vertex, at_left_end = at;
      crossed = behind.to_right;
    } else {
      if (splits_right) right = behind.vertex, at_right = at;
      right_end = behind.vertex, at_right_end = at;
      crossed = behind.to_left;
    }
  }
  return result;
}

}  // namespace brushfire::fast_marching
