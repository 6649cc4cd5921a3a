// Numbers side by side, worked on at once: Lanes<T, N>, and Mask<bytes, N> for what is true of each of them.
//
// Lanes are written for once and compiled for each target (targets.h): a kernel says
//
//     namespace brushfire::my_room::BRUSHFIRE_TARGET {
//     using namespace lanes::BRUSHFIRE_TARGET;
//     template <class V>  // Lanes<float, 8>, Lanes<double, 4>, or just double
//     BRUSHFIRE_INLINE V hypotenuse(V a, V b) { return square_root(a * a + b * b); }
//
// T is float, double or std::uint32_t; N is 2, 4, 8 or 16, whatever the registers hold: wider lanes take several. Every
// operation is that of IEEE 754 on each lane by itself, so all targets give the same bits, which are also those of the
// same kernel on single numbers (for these there are select(), square_root() and so on, too). To be used in kernels
// only, in functions, not in lambdas that are handed on; and passed by value.
//
// | what | |
// |---|---|
// | V(x) | all lanes the same; numbers turn into lanes by themselves: 1 / v |
// | load<V>(from), store(to, v) | from anywhere, to anywhere |
// | load_first<V>(from, count) | the first ones; 0 in the others, whose memory is not touched |
// | lane_numbers<V>(), first_lanes<V>(count) | 0, 1, 2 ...; the mask of those below count |
// | gather<V>(from, index) | from[index[k]] |
// | gather_pairs(from, index, a, b) | from[2 * index[k]], from[2 * index[k] + 1] |
// | load_fours(from, a, b, c, d) | from[4 * k], from[4 * k + 1], from[4 * k + 2], from[4 * k + 3] |
// | load_points(from, x, y, z) | three numbers from from[k] on |
// | + - * / - < <= == | on lanes; & bit-wise, << >> of whole numbers |
// | & \| ^ ~, without, bits, any, all | on masks; without(a, b): b and not a; bit k: lane k |
// | share_bits(a, b) | whole numbers: where a & b is not 0 |
// | sum | of all lanes, halves on halves |
// | select(mask, a, b) | lane by lane |
// | lesser(a, b), greater(a, b) | a < b ? a : b, a > b ? a : b: b where one is not a number |
// | square_root, magnitude | |
// | permuted(v, Permutation<V>(index)) | lane k: lane index[k] % N of v |
// | converted<T>(v), mask_cast<T>(mask) | to other numbers, rounded; to the mask for those |
// | store_packed(to, set, v) | the lanes of a set of bits, one after the other; writes N places |
// | load_bytes<V>(from), store_bytes(to, v) | whole numbers as bytes |
// | load_words<V>(from), store_words(to, v) | whole numbers as words of 16 bits |
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/loop_vector.h>
#include <brushfire/core/detail/targets.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#if !defined(BRUSHFIRE_HAS_VECTORS)
// Without intrinsics, too.
#elif defined(__x86_64__)
#include <immintrin.h>
#elif defined(__ARM_NEON) && defined(__aarch64__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace brushfire::lanes {

// For each set of eight lanes, their numbers: one after the other, from the lowest byte on.
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

}  // namespace brushfire::lanes

#define BRUSHFIRE_KERNEL_IS_WIDE
#define BRUSHFIRE_KERNEL <brushfire/core/detail/registers_kernel.h>
#include <brushfire/core/detail/each_target.h>
#define BRUSHFIRE_KERNEL_IS_WIDE
#define BRUSHFIRE_KERNEL <brushfire/core/detail/lanes_kernel.h>
#include <brushfire/core/detail/each_target.h>
#define BRUSHFIRE_KERNEL_IS_WIDE
#define BRUSHFIRE_KERNEL <brushfire/core/detail/memory_kernel.h>
#include <brushfire/core/detail/each_target.h>
