// Eight doubles in two registers of a processor with AVX2: what Float8 is for floats, operation by operation.
#pragma once

#include <brushfire/solvers/fast_marching/detail/float8.h>

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

namespace brushfire::fast_marching {

struct Double8 {
  __m256d low, high;

  BRUSHFIRE_AVX2_INLINE friend Double8 operator+(Double8 a, Double8 b) {
    return {_mm256_add_pd(a.low, b.low), _mm256_add_pd(a.high, b.high)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double8 operator-(Double8 a, Double8 b) {
    return {_mm256_sub_pd(a.low, b.low), _mm256_sub_pd(a.high, b.high)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double8 operator*(Double8 a, Double8 b) {
    return {_mm256_mul_pd(a.low, b.low), _mm256_mul_pd(a.high, b.high)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double8 operator/(Double8 a, Double8 b) {
    return {_mm256_div_pd(a.low, b.low), _mm256_div_pd(a.high, b.high)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double8 operator<(Double8 a, Double8 b) {
    return {_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ), _mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double8 operator<=(Double8 a, Double8 b) {
    return {_mm256_cmp_pd(a.low, b.low, _CMP_LE_OQ), _mm256_cmp_pd(a.high, b.high, _CMP_LE_OQ)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double8 operator&(Double8 a, Double8 b) {
    return {_mm256_and_pd(a.low, b.low), _mm256_and_pd(a.high, b.high)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double8 operator|(Double8 a, Double8 b) {
    return {_mm256_or_pd(a.low, b.low), _mm256_or_pd(a.high, b.high)};
  }
};

template <>
struct LanesOf<double> {
  using Type = Double8;
};

BRUSHFIRE_AVX2_INLINE Double8 all(double x) { return {_mm256_set1_pd(x), _mm256_set1_pd(x)}; }
BRUSHFIRE_AVX2_INLINE Double8 load(const double* from) { return {_mm256_load_pd(from), _mm256_load_pd(from + 4)}; }
BRUSHFIRE_AVX2_INLINE void store(double* to, Double8 a) {
  _mm256_store_pd(to, a.low);
  _mm256_store_pd(to + 4, a.high);
}
BRUSHFIRE_AVX2_INLINE Double8 square_root(Double8 a) { return {_mm256_sqrt_pd(a.low), _mm256_sqrt_pd(a.high)}; }
BRUSHFIRE_AVX2_INLINE Double8 lesser(Double8 a, Double8 b) {
  return {_mm256_min_pd(a.low, b.low), _mm256_min_pd(a.high, b.high)};
}
BRUSHFIRE_AVX2_INLINE Double8 greater(Double8 a, Double8 b) {
  return {_mm256_max_pd(a.low, b.low), _mm256_max_pd(a.high, b.high)};
}
BRUSHFIRE_AVX2_INLINE Double8 select(Double8 mask, Double8 yes, Double8 no) {
  return {_mm256_blendv_pd(no.low, yes.low, mask.low), _mm256_blendv_pd(no.high, yes.high, mask.high)};
}
BRUSHFIRE_AVX2_INLINE std::uint32_t bits(Double8 mask) {
  return static_cast<std::uint32_t>(_mm256_movemask_pd(mask.low) | _mm256_movemask_pd(mask.high) << 4);
}
BRUSHFIRE_AVX2_INLINE Double8 magnitude(Double8 a) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return {_mm256_andnot_pd(sign, a.low), _mm256_andnot_pd(sign, a.high)};
}

// An index for permuted(), made once for several uses: where the numbers of a half are, and which register has them.
struct DoubleIndex {
  __m256i low, high;

  BRUSHFIRE_AVX2_INLINE static DoubleIndex of(__m256i any) {
    const __m256i index = _mm256_and_si256(any, _mm256_set1_epi32(7));
    const __m256i low = _mm256_cvtepu32_epi64(_mm256_castsi256_si128(index));
    const __m256i high = _mm256_cvtepu32_epi64(_mm256_extracti128_si256(index, 1));
    return {pairs(low), pairs(high)};
  }

 private:
  // 2i and 2i + 1: the halves of number i, the register's number in bit 3.
  BRUSHFIRE_AVX2_INLINE static __m256i pairs(__m256i index) {
    const __m256i twice = _mm256_slli_epi64(index, 1);
    return _mm256_or_si256(_mm256_or_si256(twice, _mm256_slli_epi64(twice, 32)), _mm256_set1_epi64x(1ll << 32));
  }
};
BRUSHFIRE_AVX2_INLINE DoubleIndex index_for(Double8, __m256i index) { return DoubleIndex::of(index); }

BRUSHFIRE_AVX2_INLINE __m256d permuted_half(Double8 a, __m256i index) {
  const __m256 from_low = _mm256_permutevar8x32_ps(_mm256_castpd_ps(a.low), index);
  const __m256 from_high = _mm256_permutevar8x32_ps(_mm256_castpd_ps(a.high), index);
  return _mm256_castps_pd(_mm256_blendv_ps(from_low, from_high, _mm256_castsi256_ps(_mm256_slli_epi32(index, 31 - 3))));
}
BRUSHFIRE_AVX2_INLINE Double8 permuted(Double8 a, DoubleIndex index) {
  return {permuted_half(a, index.low), permuted_half(a, index.high)};
}

// Numbers of four bytes that are masks, as masks of numbers of eight.
BRUSHFIRE_AVX2_INLINE Double8 wide_mask(Double8, __m256i mask) {
  return {_mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_castsi256_si128(mask))),
          _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_extracti128_si256(mask, 1)))};
}

// The columns of four rows x y z *.
BRUSHFIRE_AVX2_INLINE void transpose4(const __m256d* row, __m256d& x, __m256d& y, __m256d& z) {
  const __m256d x01 = _mm256_unpacklo_pd(row[0], row[1]), y01 = _mm256_unpackhi_pd(row[0], row[1]);
  const __m256d x23 = _mm256_unpacklo_pd(row[2], row[3]), y23 = _mm256_unpackhi_pd(row[2], row[3]);
  x = _mm256_permute2f128_pd(x01, x23, 0x20);
  y = _mm256_permute2f128_pd(y01, y23, 0x20);
  z = _mm256_permute2f128_pd(x01, x23, 0x31);
}
BRUSHFIRE_AVX2_INLINE __m256d squares_sum(__m256d x, __m256d y, __m256d z) {
  return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(x, x), _mm256_mul_pd(y, y)), _mm256_mul_pd(z, z));
}
BRUSHFIRE_AVX2_INLINE void transpose(const __m256d* row, Double8& x, Double8& y, Double8& z) {
  transpose4(row, x.low, y.low, z.low);
  transpose4(row + 4, x.high, y.high, z.high);
}

// The sums over four lanes of a, b and c, in their order, added to `sum`.
BRUSHFIRE_AVX2_INLINE __m256d add_lanes4(__m256d sum, __m256d a, __m256d b, __m256d c) {
  const __m256d zero = _mm256_setzero_pd();
  const __m256d ab0 = _mm256_unpacklo_pd(a, b), ab1 = _mm256_unpackhi_pd(a, b);  // lanes 0 and 2, 1 and 3
  const __m256d c0 = _mm256_unpacklo_pd(c, zero), c1 = _mm256_unpackhi_pd(c, zero);
  sum = _mm256_add_pd(sum, _mm256_permute2f128_pd(ab0, c0, 0x20));
  sum = _mm256_add_pd(sum, _mm256_permute2f128_pd(ab1, c1, 0x20));
  sum = _mm256_add_pd(sum, _mm256_permute2f128_pd(ab0, c0, 0x31));
  return _mm256_add_pd(sum, _mm256_permute2f128_pd(ab1, c1, 0x31));
}
BRUSHFIRE_AVX2_INLINE std::array<double, 4> sums_of(Double8 a, Double8 b, Double8 c) {
  const __m256d low = add_lanes4(_mm256_setzero_pd(), a.low, b.low, c.low);
  std::array<double, 4> sums;
  _mm256_storeu_pd(sums.data(), add_lanes4(low, a.high, b.high, c.high));
  return sums;
}

}  // namespace brushfire::fast_marching

#endif
