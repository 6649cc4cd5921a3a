// Includes the header BRUSHFIRE_KERNEL once for each target (targets.h), as a part of this file: with BRUSHFIRE_TARGET,
// the target's namespace, and BRUSHFIRE_REGISTER, the bytes of its registers. What the kernel itself includes is
// included the first time, for the compiler's own target. Nothing is contracted: every target gives the same bits.
// AVX-512 is among them where BRUSHFIRE_KERNEL_IS_WIDE is defined: for kernels of sixteen lanes.
#ifndef BRUSHFIRE_KERNEL
#error "BRUSHFIRE_KERNEL: which header?"
#endif

#define BRUSHFIRE_TARGET portable
#define BRUSHFIRE_REGISTER 16
#include BRUSHFIRE_KERNEL
#undef BRUSHFIRE_TARGET
#undef BRUSHFIRE_REGISTER

#ifdef BRUSHFIRE_HAS_AVX2_TARGET
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,bmi,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,popcnt")
#endif
#define BRUSHFIRE_TARGET avx2
#define BRUSHFIRE_REGISTER 32
#define BRUSHFIRE_TARGET_IS_AVX2
#include BRUSHFIRE_KERNEL
#undef BRUSHFIRE_TARGET_IS_AVX2
#undef BRUSHFIRE_REGISTER
#undef BRUSHFIRE_TARGET
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

#if defined(BRUSHFIRE_HAS_AVX2_TARGET) && defined(BRUSHFIRE_KERNEL_IS_WIDE)
#if defined(__clang__) && __clang_major__ >= 18 && __clang_major__ <= 20
// These count registers of 512 bits as a feature of its own, which builds for a named processor may have taken away.
#pragma clang attribute push(__attribute__((target("avx2,bmi,popcnt,avx512f,avx512dq,avx512bw,avx512vl,evex512"))), \
                             apply_to = function)
#elif defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,bmi,popcnt,avx512f,avx512dq,avx512bw,avx512vl"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,popcnt,avx512f,avx512dq,avx512bw,avx512vl")
#endif
#define BRUSHFIRE_TARGET avx512
#define BRUSHFIRE_REGISTER 64
#define BRUSHFIRE_TARGET_IS_AVX512
#include BRUSHFIRE_KERNEL
#undef BRUSHFIRE_TARGET_IS_AVX512
#undef BRUSHFIRE_REGISTER
#undef BRUSHFIRE_TARGET
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

#undef BRUSHFIRE_KERNEL
#undef BRUSHFIRE_KERNEL_IS_WIDE
