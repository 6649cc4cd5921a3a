// Lanes from memory, to memory and past each other.
namespace brushfire::lanes::BRUSHFIRE_TARGET {

using Numbers8 = Lanes<std::uint32_t, 8>;

template <class V>
BRUSHFIRE_INLINE V load(const typename V::Number* from) {
  if constexpr (kFits<typename V::Number, V::kCount>) {
    using InMemory = typename RegisterOf<typename V::Number, V::kCount>::InMemory;
    return V(*reinterpret_cast<const InMemory*>(from));
  } else {
    return {load<typename V::Half>(from), load<typename V::Half>(from + V::kCount / 2)};
  }
}
template <class T, int N>
BRUSHFIRE_INLINE void store(T* to, Lanes<T, N> a) {
  if constexpr (kFits<T, N>) {
    *reinterpret_cast<typename RegisterOf<T, N>::InMemory*>(to) = a.v;
  } else {
    store(to, a.low);
    store(to + N / 2, a.high);
  }
}

// 0, 1, 2, ...
template <class V>
BRUSHFIRE_INLINE V lane_numbers() {
  alignas(BRUSHFIRE_REGISTER) typename V::Number number[V::kCount];
  for (int k = 0; k < V::kCount; ++k) number[k] = static_cast<typename V::Number>(k);
  return load<V>(number);
}
// The mask of the lanes below `count`.
template <int N>
BRUSHFIRE_INLINE Mask<4, N> first_lanes(std::uint32_t count) {
  return lane_numbers<Lanes<std::int32_t, N>>() < Lanes<std::int32_t, N>(static_cast<std::int32_t>(count));
}
// The first ones; 0 in the others, whose memory is not touched.
template <class V>
BRUSHFIRE_INLINE V load_first(const typename V::Number* from, std::uint32_t count) {
  typename V::Number item[V::kCount];
  for (std::uint32_t k = 0; k < V::kCount; ++k) item[k] = k < count ? from[k] : typename V::Number(0);
  return load<V>(item);
}

// from[index[k]]
template <class V, class T, std::size_t... kLane>
BRUSHFIRE_INLINE V gather(const T* from, const std::uint32_t* index, std::index_sequence<kLane...>) {
  return V(Register<T, V::kCount>{from[index[kLane]]...});
}
template <class V, class T>
BRUSHFIRE_INLINE V gather(const T* from, const std::uint32_t* index) {
  if constexpr (kFits<T, V::kCount>) {
    return gather<V>(from, index, std::make_index_sequence<V::kCount>());
  } else {
    using Half = typename V::Half;
    return {gather<Half>(from, index), gather<Half>(from, index + V::kCount / 2)};
  }
}

// The first, second, third and fourth of each four that follow each other.
template <class T>
BRUSHFIRE_INLINE void load_fours(const T* from, Lanes<T, 4>& a, Lanes<T, 4>& b, Lanes<T, 4>& c, Lanes<T, 4>& d) {
  using V = Lanes<T, 4>;
  if constexpr (kFits<T, 4>) {
    const auto p = load<V>(from).v, q = load<V>(from + 4).v, r = load<V>(from + 8).v, s = load<V>(from + 12).v;
    const auto low_pq = shuffled<0, 4, 1, 5>(p, q), high_pq = shuffled<2, 6, 3, 7>(p, q);
    const auto low_rs = shuffled<0, 4, 1, 5>(r, s), high_rs = shuffled<2, 6, 3, 7>(r, s);
    a = V(shuffled<0, 1, 4, 5>(low_pq, low_rs)), b = V(shuffled<2, 3, 6, 7>(low_pq, low_rs));
    c = V(shuffled<0, 1, 4, 5>(high_pq, high_rs)), d = V(shuffled<2, 3, 6, 7>(high_pq, high_rs));
  } else {
    T by_place[4][4];
    for (int k = 0; k < 16; ++k) by_place[k % 4][k / 4] = from[k];
    a = load<V>(by_place[0]), b = load<V>(by_place[1]), c = load<V>(by_place[2]), d = load<V>(by_place[3]);
  }
}
template <class T, int N>
BRUSHFIRE_INLINE void load_fours(const T* from, Lanes<T, N>& a, Lanes<T, N>& b, Lanes<T, N>& c, Lanes<T, N>& d) {
  Lanes<T, N / 2> a0, b0, c0, d0, a1, b1, c1, d1;
  load_fours(from, a0, b0, c0, d0);
  load_fours(from + 2 * N, a1, b1, c1, d1);
  a = joined(a0, a1), b = joined(b0, b1), c = joined(c0, c1), d = joined(d0, d1);
}

// Numbers that lie side by side, or three of them.
template <class V>
struct Pairs {
  V first, second;
};
// from[2 * index[k]] and from[2 * index[k] + 1].
template <class V>
BRUSHFIRE_INLINE Pairs<V> gather_pairs(const typename V::Number* from, const std::uint32_t* index) {
  std::uint32_t twice[V::kCount];
  for (int k = 0; k < V::kCount; ++k) twice[k] = 2 * index[k];
  return {gather<V>(from, twice), gather<V>(from + 1, twice)};
}
// from[3 * index[k]] and the two that follow.
template <class V>
BRUSHFIRE_INLINE Vector3<V> gather_points(const typename V::Number* from, const std::uint32_t* index) {
  std::uint32_t thrice[V::kCount];
  for (int k = 0; k < V::kCount; ++k) thrice[k] = 3 * index[k];
  return {gather<V>(from, thrice), gather<V>(from + 1, thrice), gather<V>(from + 2, thrice)};
}

// An index, made once for several uses by permuted().
template <std::size_t kBytes, int N>
struct Permutation {
  std::uint32_t lane[N];
  BRUSHFIRE_INLINE explicit Permutation(Lanes<std::uint32_t, N> index) { store(lane, index & (N - 1)); }
};
// Lane k of the result: lane index[k] % N of a.
template <class T, int N>
BRUSHFIRE_INLINE Lanes<T, N> permuted(Lanes<T, N> a, const Permutation<sizeof(T), N>& index) {
  T item[N];
  store(item, a);
  return gather<Lanes<T, N>>(item, index.lane);
}
template <std::size_t kBytes, int N>
BRUSHFIRE_INLINE Mask<kBytes, N> permuted(Mask<kBytes, N> mask, const Permutation<kBytes, N>& index) {
  return {permuted(mask.v, index)};
}

// The lanes of a set, one after the other. Writes N places.
template <class T, int N>
BRUSHFIRE_INLINE void store_packed(T* to, std::uint32_t set, Lanes<T, N> a) {
  T item[N];
  store(item, a);
  for (int k = 0; k < N; ++k) {
    *to = item[k];
    to += set >> k & 1u;
  }
}

// Whole numbers as bytes.
template <class V>
BRUSHFIRE_INLINE V load_bytes(const std::uint8_t* from) {
  std::uint32_t item[V::kCount];
  for (int k = 0; k < V::kCount; ++k) item[k] = from[k];
  return load<V>(item);
}
template <int N>
BRUSHFIRE_INLINE void store_bytes(std::uint8_t* to, Lanes<std::uint32_t, N> a) {
  std::uint32_t item[N];
  store(item, a);
  for (int k = 0; k < N; ++k) to[k] = static_cast<std::uint8_t>(item[k]);
}

// Whole numbers as words of 16 bits.
template <class V>
BRUSHFIRE_INLINE V load_words(const std::uint16_t* from) {
  if constexpr (kFits<std::uint32_t, V::kCount>) {
    return V(words_in<V::kCount>(from));
  } else {
    return {load_words<typename V::Half>(from), load_words<typename V::Half>(from + V::kCount / 2)};
  }
}
template <int N>
BRUSHFIRE_INLINE void store_words(std::uint16_t* to, Lanes<std::uint32_t, N> a) {
  if constexpr (kFits<std::uint32_t, N>) {
    words_out(to, a.v);
  } else {
    store_words(to, a.low), store_words(to + N / 2, a.high);
  }
}

#ifdef BRUSHFIRE_TARGET_IS_AVX2

// What intrinsics take and give.
using Integers = Register<long long, 4>;
template <class V>
BRUSHFIRE_INLINE Integers integers(V a) {
  return same_bits<Integers>(a.v);
}
BRUSHFIRE_INLINE Numbers8 numbers(Integers a) { return Numbers8(same_bits<Register<std::uint32_t, 8>>(a)); }

template <>
BRUSHFIRE_INLINE Numbers8 load_first<Numbers8>(const std::uint32_t* from, std::uint32_t count) {
  return numbers(_mm256_maskload_epi32(reinterpret_cast<const int*>(from), integers(first_lanes<8>(count).v)));
}

BRUSHFIRE_INLINE Float4 two_pairs(const float* from, std::uint32_t i, std::uint32_t j) {
  const __m128d low = _mm_load_sd(reinterpret_cast<const double*>(from + 2 * std::size_t{i}));
  return _mm_castpd_ps(_mm_loadh_pd(low, reinterpret_cast<const double*>(from + 2 * std::size_t{j})));
}
template <>
BRUSHFIRE_INLINE Pairs<Lanes<float, 8>> gather_pairs<Lanes<float, 8>>(const float* from, const std::uint32_t* index) {
  // Pairs 0 1 4 5 and 2 3 6 7, so that the halves of the shuffles below come out in order.
  const Float8 outer = _mm256_set_m128(two_pairs(from, index[4], index[5]), two_pairs(from, index[0], index[1]));
  const Float8 inner = _mm256_set_m128(two_pairs(from, index[6], index[7]), two_pairs(from, index[2], index[3]));
  return {Lanes<float, 8>(_mm256_shuffle_ps(outer, inner, 0x88)),
          Lanes<float, 8>(_mm256_shuffle_ps(outer, inner, 0xdd))};
}
BRUSHFIRE_INLINE Double4 two_pairs(const double* from, std::uint32_t i, std::uint32_t j) {
  return _mm256_set_m128d(_mm_loadu_pd(from + 2 * std::size_t{j}), _mm_loadu_pd(from + 2 * std::size_t{i}));
}
template <>
BRUSHFIRE_INLINE Pairs<Lanes<double, 4>> gather_pairs<Lanes<double, 4>>(const double* from,
                                                                        const std::uint32_t* index) {
  const Double4 p02 = two_pairs(from, index[0], index[2]), p13 = two_pairs(from, index[1], index[3]);
  return {Lanes<double, 4>(_mm256_unpacklo_pd(p02, p13)), Lanes<double, 4>(_mm256_unpackhi_pd(p02, p13))};
}
template <>
BRUSHFIRE_INLINE Pairs<Lanes<double, 8>> gather_pairs<Lanes<double, 8>>(const double* from,
                                                                        const std::uint32_t* index) {
  const auto low = gather_pairs<Lanes<double, 4>>(from, index), high = gather_pairs<Lanes<double, 4>>(from, index + 4);
  return {{low.first, high.first}, {low.second, high.second}};
}

template <>
BRUSHFIRE_INLINE Vector3<Lanes<double, 4>> gather_points<Lanes<double, 4>>(const double* from,
                                                                           const std::uint32_t* index) {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  Double4 row[4];
  for (int k = 0; k < 4; ++k) row[k] = _mm256_maskload_pd(from + 3 * std::size_t{index[k]}, three);
  const Double4 x01 = _mm256_unpacklo_pd(row[0], row[1]), y01 = _mm256_unpackhi_pd(row[0], row[1]);
  const Double4 x23 = _mm256_unpacklo_pd(row[2], row[3]), y23 = _mm256_unpackhi_pd(row[2], row[3]);
  return {Lanes<double, 4>(_mm256_permute2f128_pd(x01, x23, 0x20)),
          Lanes<double, 4>(_mm256_permute2f128_pd(y01, y23, 0x20)),
          Lanes<double, 4>(_mm256_permute2f128_pd(x01, x23, 0x31))};
}
template <>
BRUSHFIRE_INLINE Vector3<Lanes<double, 8>> gather_points<Lanes<double, 8>>(const double* from,
                                                                           const std::uint32_t* index) {
  const auto low = gather_points<Lanes<double, 4>>(from, index);
  const auto high = gather_points<Lanes<double, 4>>(from, index + 4);
  return {{low.x, high.x}, {low.y, high.y}, {low.z, high.z}};
}

template <>
struct Permutation<4, 8> {
  Numbers8 lane;
  BRUSHFIRE_INLINE explicit Permutation(Numbers8 index) : lane(index) {}
};
template <class T>
BRUSHFIRE_INLINE Lanes<T, 8> permuted(Lanes<T, 8> a, const Permutation<4, 8>& index) {
  const Float8 moved = _mm256_permutevar8x32_ps(same_bits<Float8>(a.v), integers(index.lane));
  return Lanes<T, 8>(same_bits<Register<T, 8>>(moved));
}

// For each half, where its numbers are: 2i and 2i + 1, the halves of number i, whose bit 3 says in which register.
template <>
struct Permutation<8, 8> {
  Integers low, high;
  BRUSHFIRE_INLINE explicit Permutation(Numbers8 index) {
    const Numbers8 lane = index & 7;
    low = pairs(_mm256_cvtepu32_epi64(_mm256_castsi256_si128(integers(lane))));
    high = pairs(_mm256_cvtepu32_epi64(_mm256_extracti128_si256(integers(lane), 1)));
  }

 private:
  BRUSHFIRE_INLINE static Integers pairs(Integers index) {
    const Integers twice = index << 1;
    return twice | twice << 32 | Integers{1ll << 32, 1ll << 32, 1ll << 32, 1ll << 32};
  }
};
template <class T>
BRUSHFIRE_INLINE Lanes<T, 4> permuted_half(Lanes<T, 8> a, Integers index) {
  const Float8 from_low = _mm256_permutevar8x32_ps(same_bits<Float8>(a.low.v), index);
  const Float8 from_high = _mm256_permutevar8x32_ps(same_bits<Float8>(a.high.v), index);
  const Float8 which = same_bits<Float8>(Integers(_mm256_slli_epi32(index, 31 - 3)));
  return Lanes<T, 4>(same_bits<Register<T, 4>>(Float8(_mm256_blendv_ps(from_low, from_high, which))));
}
template <class T>
BRUSHFIRE_INLINE Lanes<T, 8> permuted(Lanes<T, 8> a, const Permutation<8, 8>& index) {
  return {permuted_half(a, index.low), permuted_half(a, index.high)};
}

template <class T>
BRUSHFIRE_INLINE void store_packed(T* to, std::uint32_t set, Lanes<T, 8> a) {
  const __m128i lanes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&kPacking[set]));
  store(to, permuted(a, Permutation<sizeof(T), 8>(numbers(_mm256_cvtepu8_epi32(lanes)))));
}

template <>
BRUSHFIRE_INLINE Numbers8 load_bytes<Numbers8>(const std::uint8_t* from) {
  return numbers(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
}
BRUSHFIRE_INLINE void store_bytes(std::uint8_t* to, Numbers8 a) {
  const __m128i words = _mm_packus_epi32(_mm256_castsi256_si128(integers(a)), _mm256_extracti128_si256(integers(a), 1));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_packus_epi16(words, words));
}

#elif defined(BRUSHFIRE_HAS_VECTORS) && defined(__wasm_simd128__)

// For each half of the result, where its bytes are: in the lower half, and in the upper one. A place that a half does
// not have, from 16 on, gives 0.
template <>
struct Permutation<4, 8> {
  v128_t from_low[2], from_high[2];
  BRUSHFIRE_INLINE explicit Permutation(Numbers8 index) : Permutation(index.low, index.high) {}

 private:
  using Half = Numbers8::Half;
  BRUSHFIRE_INLINE Permutation(Half low, Half high) : from_low{bytes(low), bytes(high)} {
    for (int k = 0; k < 2; ++k) from_high[k] = wasm_i8x16_sub(from_low[k], wasm_i8x16_const_splat(16));
  }
  BRUSHFIRE_INLINE static v128_t bytes(Half index) {
    return same_bits<v128_t>(((index & 7) * Half(0x04040404) + Half(0x03020100)).v);
  }
};
template <class T>
BRUSHFIRE_INLINE Lanes<T, 4> permuted_half(Lanes<T, 8> a, const Permutation<4, 8>& index, int half) {
  const v128_t from_low = wasm_i8x16_swizzle(same_bits<v128_t>(a.low.v), index.from_low[half]);
  const v128_t from_high = wasm_i8x16_swizzle(same_bits<v128_t>(a.high.v), index.from_high[half]);
  return Lanes<T, 4>(same_bits<Register<T, 4>>(from_low | from_high));
}
template <class T>
BRUSHFIRE_INLINE Lanes<T, 8> permuted(Lanes<T, 8> a, const Permutation<4, 8>& index) {
  return {permuted_half(a, index, 0), permuted_half(a, index, 1)};
}

BRUSHFIRE_INLINE Register<float, 4> two_pairs(const float* from, std::uint32_t i, std::uint32_t j) {
  return same_bits<Register<float, 4>>(wasm_v128_load64_lane(from + 2 * j, wasm_v128_load64_zero(from + 2 * i), 1));
}
template <>
BRUSHFIRE_INLINE Pairs<Lanes<float, 8>> gather_pairs<Lanes<float, 8>>(const float* from, const std::uint32_t* index) {
  using Half = Lanes<float, 4>;
  const auto p01 = two_pairs(from, index[0], index[1]), p23 = two_pairs(from, index[2], index[3]);
  const auto p45 = two_pairs(from, index[4], index[5]), p67 = two_pairs(from, index[6], index[7]);
  return {{Half(shuffled<0, 2, 4, 6>(p01, p23)), Half(shuffled<0, 2, 4, 6>(p45, p67))},
          {Half(shuffled<1, 3, 5, 7>(p01, p23)), Half(shuffled<1, 3, 5, 7>(p45, p67))}};
}

template <>
BRUSHFIRE_INLINE Numbers8 load_bytes<Numbers8>(const std::uint8_t* from) {
  using Numbers4 = Register<std::uint32_t, 4>;
  const v128_t words = wasm_u16x8_load8x8(from);
  return {Numbers8::Half(same_bits<Numbers4>(wasm_u32x4_extend_low_u16x8(words))),
          Numbers8::Half(same_bits<Numbers4>(wasm_u32x4_extend_high_u16x8(words)))};
}

template <class T>
BRUSHFIRE_INLINE std::enable_if_t<sizeof(T) == 4> store_packed(T* to, std::uint32_t set, Lanes<T, 8> a) {
  const auto* const lanes = reinterpret_cast<const std::uint8_t*>(&kPacking[set]);  // the lowest byte comes first
  store(to, permuted(a, Permutation<4, 8>(load_bytes<Numbers8>(lanes))));
}

#endif

}  // namespace brushfire::lanes::BRUSHFIRE_TARGET
