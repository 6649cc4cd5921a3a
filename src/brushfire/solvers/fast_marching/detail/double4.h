// Four doubles in a register of a processor with AVX2, and four vectors in three of them. To be used in functions with
// BRUSHFIRE_AVX2 only.
#pragma once

#include <brushfire/solvers/fast_marching/detail/double8.h>

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

namespace brushfire::fast_marching {

struct Double4 {
  __m256d v;

  BRUSHFIRE_AVX2_INLINE friend Double4 operator+(Double4 a, Double4 b) { return {_mm256_add_pd(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator-(Double4 a, Double4 b) { return {_mm256_sub_pd(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator-(Double4 a) { return {_mm256_xor_pd(a.v, _mm256_set1_pd(-0.0))}; }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator*(Double4 a, Double4 b) { return {_mm256_mul_pd(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator/(Double4 a, Double4 b) { return {_mm256_div_pd(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator<(Double4 a, Double4 b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)}; }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator<=(Double4 a, Double4 b) {
    return {_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)};
  }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator&(Double4 a, Double4 b) { return {_mm256_and_pd(a.v, b.v)}; }
  BRUSHFIRE_AVX2_INLINE friend Double4 operator|(Double4 a, Double4 b) { return {_mm256_or_pd(a.v, b.v)}; }
};

BRUSHFIRE_AVX2_INLINE Double4 all4(double x) { return {_mm256_set1_pd(x)}; }
BRUSHFIRE_AVX2_INLINE Double4 square_root(Double4 a) { return {_mm256_sqrt_pd(a.v)}; }
BRUSHFIRE_AVX2_INLINE Double4 select(Double4 mask, Double4 yes, Double4 no) {
  return {_mm256_blendv_pd(no.v, yes.v, mask.v)};
}
BRUSHFIRE_AVX2_INLINE std::uint32_t bits(Double4 mask) {
  return static_cast<std::uint32_t>(_mm256_movemask_pd(mask.v));
}

// Stored as they are, or rounded; their roots, rounded.
BRUSHFIRE_AVX2_INLINE void store(double* to, Double4 a) { _mm256_store_pd(to, a.v); }
BRUSHFIRE_AVX2_INLINE void store(float* to, Double4 a) { _mm_store_ps(to, _mm256_cvtpd_ps(a.v)); }
BRUSHFIRE_AVX2_INLINE void store_root(double* to, Double4 a) { _mm256_store_pd(to, _mm256_sqrt_pd(a.v)); }
BRUSHFIRE_AVX2_INLINE void store_root(float* to, Double4 a) { _mm_store_ps(to, _mm256_cvtpd_ps(_mm256_sqrt_pd(a.v))); }

// What Vec3 is for one vector, operation by operation.
struct FourVec3 {
  Double4 x, y, z;

  BRUSHFIRE_AVX2_INLINE friend FourVec3 operator-(FourVec3 a, FourVec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  BRUSHFIRE_AVX2_INLINE friend FourVec3 operator*(Double4 s, FourVec3 a) { return {s * a.x, s * a.y, s * a.z}; }
};

BRUSHFIRE_AVX2_INLINE Double4 dot(FourVec3 a, FourVec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
BRUSHFIRE_AVX2_INLINE FourVec3 cross(FourVec3 a, FourVec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
BRUSHFIRE_AVX2_INLINE FourVec3 select(Double4 mask, FourVec3 yes, FourVec3 no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

// Three numbers each, from these places on.
BRUSHFIRE_AVX2_INLINE FourVec3 load_four(const double* a, const double* b, const double* c, const double* d) {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const __m256d row[4] = {_mm256_maskload_pd(a, three), _mm256_maskload_pd(b, three), _mm256_maskload_pd(c, three),
                          _mm256_maskload_pd(d, three)};
  FourVec3 loaded;
  transpose4(row, loaded.x.v, loaded.y.v, loaded.z.v);
  return loaded;
}

}  // namespace brushfire::fast_marching

#endif
