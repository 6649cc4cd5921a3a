// Which instruction sets kernels are compiled for, and which of them this processor has.
//
// A kernel is a header whose name ends in _kernel.h: each_target.h includes it once for each target, in a namespace of
// the target's name. Its namesake (fronts.h for fronts_kernel.h) makes it all so, and is what others include.
#pragma once

#include <brushfire/core/detail/inline.h>

#include <cstdint>

// AVX2 is a target of its own on x86, entered after the processor has said that it has it; so is AVX-512, for kernels
// of sixteen lanes that ask for it (each_target.h). Everywhere else, and for compilers that know no targets within a
// file, there is one: what the file is compiled for (SSE2, NEON, WebAssembly SIMD, or no vectors at all).
#if defined(__GNUC__) && !defined(BRUSHFIRE_WITHOUT_VECTORS)
#define BRUSHFIRE_HAS_VECTORS 1
#if defined(__x86_64__)
#define BRUSHFIRE_HAS_AVX2_TARGET 1
#endif
#endif

namespace brushfire {

// Which one of the targets to take: all of them give the same bits.
enum class Variant : std::uint8_t { Best, Avx2, Portable };  // Avx2: no more than that

#ifdef BRUSHFIRE_HAS_AVX2_TARGET
struct Instructions {
  bool avx2 = false;    // with BMI and POPCNT
  bool avx512 = false;  // F, DQ, BW and VL, and AVX2
};

// This processor's, and those that its system lets programs use. None before the program's initialisation has come to
// it.
extern const Instructions kInstructions;

inline bool has_avx2() { return kInstructions.avx2; }
inline bool has_avx512() { return kInstructions.avx512; }
#else
constexpr bool has_avx2() { return false; }
constexpr bool has_avx512() { return false; }
#endif

}  // namespace brushfire

// BRUSHFIRE_ON_TARGET(variant, expression): the expression with the functions of that target, whose namespace it is
// to be looked up in: BRUSHFIRE_ON_TARGET(variant, sum(x)) is avx2::sum(x) or portable::sum(x).
// BRUSHFIRE_ON_WIDE_TARGET: the same of a kernel that is compiled for AVX-512, too.
#ifdef BRUSHFIRE_HAS_AVX2_TARGET
#define BRUSHFIRE_ON_TARGET(variant, ...) \
  ((variant) != Variant::Portable && has_avx2() ? avx2::__VA_ARGS__ : portable::__VA_ARGS__)
#define BRUSHFIRE_ON_WIDE_TARGET(variant, ...) \
  ((variant) == Variant::Best && has_avx512() ? avx512::__VA_ARGS__ : BRUSHFIRE_ON_TARGET(variant, __VA_ARGS__))
#else
#define BRUSHFIRE_ON_TARGET(variant, ...) (static_cast<void>(variant), portable::__VA_ARGS__)
#define BRUSHFIRE_ON_WIDE_TARGET(variant, ...) BRUSHFIRE_ON_TARGET(variant, __VA_ARGS__)
#endif
