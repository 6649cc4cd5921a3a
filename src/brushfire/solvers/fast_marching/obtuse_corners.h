// Finds the faces that have an obtuse corner: one by one, or four at a time in registers. Both find the same.
#pragma once

#include <brushfire/solvers/fast_marching/double8.h>
#include <brushfire/solvers/fast_marching/unfold.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

#include <span>

namespace brushfire::detail {

// Writes the halfedges of the obtuse corners of faces `begin` to `end` - 1, and returns how many there are. There must
// be room for one more than there are.
BRUSHFIRE_INLINE std::size_t find_obtuse(std::span<const Vec3> positions, std::span<const Face> faces, double scale,
                                         std::size_t begin, std::size_t end, Index* obtuse) {
  std::size_t count = 0;
  for (std::size_t f = begin; f < end; ++f) {
    const Face& t = faces[f];
    const Vec3 a = positions[t[0]], b = positions[t[1]], c = positions[t[2]];
    const Vec3 ab = scale * (b - a), bc = scale * (c - b), ca = scale * (a - c);
    const Index h = obtuse_corner({dot(ab, ab), dot(bc, bc), dot(ca, ca)}, static_cast<Index>(f));
    obtuse[count] = h;  // written always, kept where wanted: there is no telling which faces are
    count += h != kNoIndex;
  }
  return count;
}

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

// Of four rows x y z *: x x + y y + z z of each.
BRUSHFIRE_AVX2_INLINE __m256d squares4(const __m256d* row) {
  __m256d x, y, z;
  transpose4(row, x, y, z);
  return squares_sum(x, y, z);
}

// The same. Of the two cases of obtuse_corner(), by lane: whether the first edge is no shorter than the
// second, and whether the longer one of these is no shorter than the third.
BRUSHFIRE_AVX2 inline std::size_t find_obtuse4(std::span<const Vec3> positions, std::span<const Face> faces,
                                               double scale, std::size_t begin, std::size_t end, Index* obtuse) {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const auto* const numbers = reinterpret_cast<const double*>(positions.data());
  const __m256d scales = _mm256_set1_pd(scale), less = _mm256_set1_pd(1 - kRightAngle);
  constexpr std::size_t kAhead = 64;
  std::size_t count = 0, f = begin;
  for (; f + 4 <= end; f += 4) {
    const std::size_t soon = faces[f][0] + kAhead;  // a vertex of faces that come soon, in a local order
    if (soon < positions.size()) prefetch(&positions[soon]);
    __m256d ab[4], bc[4], ca[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const Face& t = faces[f + k];
      const __m256d a = _mm256_maskload_pd(numbers + 3 * std::size_t{t[0]}, three);
      const __m256d b = _mm256_maskload_pd(numbers + 3 * std::size_t{t[1]}, three);
      const __m256d c = _mm256_maskload_pd(numbers + 3 * std::size_t{t[2]}, three);
      ab[k] = _mm256_mul_pd(scales, _mm256_sub_pd(b, a));
      bc[k] = _mm256_mul_pd(scales, _mm256_sub_pd(c, b));
      ca[k] = _mm256_mul_pd(scales, _mm256_sub_pd(a, c));
    }
    const __m256d aa = squares4(ab), bb = squares4(bc), cc = squares4(ca);
    const __m256d first = _mm256_cmp_pd(aa, bb, _CMP_GE_OQ);
    const __m256d longer = _mm256_blendv_pd(bb, aa, first), shorter = _mm256_blendv_pd(aa, bb, first);
    const __m256d not_third = _mm256_cmp_pd(longer, cc, _CMP_GE_OQ);
    const __m256d most = _mm256_blendv_pd(cc, longer, not_third);
    const __m256d others = _mm256_blendv_pd(_mm256_add_pd(aa, bb), _mm256_add_pd(cc, shorter), not_third);
    const auto is_obtuse =
        static_cast<Index>(_mm256_movemask_pd(_mm256_cmp_pd(others, _mm256_mul_pd(most, less), _CMP_LT_OQ)));
    const auto is_first = static_cast<Index>(_mm256_movemask_pd(first));
    const auto is_not_third = static_cast<Index>(_mm256_movemask_pd(not_third));
    for (Index k = 0; k < 4; ++k) {
      const Index across = (is_not_third >> k & 1u) == 0 ? 1u : (is_first >> k & 1u) * 2;
      obtuse[count] = static_cast<Index>(3 * (f + k)) + across;
      count += is_obtuse >> k & 1u;
    }
  }
  return count + find_obtuse(positions, faces, scale, f, end, obtuse + count);
}

#endif

}  // namespace brushfire::detail
