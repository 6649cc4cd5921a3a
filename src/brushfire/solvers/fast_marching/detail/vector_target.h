// Which functions are compiled twice: for any processor, and for those with 256-bit vectors.
#pragma once

#include <brushfire/core/detail/inline.h>

#include <cstdint>

// Functions marked [[gnu::target(...)]] may only call what is BRUSHFIRE_INLINE, or not vectorised, and are entered
// after
// __builtin_cpu_supports() has said yes. Products are not contracted: both variants give the same bits.
#if defined(__x86_64__) && defined(__GNUC__)
#define BRUSHFIRE_HAS_AVX2_VARIANT 1
#endif

namespace brushfire::fast_marching {

// The variant for this processor, or the one that runs on all of them: the same bits.
enum class Variant : std::uint8_t { Best, Portable };

// Whether this processor has them.
inline bool has_avx2() {
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

}  // namespace brushfire::fast_marching
