// The same offers as offers.h makes, in registers: the same operations in the same order, so the same bits.
#pragma once

#include <brushfire/solvers/fast_marching/detail/double8.h>
#include <brushfire/solvers/fast_marching/detail/float8.h>
#include <brushfire/solvers/fast_marching/detail/offers.h>

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

#include <bit>

namespace brushfire::fast_marching {

// The front over each of eight edges, from a vertex with value t1 to one with value t2, less `root` both; and what it
// makes of the targets x, y over them: the values less the root, and whether it reaches them through the edge. Shared
// by the two triangles at each edge.
template <class Front, class T>
struct Edge8;

template <class T>
struct Edge8<CircularFront, T> {
  using V = Lanes<T>;
  V length, inverse, root, t1, start_x, start_y, real;

  BRUSHFIRE_AVX2_INLINE static Edge8 of(V length, V root, V t1, V t2) {
    constexpr T kShorter = 1 - 8 * std::numeric_limits<T>::epsilon();
    const V zero = all(T(0)), difference = t1 - t2, sum = t1 + t2;
    const V heron = (sum - all(kShorter) * length) * (sum + length) * (length - difference) * (length + difference);
    const V inverse = all(T(1)) / length, half = all(T(0.5)) * inverse;
    const V start_x = all(T(0.5)) * length + difference * sum * half;
    const V start_y = square_root(greater(heron, zero)) * half;
    return {length, inverse, root, t1, start_x, start_y, zero < heron};
  }

  template <class LaneIndex>
  BRUSHFIRE_AVX2_INLINE Edge8 permuted_by(const LaneIndex& index) const {
    return {permuted(length, index),  permuted(inverse, index), permuted(root, index), permuted(t1, index),
            permuted(start_x, index), permuted(start_y, index), permuted(real, index)};
  }

  BRUSHFIRE_AVX2_INLINE V update(V x, V y, V side, V any_order, V& through) const {
    const V height = y + start_y;
    const V crossing = start_x * y + x * start_y;
    const V across = x - start_x;
    const V straight = square_root(across * across + height * height);
    const V causal = any_order | ((t1 - straight) * (t1 + straight) <= side * side);
    through = real & (all(T(0)) <= crossing) & (crossing <= length * height) & (straight < t1 + side) & causal;
    return straight;
  }
};

template <class T>
struct Edge8<PlanarFront, T> {
  using V = Lanes<T>;
  V length, inverse, root, t1, t2, slope_x, slope_y, real;

  BRUSHFIRE_AVX2_INLINE static Edge8 of(V length, V root, V t1, V t2) {
    const V zero = all(T(0)), one = all(T(1)), inverse = one / length;
    const V slope_x = (t2 - t1) * inverse, rest = (one - slope_x) * (one + slope_x);
    return {length, inverse, root, t1, t2, slope_x, square_root(greater(rest, zero)), zero < rest};
  }

  // Root and t1 are the same in all lanes: planar fronts start from one value.
  template <class LaneIndex>
  BRUSHFIRE_AVX2_INLINE Edge8 permuted_by(const LaneIndex& index) const {
    return {permuted(length, index),  permuted(inverse, index), root, t1, permuted(t2, index), permuted(slope_x, index),
            permuted(slope_y, index), permuted(real, index)};
  }

  BRUSHFIRE_AVX2_INLINE V update(V x, V y, V side, V any_order, V& through) const {
    const V crossing = x * slope_y - slope_x * y;
    const V straight = t1 + (slope_x * x + slope_y * y);
    const V causal = any_order | ((t1 <= straight) & (t2 <= straight));
    through = real & (all(T(0)) <= crossing) & (crossing <= length * slope_y) & (straight < t1 + side) & causal;
    return straight;
  }
};

// Values and roots.
template <class T>
struct Fronts8 {
  Lanes<T> value, root;
};

// What a vertex with `turn` offers over eight edges to the targets at `dot`, `cross` and `side`.
template <class Front, class T>
BRUSHFIRE_AVX2_INLINE Fronts8<T> offers_over(const Edge8<Front, T>& edge, Lanes<T> dot, Lanes<T> cross, Lanes<T> side,
                                             Lanes<T> any_order, const Turn<T>& turn) {
  Lanes<T> through;
  const Lanes<T> value = edge.update(dot * edge.inverse, cross * edge.inverse, side, any_order, through);
  return {select(through, edge.root + value, all(turn.value) + side), select(through, edge.root, all(turn.root))};
}

template <class T>
BRUSHFIRE_AVX2_INLINE Lanes<T> common_root8(const Turn<T>& turn, Lanes<T> other_value, Lanes<T> other_root,
                                            Lanes<T> length) {
  const Lanes<T> mean = all(T(0.5)) * (all(turn.root) + other_root);
  const Lanes<T> highest = all(T(0.5)) * (all(turn.value) + other_value) - all(T(0.75)) * length;
  const Lanes<T> common = lesser(mean, greater(highest, all(turn.start)));
  return select(other_value < all(MarchState<T>::kUnreached), common, all(turn.root));
}

BRUSHFIRE_AVX2_INLINE __m128 pair4(const MarchState<float>::Front* at, Index i, Index j) {
  const __m128d low = _mm_load_sd(reinterpret_cast<const double*>(at + i));
  return _mm_castpd_ps(_mm_loadh_pd(low, reinterpret_cast<const double*>(at + j)));
}
// Values and roots at the ends of eight sides.
BRUSHFIRE_AVX2_INLINE Fronts8<float> gather8(const MarchState<float>::Front* at, const Index* end) {
  // Sides 0 1 4 5 and 2 3 6 7, so that the halves of the shuffles below come out in order.
  const __m256 outer =
      _mm256_insertf128_ps(_mm256_castps128_ps256(pair4(at, end[0], end[1])), pair4(at, end[4], end[5]), 1);
  const __m256 inner =
      _mm256_insertf128_ps(_mm256_castps128_ps256(pair4(at, end[2], end[3])), pair4(at, end[6], end[7]), 1);
  return {{_mm256_shuffle_ps(outer, inner, 0x88)}, {_mm256_shuffle_ps(outer, inner, 0xdd)}};
}

BRUSHFIRE_AVX2_INLINE __m256d pair4(const MarchState<double>::Front* at, Index i, Index j) {
  return _mm256_set_m128d(_mm_loadu_pd(&at[j].value), _mm_loadu_pd(&at[i].value));
}
BRUSHFIRE_AVX2_INLINE Fronts8<double> gather8(const MarchState<double>::Front* at, const Index* end) {
  const __m256d p02 = pair4(at, end[0], end[2]), p13 = pair4(at, end[1], end[3]);
  const __m256d p46 = pair4(at, end[4], end[6]), p57 = pair4(at, end[5], end[7]);
  return {{_mm256_unpacklo_pd(p02, p13), _mm256_unpacklo_pd(p46, p57)},
          {_mm256_unpackhi_pd(p02, p13), _mm256_unpackhi_pd(p46, p57)}};
}

template <bool kLabelled, class T>
BRUSHFIRE_AVX2_INLINE std::uint32_t lowers8(Lanes<T> offer, Lanes<T> old) {
  if constexpr (kLabelled) return bits((offer <= old) & (offer < all(MarchState<T>::kUnreached)));
  return bits(offer < old * all(kNews<T>));
}

BRUSHFIRE_AVX2_INLINE __m256i lanes_with_bit(__m256i a, int bit) {
  return _mm256_srai_epi32(_mm256_slli_epi32(a, 31 - bit), 31);
}

BRUSHFIRE_AVX2_INLINE void store_anywhere(float* to, Float8 a) { _mm256_storeu_ps(to, a.v); }
BRUSHFIRE_AVX2_INLINE void store_anywhere(double* to, Double8 a) {
  _mm256_storeu_pd(to, a.low);
  _mm256_storeu_pd(to + 4, a.high);
}

// Adds the lanes of a set.
template <class T>
BRUSHFIRE_AVX2_INLINE void add_lanes(std::uint32_t set, __m256i end, Lanes<T> value, Lanes<T> root,
                                     Candidates<T>& candidates) {
  const __m256i packed = packing(set);
  const auto index = index_for(value, packed);
  const Index count = candidates.count;
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(candidates.end + count), _mm256_permutevar8x32_epi32(end, packed));
  store_anywhere(candidates.value + count, permuted(value, index));
  store_anywhere(candidates.root + count, permuted(root, index));
  candidates.count += static_cast<Index>(std::popcount(set));
}

// make_offers() where the other ends' own values support the front. Of the including file alone, so that it is inlined.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_AVX2 static void make_offers8(const RingBlock<T>& block, const LaneLinks& lanes, const MarchState<T>& s,
                                        const Turn<T>& turn, Candidates<T>& candidates) {
  using V = Lanes<T>;
  const V never = all(MarchState<T>::kUnreached);
  const __m256i links = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(lanes.links)));
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), seven = _mm256_set1_epi32(7);
  const __m256i ends = _mm256_load_si256(reinterpret_cast<const __m256i*>(block.end));
  const __m256i upper = _mm256_srli_epi32(links, 4);  // indices are the lowest three bits
  const auto second = index_for(V{}, links), back = index_for(V{}, upper);
  const auto [value, root] = gather8(s.front_at.data(), block.end);
  V support = value;
  if constexpr (kLabelled) {
    const __m256i label = _mm256_i32gather_epi32(reinterpret_cast<const int*>(s.label.data()), ends, 4);
    const __m256i own = _mm256_set1_epi32(static_cast<int>(turn.label));
    support = select(wide_mask(V{}, _mm256_cmpeq_epi32(label, own)), value, never);
  }
  const V dot = load(block.dot), cross = load(block.cross), la = load(block.length);
  V common = all(turn.start);
  if constexpr (Front::kBends) common = common_root8(turn, support, root, la);
  const auto at_a = Edge8<Front, T>::of(la, common, all(turn.value) - common, support - common);
  const auto at_b = at_a.permuted_by(second);
  const auto [to_a, root_a] = offers_over(at_b, dot, cross, la, wide_mask(V{}, lanes_with_bit(links, 3)), turn);
  const auto [to_b, root_b] =
      offers_over(at_a, dot, cross, at_b.length, wide_mask(V{}, lanes_with_bit(links, 7)), turn);
  // Each side takes the better one of the offers of its two triangles.
  const V from_b =
      select(wide_mask(V{}, _mm256_cmpeq_epi32(_mm256_and_si256(upper, seven), lane)), never, permuted(to_b, back));
  const V takes_b = from_b < to_a;
  const V best = select(takes_b, from_b, to_a), root_best = select(takes_b, permuted(root_b, back), root_a);
  add_lanes<T>(lowers8<kLabelled, T>(best, value), ends, best, root_best, candidates);
  // The second sides whose own triangle is not the one they take offers from.
  const __m256i returned = _mm256_and_si256(_mm256_permutevar8x32_epi32(upper, links), seven);
  const V first = wide_mask(V{}, _mm256_cmpeq_epi32(returned, lane));
  const V value_b = select(first, all(T(0)), permuted(value, second));  // nothing is less than 0: done with above
  const std::uint32_t lower_b = lowers8<kLabelled, T>(to_b, value_b);
  if (lower_b == 0) return;
  alignas(64) T offered[kLanes], passed[kLanes];
  store(offered, to_b);
  store(passed, root_b);
  for (std::uint32_t more = lower_b; more != 0; more &= more - 1) {
    const Index k = static_cast<Index>(std::countr_zero(more));
    candidates.add_if(true, block.end[lanes.second(k)], offered[k], passed[k]);
  }
}

}  // namespace brushfire::fast_marching

#endif
