// Unrolls the faces behind an obtuse corner into the corner's plane.
#include <brushfire/solvers/fast_marching/unfold.h>

#include <brushfire/core/planar.h>
#include <brushfire/mesh/detail/face_geometry.h>
#include <brushfire/solvers/fast_marching/double8.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

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

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

// Lane k: number k + 1 of three.
BRUSHFIRE_AVX2_INLINE __m256d turned(__m256d a) { return _mm256_permute4x64_pd(a, 0b11'00'10'01); }

// Lengths and area as edges_of(), lengths_of() and double_area_of() compute them, the three edges at once. False where
// squares may have vanished, or are not finite.
BRUSHFIRE_AVX2 bool geometry3(const double* positions, const Face& t, double scale, Mesh::FaceGeometry& geometry) {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const __m256d scales = _mm256_set1_pd(scale);
  const __m256d a = _mm256_maskload_pd(positions + 3 * std::size_t{t[0]}, three);
  const __m256d b = _mm256_maskload_pd(positions + 3 * std::size_t{t[1]}, three);
  const __m256d c = _mm256_maskload_pd(positions + 3 * std::size_t{t[2]}, three);
  const __m256d edge[4] = {_mm256_mul_pd(scales, _mm256_sub_pd(b, a)), _mm256_mul_pd(scales, _mm256_sub_pd(c, b)),
                           _mm256_mul_pd(scales, _mm256_sub_pd(a, c)), _mm256_setzero_pd()};
  __m256d x, y, z;
  transpose4(edge, x, y, z);
  const __m256d squared = squares_sum(x, y, z);
  const __m256d fine = _mm256_and_pd(_mm256_cmp_pd(squared, _mm256_set1_pd(0x1p-900), _CMP_GT_OQ),
                                     _mm256_cmp_pd(squared, _mm256_set1_pd(0x1p1000), _CMP_LT_OQ));
  if ((_mm256_movemask_pd(fine) & 7) != 7) return false;
  // The cross product of the two other edges, for each.
  const __m256d x1 = turned(x), y1 = turned(y), z1 = turned(z), x2 = turned(x1), y2 = turned(y1), z2 = turned(z1);
  const __m256d cross_x = _mm256_sub_pd(_mm256_mul_pd(y1, z2), _mm256_mul_pd(z1, y2));
  const __m256d cross_y = _mm256_sub_pd(_mm256_mul_pd(z1, x2), _mm256_mul_pd(x1, z2));
  const __m256d cross_z = _mm256_sub_pd(_mm256_mul_pd(x1, y2), _mm256_mul_pd(y1, x2));
  alignas(32) double length[4], area_squared[4];
  _mm256_store_pd(length, _mm256_sqrt_pd(squared));
  _mm256_store_pd(area_squared, squares_sum(cross_x, cross_y, cross_z));
  const std::size_t longer = length[1] > length[0] ? 1 : 0, longest = length[2] > length[longer] ? 2 : longer;
  geometry = {{length[0], length[1], length[2]}, std::sqrt(area_squared[longest])};
  return area_squared[longest] > 0x1p-900;
}

#endif

}  // namespace

Unfolder::Unfolder(const Mesh& mesh, Variant variant)
    : mesh_(mesh),
      plain_(mesh.has_positions() && !mesh.has_slits()),
      in_registers_(plain_ && variant == Variant::Best && has_avx2()),
      positions_(mesh.positions()),
      faces_(mesh.faces()),
      corner_offsets_(mesh.corner_offsets()),
      corners_(mesh.all_corners()),
      scale_(1 / mesh.unit()) {}

Mesh::FaceGeometry Unfolder::geometry(Index f) const {
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
  Mesh::FaceGeometry found;
  if (in_registers_ && geometry3(&positions_.data()->x, faces_[f], scale_, found)) return found;
#endif
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
  if (face.lengths[own] == 0) return result;
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
