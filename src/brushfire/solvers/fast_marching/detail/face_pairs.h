// The faces behind obtuse corners, looked up among the faces at one end of the edge across.
#pragma once

#include <brushfire/core/detail/prefetch.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/fast_marching/detail/float8.h>
#include <brushfire/solvers/fast_marching/detail/split_corner.h>
#include <brushfire/solvers/fast_marching/detail/unfold.h>
#include <brushfire/solvers/fast_marching/detail/vector_target.h>

#include <bit>
#include <span>

namespace brushfire::fast_marching {

// The vertex of a face that is neither of these two of its vertices.
inline Index third(const Face& t, Index a, Index b) { return t[0] + t[1] + t[2] - a - b; }

// Of the corner of halfedge h in a face with three vertices. Where there is not exactly one face behind, or it is the
// same one turned over, an end takes the place of what is behind: nothing is split by that.
inline FacePair face_pair(const Mesh& mesh, const Unfolder& unfolder, Index h) {
  const Index edge = Mesh::next(h), corner = mesh.from(h), end0 = mesh.from(edge), end1 = mesh.to(edge);
  const Index other = unfolder.face_over(h / 3, end0, end1);
  if (other == kNoIndex) return {{end0, end1}, corner, end0};
  const Index behind = third(mesh.faces()[other], end0, end1);
  return {{end0, end1}, corner, behind != corner ? behind : end0};
}

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

// The same for many corners, at vertices of up to eight faces in registers.
class FacePairs {
 public:
  FacePairs(const Mesh& mesh, const Unfolder& unfolder)
      : mesh_(mesh),
        unfolder_(unfolder),
        faces_(mesh.faces()),
        corner_offsets_(mesh.corner_offsets()),
        corners_(mesh.all_corners()) {}

  // pair[i]: of obtuse[i].
  BRUSHFIRE_AVX2 void find(std::span<const Index> obtuse, FacePair* pair) const {
    constexpr std::size_t kSoon = 16, kLater = 32;
    for (std::size_t i = 0; i < obtuse.size() + kLater; ++i) {
      if (i < obtuse.size()) prefetch(&corner_offsets_[first_end(obtuse[i])]);
      if (i >= kSoon && i - kSoon < obtuse.size()) prefetch_corners(first_end(obtuse[i - kSoon]));
      if (i >= kLater) find(obtuse[i - kLater], pair[i - kLater]);
    }
  }

 private:
  // Of the edge across.
  BRUSHFIRE_AVX2_INLINE Index first_end(Index h) const {
    const Index f = h / 3, k = h - 3 * f;
    return faces_[f][k == 2 ? 0 : k + 1];
  }

  // Those at a vertex, which may be in two cache lines.
  BRUSHFIRE_AVX2_INLINE void prefetch_corners(Index v) const {
    prefetch(&corners_[corner_offsets_[v]]);
    prefetch(&corners_[corner_offsets_[v + 1] - 1]);
  }

  BRUSHFIRE_AVX2_INLINE void find(Index h, FacePair& pair) const {
    if (!find_quickly(h, pair)) pair = face_pair(mesh_, unfolder_, h);
  }

  // False where the other way is needed.
  BRUSHFIRE_AVX2_INLINE bool find_quickly(Index h, FacePair& pair) const {
    const Index own = h / 3, k = h - 3 * own;
    const Face& t = faces_[own];
    const Index corner = t[k], end0 = t[k == 2 ? 0 : k + 1], end1 = t[k == 0 ? 2 : k - 1];
    const Index begin = corner_offsets_[end0], count = corner_offsets_[end0 + 1] - begin;
    if (count > kMost) return false;
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i used = _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane);
    const __m256i face = face_of(_mm256_maskload_epi32(reinterpret_cast<const int*>(corners_.data() + begin), used));
    alignas(32) Index number[kMost];
    _mm256_store_si256(reinterpret_cast<__m256i*>(number), face);
    const __m256i is_own = _mm256_cmpeq_epi32(face, _mm256_set1_epi32(static_cast<int>(own)));
    const __m256i other = _mm256_andnot_si256(_mm256_or_si256(lacking(number, end1), is_own), used);
    const auto others = static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(other)));
    if (std::popcount(others) != 1) return false;
    pair = {{end0, end1}, corner, third(faces_[number[std::countr_zero(others)]], end0, end1)};
    return pair.behind != corner && pair.behind != end0 && pair.behind != end1;
  }

  // h / 3, of the even lanes and of the odd ones.
  BRUSHFIRE_AVX2_INLINE static __m256i face_of(__m256i h) {
    const __m256i inverse = _mm256_set1_epi64x(0xaaaaaaab);
    const __m256i even = _mm256_srli_epi64(_mm256_mul_epu32(h, inverse), 33);
    const __m256i odd = _mm256_srli_epi64(_mm256_mul_epu32(_mm256_srli_epi64(h, 32), inverse), 33);
    return _mm256_or_si256(even, _mm256_slli_epi64(odd, 32));
  }

  // Which of these faces do not have vertex v.
  BRUSHFIRE_AVX2_INLINE __m256i lacking(const Index* face, Index v) const {
    const __m128i wanted = _mm_set1_epi32(static_cast<int>(v)), three = _mm_setr_epi32(-1, -1, -1, 0);
    __m128i has[kMost];
    for (Index i = 0; i < kMost; ++i) {
      const auto* const vertices = reinterpret_cast<const int*>(&faces_[face[i]]);
      has[i] = _mm_and_si128(_mm_cmpeq_epi32(_mm_maskload_epi32(vertices, three), wanted), three);
    }
    // Four bytes for the four numbers of each face, in the order of the faces.
    const __m256i two = _mm256_set_m128i(_mm_packs_epi32(has[4], has[5]), _mm_packs_epi32(has[0], has[1]));
    const __m256i next_two = _mm256_set_m128i(_mm_packs_epi32(has[6], has[7]), _mm_packs_epi32(has[2], has[3]));
    return _mm256_cmpeq_epi32(_mm256_packs_epi16(two, next_two), _mm256_setzero_si256());
  }

  static constexpr Index kMost = 8;
  const Mesh& mesh_;
  const Unfolder& unfolder_;
  std::span<const Face> faces_;
  std::span<const Index> corner_offsets_, corners_;
};

#endif

}  // namespace brushfire::fast_marching
