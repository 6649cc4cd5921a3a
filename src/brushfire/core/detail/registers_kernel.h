// One register, what lanes are made of: a vector of the compiler, whose arithmetic it knows by itself. Here is what it
// does not know, for any machine, and better for some.
namespace brushfire::lanes::BRUSHFIRE_TARGET {

#ifdef BRUSHFIRE_HAS_VECTORS
template <class T, int N>
struct RegisterOf {
  typedef T Type __attribute__((vector_size(N * sizeof(T))));  // NOLINT(modernize-use-using): attributes of a type
  typedef T InMemory __attribute__((vector_size(N * sizeof(T)), aligned(alignof(T)), may_alias));  // NOLINT: anywhere
};
#else
template <class T, int N>
struct RegisterOf {
  using Type = LoopVector<T, N>;
  using InMemory = Type;
};
#endif
template <class T, int N>
using Register = typename RegisterOf<T, N>::Type;

// Whole numbers as wide as T: what comparisons of T give, all bits or none.
template <std::size_t kBytes>
using MaskNumber = std::conditional_t<kBytes == 4, std::int32_t, std::int64_t>;

template <class R>
using NumberOf = std::remove_cv_t<std::remove_reference_t<decltype(std::declval<R>()[0])>>;
template <class R>
inline constexpr int kCountOf = static_cast<int>(sizeof(R) / sizeof(NumberOf<R>));

template <class To, class From>
BRUSHFIRE_INLINE To same_bits(From from) {
  return __builtin_bit_cast(To, from);
}

// a ? b : c, bit by bit.
template <class M, class R>
BRUSHFIRE_INLINE R selected(M mask, R yes, R no) {
  return same_bits<R>((mask & same_bits<M>(yes)) | (~mask & same_bits<M>(no)));
}
template <class R>
BRUSHFIRE_INLINE R lesser_of(R a, R b) {
  return selected(a < b, a, b);
}
template <class R>
BRUSHFIRE_INLINE R greater_of(R a, R b) {
  return selected(a > b, a, b);
}
template <class R>
BRUSHFIRE_INLINE R root_of(R a) {
  R root{};
  for (int k = 0; k < kCountOf<R>; ++k) root[k] = std::sqrt(a[k]);
  return root;
}
template <class M>
BRUSHFIRE_INLINE std::uint32_t bits_of(M mask) {
  std::uint32_t bits = 0;
  for (int k = 0; k < kCountOf<M>; ++k) bits |= (mask[k] != 0 ? 1u : 0u) << k;
  return bits;
}

// Comparisons: registers of all bits or none.
template <class R>
using ComparedOf = Register<MaskNumber<sizeof(NumberOf<R>)>, kCountOf<R>>;
template <class R>
BRUSHFIRE_INLINE ComparedOf<R> less_of(R a, R b) {
  return same_bits<ComparedOf<R>>(a < b);
}
template <class R>
BRUSHFIRE_INLINE ComparedOf<R> not_greater_of(R a, R b) {
  return same_bits<ComparedOf<R>>(a <= b);
}
template <class R>
BRUSHFIRE_INLINE ComparedOf<R> equal_of(R a, R b) {
  return same_bits<ComparedOf<R>>(a == b);
}
// Whether whole numbers have a bit in common.
template <class R>
BRUSHFIRE_INLINE ComparedOf<R> share_bits_of(R a, R b) {
  return ~same_bits<ComparedOf<R>>((a & b) == R{});
}

// The numbers as those of another type.
template <class To, class R>
BRUSHFIRE_INLINE Register<To, kCountOf<R>> converted_of(R a) {
#ifdef BRUSHFIRE_HAS_VECTORS
  return __builtin_convertvector(a, Register<To, kCountOf<R>>);
#else
  Register<To, kCountOf<R>> result{};
  for (int k = 0; k < kCountOf<R>; ++k) result[k] = static_cast<To>(a[k]);
  return result;
#endif
}
// Whole numbers from words of 16 bits, and to them.
template <int N>
BRUSHFIRE_INLINE Register<std::uint32_t, N> words_in(const std::uint16_t* from) {
  Register<std::uint32_t, N> result{};
  for (int k = 0; k < N; ++k) result[k] = from[k];
  return result;
}
template <class R>
BRUSHFIRE_INLINE void words_out(std::uint16_t* to, R a) {
  for (int k = 0; k < kCountOf<R>; ++k) to[k] = static_cast<std::uint16_t>(a[k]);
}
// The lanes with these numbers, counted over two registers.
template <int... kLane, class R>
BRUSHFIRE_INLINE Register<NumberOf<R>, static_cast<int>(sizeof...(kLane))> shuffled(R a, R b) {
#if defined(BRUSHFIRE_HAS_VECTORS) && (defined(__clang__) || __GNUC__ >= 12)
  return __builtin_shufflevector(a, b, kLane...);
#else
  constexpr int kCount = kCountOf<R>;
  return Register<NumberOf<R>, static_cast<int>(sizeof...(kLane))>{
      (kLane < kCount ? a[kLane % kCount] : b[kLane % kCount])...};
#endif
}

#if !defined(BRUSHFIRE_HAS_VECTORS)
// All in loops.

#elif defined(__x86_64__)

using Float4 = Register<float, 4>;
using Double2 = Register<double, 2>;
using Mask4 = Register<std::int32_t, 4>;
using WideMask2 = Register<std::int64_t, 2>;
BRUSHFIRE_INLINE Float4 root_of(Float4 a) { return _mm_sqrt_ps(a); }
BRUSHFIRE_INLINE Double2 root_of(Double2 a) { return _mm_sqrt_pd(a); }
BRUSHFIRE_INLINE Float4 lesser_of(Float4 a, Float4 b) { return _mm_min_ps(a, b); }
BRUSHFIRE_INLINE Double2 lesser_of(Double2 a, Double2 b) { return _mm_min_pd(a, b); }
BRUSHFIRE_INLINE Float4 greater_of(Float4 a, Float4 b) { return _mm_max_ps(a, b); }
BRUSHFIRE_INLINE Double2 greater_of(Double2 a, Double2 b) { return _mm_max_pd(a, b); }
BRUSHFIRE_INLINE std::uint32_t bits_of(Mask4 m) {
  return static_cast<std::uint32_t>(_mm_movemask_ps(same_bits<Float4>(m)));
}
BRUSHFIRE_INLINE std::uint32_t bits_of(WideMask2 m) {
  return static_cast<std::uint32_t>(_mm_movemask_pd(same_bits<Double2>(m)));
}

#elif defined(__ARM_NEON) && defined(__aarch64__)

BRUSHFIRE_INLINE Register<float, 4> root_of(Register<float, 4> a) { return vsqrtq_f32(a); }
BRUSHFIRE_INLINE Register<double, 2> root_of(Register<double, 2> a) { return vsqrtq_f64(a); }

#elif defined(__wasm_simd128__)

BRUSHFIRE_INLINE Register<float, 4> root_of(Register<float, 4> a) {
  return same_bits<Register<float, 4>>(wasm_f32x4_sqrt(same_bits<Register<std::int32_t, 4>>(a)));
}
BRUSHFIRE_INLINE Register<double, 2> root_of(Register<double, 2> a) {
  return same_bits<Register<double, 2>>(wasm_f64x2_sqrt(same_bits<Register<std::int32_t, 4>>(a)));
}
// Of two equal numbers, and where one is none, the second: pmin(a, b) is b < a ? b : a.
BRUSHFIRE_INLINE Register<float, 4> lesser_of(Register<float, 4> a, Register<float, 4> b) {
  return same_bits<Register<float, 4>>(wasm_f32x4_pmin(same_bits<v128_t>(b), same_bits<v128_t>(a)));
}
BRUSHFIRE_INLINE Register<double, 2> lesser_of(Register<double, 2> a, Register<double, 2> b) {
  return same_bits<Register<double, 2>>(wasm_f64x2_pmin(same_bits<v128_t>(b), same_bits<v128_t>(a)));
}
BRUSHFIRE_INLINE Register<float, 4> greater_of(Register<float, 4> a, Register<float, 4> b) {
  return same_bits<Register<float, 4>>(wasm_f32x4_pmax(same_bits<v128_t>(b), same_bits<v128_t>(a)));
}
BRUSHFIRE_INLINE Register<double, 2> greater_of(Register<double, 2> a, Register<double, 2> b) {
  return same_bits<Register<double, 2>>(wasm_f64x2_pmax(same_bits<v128_t>(b), same_bits<v128_t>(a)));
}
BRUSHFIRE_INLINE std::uint32_t bits_of(Register<std::int32_t, 4> m) { return wasm_i32x4_bitmask(m); }
BRUSHFIRE_INLINE std::uint32_t bits_of(Register<std::int64_t, 2> m) {
  return wasm_i64x2_bitmask(same_bits<Register<std::int32_t, 4>>(m));
}

#endif

#if defined(BRUSHFIRE_TARGET_IS_AVX2) || defined(BRUSHFIRE_TARGET_IS_AVX512)

using Float8 = Register<float, 8>;
using Double4 = Register<double, 4>;
using Mask8 = Register<std::int32_t, 8>;
using WideMask4 = Register<std::int64_t, 4>;
BRUSHFIRE_INLINE Float8 root_of(Float8 a) { return _mm256_sqrt_ps(a); }
BRUSHFIRE_INLINE Double4 root_of(Double4 a) { return _mm256_sqrt_pd(a); }
BRUSHFIRE_INLINE Float8 lesser_of(Float8 a, Float8 b) { return _mm256_min_ps(a, b); }
BRUSHFIRE_INLINE Double4 lesser_of(Double4 a, Double4 b) { return _mm256_min_pd(a, b); }
BRUSHFIRE_INLINE Float8 greater_of(Float8 a, Float8 b) { return _mm256_max_ps(a, b); }
BRUSHFIRE_INLINE Double4 greater_of(Double4 a, Double4 b) { return _mm256_max_pd(a, b); }
BRUSHFIRE_INLINE std::uint32_t bits_of(Mask8 m) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(same_bits<Float8>(m)));
}
BRUSHFIRE_INLINE std::uint32_t bits_of(WideMask4 m) {
  return static_cast<std::uint32_t>(_mm256_movemask_pd(same_bits<Double4>(m)));
}
BRUSHFIRE_INLINE Float8 selected(Mask8 m, Float8 yes, Float8 no) {
  return _mm256_blendv_ps(no, yes, same_bits<Float8>(m));
}
BRUSHFIRE_INLINE Double4 selected(WideMask4 m, Double4 yes, Double4 no) {
  return _mm256_blendv_pd(no, yes, same_bits<Double4>(m));
}
template <>  // which GCC does in four steps
BRUSHFIRE_INLINE WideMask4 converted_of<std::int64_t, Mask4>(Mask4 a) {
  return same_bits<WideMask4>(Register<long long, 4>(_mm256_cvtepi32_epi64(same_bits<Register<long long, 2>>(a))));
}
template <>
BRUSHFIRE_INLINE Register<std::uint32_t, 8> words_in<8>(const std::uint16_t* from) {
  const __m128i words = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
  return same_bits<Register<std::uint32_t, 8>>(Register<long long, 4>(_mm256_cvtepu16_epi32(words)));
}
BRUSHFIRE_INLINE void words_out(std::uint16_t* to, Register<std::uint32_t, 8> a) {
  const auto both = same_bits<Register<long long, 4>>(a);
  const __m128i words = _mm_packus_epi32(_mm256_castsi256_si128(both), _mm256_extracti128_si256(both, 1));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), words);
}
template <class R>  // whole numbers
BRUSHFIRE_INLINE R selected(Mask8 m, R yes, R no) {
  return same_bits<R>(selected(m, same_bits<Float8>(yes), same_bits<Float8>(no)));
}

#endif

#ifdef BRUSHFIRE_TARGET_IS_AVX512

using Float16 = Register<float, 16>;
using Double8 = Register<double, 8>;
// The plain forms are of something undefined in GCC 12's header, of which it warns.
inline constexpr __mmask16 kAll16 = 0xffff;
inline constexpr __mmask8 kAll8 = 0xff;
BRUSHFIRE_INLINE Float16 root_of(Float16 a) { return _mm512_maskz_sqrt_ps(kAll16, a); }
BRUSHFIRE_INLINE Double8 root_of(Double8 a) { return _mm512_maskz_sqrt_pd(kAll8, a); }
BRUSHFIRE_INLINE Float16 lesser_of(Float16 a, Float16 b) { return _mm512_maskz_min_ps(kAll16, a, b); }
BRUSHFIRE_INLINE Double8 lesser_of(Double8 a, Double8 b) { return _mm512_maskz_min_pd(kAll8, a, b); }
BRUSHFIRE_INLINE Float16 greater_of(Float16 a, Float16 b) { return _mm512_maskz_max_ps(kAll16, a, b); }
BRUSHFIRE_INLINE Double8 greater_of(Double8 a, Double8 b) { return _mm512_maskz_max_pd(kAll8, a, b); }
template <class R>
BRUSHFIRE_INLINE __m512i integers512(R a) {
  return same_bits<__m512i>(a);
}
// Comparisons of sixteen numbers give bits in a register of their own.
using Words16 = Register<std::uint32_t, 16>;
using Mask16 = Register<std::int32_t, 16>;
BRUSHFIRE_INLINE __mmask16 less_of(Float16 a, Float16 b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
BRUSHFIRE_INLINE __mmask16 not_greater_of(Float16 a, Float16 b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
BRUSHFIRE_INLINE __mmask16 equal_of(Float16 a, Float16 b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
BRUSHFIRE_INLINE __mmask16 mask_of(Mask16 all_bits_or_none) {
  return _mm512_movepi32_mask(integers512(all_bits_or_none));
}
BRUSHFIRE_INLINE __mmask16 less_of(Words16 a, Words16 b) { return mask_of(a < b); }
BRUSHFIRE_INLINE __mmask16 less_of(Mask16 a, Mask16 b) { return mask_of(a < b); }
BRUSHFIRE_INLINE __mmask16 not_greater_of(Words16 a, Words16 b) { return mask_of(a <= b); }
BRUSHFIRE_INLINE __mmask16 not_greater_of(Mask16 a, Mask16 b) { return mask_of(a <= b); }
BRUSHFIRE_INLINE __mmask16 equal_of(Words16 a, Words16 b) { return mask_of(a == b); }
BRUSHFIRE_INLINE __mmask16 equal_of(Mask16 a, Mask16 b) { return mask_of(a == b); }
BRUSHFIRE_INLINE __mmask16 share_bits_of(Words16 a, Words16 b) {
  return _mm512_test_epi32_mask(integers512(a), integers512(b));
}
template <>
BRUSHFIRE_INLINE Words16 words_in<16>(const std::uint16_t* from) {
  const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  return same_bits<Words16>(_mm512_maskz_cvtepu16_epi32(kAll16, words));
}
BRUSHFIRE_INLINE void words_out(std::uint16_t* to, Words16 a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_maskz_cvtepi32_epi16(kAll16, integers512(a)));
}
BRUSHFIRE_INLINE std::uint32_t bits_of(__mmask16 m) { return m; }
template <class R>
BRUSHFIRE_INLINE R selected(__mmask16 m, R yes, R no) {
  return same_bits<R>(Float16(_mm512_mask_blend_ps(m, same_bits<Float16>(no), same_bits<Float16>(yes))));
}

#endif

}  // namespace brushfire::lanes::BRUSHFIRE_TARGET
