// Eight floats in one register of a processor with AVX2. To be used in functions with BRUSHFIRE_AVX2 only.
#pragma once

#include <brushfire/solvers/fast_marching/detail/vector_target.h>

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

#include <immintrin.h>

#include <array>
#include <cstdint>

#define BRUSHFIRE_AVX2 [[gnu::target("avx2,bmi,lzcnt,popcnt")]]
#define BRUSHFIRE_AVX2_INLINE [[gnu::target("avx2,bmi,lzcnt,popcnt"), gnu::always_inline]] inline

namespace brushfire::fast_marching {

// Numbers, or masks: all bits of a lane, or none.
struct Float8 {
  __m256 v;

  BRUSHFIRE_AVX2_INLINE friend Float8 operator+(Float8 a, Float8 b) { return {_mm256_add_ps(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Float8 operator-(Float8 a, Float8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Float8 operator*(Float8 a, Float8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Float8 operator/(Float8 a, Float8 b) { return {_mm256_div_ps(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Float8 operator<(Float8 a, Float8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
  BRUSHFIRE_AVX2_INLINE friend Float8 operator<=(Float8 a, Float8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
  BRUSHFIRE_AVX2_INLINE friend Float8 operator&(Float8 a, Float8 b) { return {_mm256_and_ps(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Float8 operator|(Float8 a, Float8 b) { return {_mm256_or_ps(a.v, b.v)}; }
};

// Eight numbers of type T.
template <class T>
struct LanesOf;
template <>
struct LanesOf<float> {
  using Type = Float8;
};
template <class T>
using Lanes = typename LanesOf<T>::Type;

BRUSHFIRE_AVX2_INLINE Float8 all(float x) { return {_mm256_set1_ps(x)}; }
BRUSHFIRE_AVX2_INLINE Float8 load(const float* from) { return {_mm256_load_ps(from)}; }
BRUSHFIRE_AVX2_INLINE void store(float* to, Float8 a) { _mm256_store_ps(to, a.v); }
BRUSHFIRE_AVX2_INLINE Float8 square_root(Float8 a) { return {_mm256_sqrt_ps(a.v)}; }
// a < b ? a : b and a > b ? a : b, lane by lane.
BRUSHFIRE_AVX2_INLINE Float8 lesser(Float8 a, Float8 b) { return {_mm256_min_ps(a.v, b.v)}; }
BRUSHFIRE_AVX2_INLINE Float8 greater(Float8 a, Float8 b) { return {_mm256_max_ps(a.v, b.v)}; }
BRUSHFIRE_AVX2_INLINE Float8 select(Float8 mask, Float8 yes, Float8 no) {
  return {_mm256_blendv_ps(no.v, yes.v, mask.v)};
}
BRUSHFIRE_AVX2_INLINE std::uint32_t bits(Float8 mask) { return static_cast<std::uint32_t>(_mm256_movemask_ps(mask.v)); }

BRUSHFIRE_AVX2_INLINE Float8 magnitude(Float8 a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }

// Lane k of the result: lane index[k] % 8 of a.
BRUSHFIRE_AVX2_INLINE Float8 permuted(Float8 a, __m256i index) { return {_mm256_permutevar8x32_ps(a.v, index)}; }
// What permuted() wants for an index; the first argument tells for which numbers.
BRUSHFIRE_AVX2_INLINE __m256i index_for(Float8, __m256i index) { return index; }
// A mask of integers as one of such numbers.
BRUSHFIRE_AVX2_INLINE Float8 wide_mask(Float8, __m256i mask) { return {_mm256_castsi256_ps(mask)}; }

BRUSHFIRE_AVX2_INLINE __m256 rounded(__m256d low, __m256d high) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(low)), _mm256_cvtpd_ps(high), 1);
}
// The columns of eight rows x y z *, rounded.
BRUSHFIRE_AVX2_INLINE void transpose(const __m256d* row, Float8& x, Float8& y, Float8& z) {
  const __m256 r0 = rounded(row[0], row[4]), r1 = rounded(row[1], row[5]);
  const __m256 r2 = rounded(row[2], row[6]), r3 = rounded(row[3], row[7]);
  const __m256 xy01 = _mm256_unpacklo_ps(r0, r1), xy23 = _mm256_unpacklo_ps(r2, r3);
  const __m256 z01 = _mm256_unpackhi_ps(r0, r1), z23 = _mm256_unpackhi_ps(r2, r3);
  x.v = _mm256_shuffle_ps(xy01, xy23, 0x44);
  y.v = _mm256_shuffle_ps(xy01, xy23, 0xee);
  z.v = _mm256_shuffle_ps(z01, z23, 0x44);
}

// The sums over the lanes of a, b and c, in their order.
BRUSHFIRE_AVX2_INLINE std::array<float, 4> sums_of(Float8 a, Float8 b, Float8 c) {
  // By lane: a, b, c and 0; lanes 0 and 4, 1 and 5 and so on.
  const __m256 ab0 = _mm256_unpacklo_ps(a.v, b.v), ab2 = _mm256_unpackhi_ps(a.v, b.v);
  const __m256 c0 = _mm256_unpacklo_ps(c.v, _mm256_setzero_ps()), c2 = _mm256_unpackhi_ps(c.v, _mm256_setzero_ps());
  const __m256 lane[] = {_mm256_shuffle_ps(ab0, c0, 0x44), _mm256_shuffle_ps(ab0, c0, 0xee),
                         _mm256_shuffle_ps(ab2, c2, 0x44), _mm256_shuffle_ps(ab2, c2, 0xee)};
  __m128 sum = _mm_setzero_ps();
  for (const __m256 l : lane) sum = _mm_add_ps(sum, _mm256_castps256_ps128(l));
  for (const __m256 l : lane) sum = _mm_add_ps(sum, _mm256_extractf128_ps(l, 1));
  std::array<float, 4> sums;
  _mm_storeu_ps(sums.data(), sum);
  return sums;
}

// For each set of lanes, their numbers: one after the other, from the lowest byte on.
inline constexpr std::array<std::uint64_t, 256> kPacking = [] {
  std::array<std::uint64_t, 256> packing{};
  for (unsigned set = 0; set < 256; ++set) {
    unsigned count = 0;
    for (std::uint64_t lane = 0; lane < 8; ++lane) {
      if ((set >> lane & 1u) != 0) packing[set] |= lane << 8 * count++;
    }
  }
  return packing;
}();

// The index by which permuted() brings the lanes of a set to the front.
BRUSHFIRE_AVX2_INLINE __m256i packing(std::uint32_t set) {
  return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&kPacking[set])));
}

}  // namespace brushfire::fast_marching

#endif
