// The inner loops of the march, once per front model, label mode and instruction set.
//
// Compiled without math errno and floating-point traps (see CMakeLists.txt), which lets compilers turn the loop over
// the lanes of a block into vector instructions. Nothing is contracted or reordered: every instruction set gives the
// same bits.
#include <brushfire/solvers/fast_marching/march.h>

#include <brushfire/solvers/fast_marching/float8.h>
#include <brushfire/solvers/fast_marching/triangle_update.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace brushfire::detail {
namespace {

// A value has to fall by more than rounding to be news: otherwise two ways of equal length would chase each other.
template <class T>
inline constexpr T kNews = 1 - 4 * std::numeric_limits<T>::epsilon();

// The state byte of a vertex: whether its value has news for its neighbours, and how often it came up so far. On curved
// surfaces values can chase each other in circles for hundreds of rounds, ever lower; the limit ends that.
constexpr std::uint8_t kOpen = 128;
constexpr std::uint8_t kMaxPops = 3;

// What a vertex offers to the ends of the sides of a block, and the roots that go with the offers; and what the
// triangles offer to the ends of their second sides.
template <class T>
struct Offers {
  alignas(64) T value[kLanes], root[kLanes], value_b[kLanes], root_b[kLanes];
};

// The offers of a block that improve, or seem to: several may go to one vertex.
template <class T>
struct Candidates {
  static constexpr Index kRoom = 3 * kLanes;  // whole registers are written
  alignas(64) Index end[kRoom];
  alignas(64) T value[kRoom];
  alignas(64) T root[kRoom];
  Index count = 0;

  BRUSHFIRE_INLINE void add_if(bool wanted, Index w, T offer, T passed) {
    end[count] = w, value[count] = offer, root[count] = passed;
    count += wanted ? 1u : 0u;
  }
};

// The vertex whose turn it is.
template <class T>
struct Turn {
  T value, root;
  T start;  // of its label
  Index label;
};

// The front over an edge is a circle around one point, whose value is the mean of the ends' roots; less where the
// circles around the ends would not meet (near the start, where the root is the start's own value).
template <class T>
BRUSHFIRE_INLINE T common_root(const Turn<T>& turn, T other_value, T other_root, T length) {
  const T mean = T(0.5) * (turn.root + other_root);
  const T highest = T(0.5) * (turn.value + other_value) - T(0.75) * length;
  const T cap = highest > turn.start ? highest : turn.start;
  const T common = mean < cap ? mean : cap;
  return other_value < MarchState<T>::kUnreached ? common : turn.root;  // a vertex not reached has no root
}

// The ends of a block's sides: their values, what of these may support a front (fronts of other labels support
// nothing), and their roots.
template <class T>
struct Ends {
  alignas(64) T value[kLanes], support[kLanes], root[kLanes];
};

// Offers from `support(place)` at the other end: to the ends of the sides of a block; and to the end of a triangle's
// second side, where that side takes another triangle's offer (there are more triangles than sides where some are
// unfolded).
template <class Front, bool kLabelled, class T, class Support>
BRUSHFIRE_INLINE void make_offers(const RingBlock<T>& block, const LaneLinks& links, const Support& support,
                                  const MarchState<T>& s, const Turn<T>& turn, Candidates<T>& candidates) {
  constexpr T kNever = MarchState<T>::kUnreached;
  // Gathered first: only the loop without indices vectorises everywhere.
  Ends<T> a, b;
  Offers<T> offers;
  alignas(64) T inverse_a[kLanes], inverse_b[kLanes], length_b[kLanes];
  alignas(64) T any_order_a[kLanes], any_order_b[kLanes];  // 1: yes; of the width of the rest
  for (Index k = 0; k < kLanes; ++k) {
    const Index end = block.end[k];
    a.value[k] = s.front_at[end].value;
    a.support[k] = support(end);
    if constexpr (kLabelled) a.support[k] = s.label[end] == turn.label ? a.support[k] : kNever;
    a.root[k] = s.front_at[end].root;
  }
  for (Index k = 0; k < kLanes; ++k) {
    inverse_a[k] = 1 / block.length[k];
    a.root[k] = Front::kBends ? common_root(turn, a.support[k], a.root[k], block.length[k]) : turn.start;
  }
  for (Index k = 0; k < kLanes; ++k) {
    const Index second = links.second(k);
    b.value[k] = links.back(second) == k ? 0 : a.value[second];  // 0: nothing is less
    b.support[k] = a.support[second];
    b.root[k] = a.root[second];
    length_b[k] = block.length[second];
    inverse_b[k] = inverse_a[second];
    any_order_a[k] = links.any_order_first(k) ? T(1) : T(0);
    any_order_b[k] = links.any_order_second(k) ? T(1) : T(0);
  }
  for (Index k = 0; k < kLanes; ++k) {
    const T la = block.length[k], lb = length_b[k], dot = block.dot[k], cross = block.cross[k];
    const T ia = inverse_a[k], ib = inverse_b[k], over_a = a.root[k], over_b = b.root[k];
    const Update<T> to_a = Front::update(UpdateTriangle<T>{lb, ib, dot * ib, cross * ib, la, any_order_a[k] != 0},
                                         turn.value - over_b, b.support[k] - over_b);
    const Update<T> to_b = Front::update(UpdateTriangle<T>{la, ia, dot * ia, cross * ia, lb, any_order_b[k] != 0},
                                         turn.value - over_a, a.support[k] - over_a);
    // Along the edge the vertex passes on its own root.
    offers.value[k] = to_a.through ? over_b + to_a.value : turn.value + la;
    offers.root[k] = to_a.through ? over_b : turn.root;
    offers.value_b[k] = to_b.through ? over_a + to_b.value : turn.value + lb;
    offers.root_b[k] = to_b.through ? over_a : turn.root;
  }
  const auto lowers = [](T offer, T old) -> bool {
    if constexpr (kLabelled) return (offer <= old) & (offer < kNever);  // equal values may go to another label
    return offer < old * kNews<T>;
  };
  // Each side takes the better one of the offers of its two triangles.
  alignas(64) T returned[kLanes], returned_root[kLanes], improves_a[kLanes], improves_b[kLanes];
  for (Index k = 0; k < kLanes; ++k) {
    const Index back = links.back(k);
    returned[k] = back != k ? offers.value_b[back] : kNever;
    returned_root[k] = offers.root_b[back];
  }
  for (Index k = 0; k < kLanes; ++k) {
    const bool takes = returned[k] < offers.value[k];
    offers.root[k] = takes ? returned_root[k] : offers.root[k];
    offers.value[k] = takes ? returned[k] : offers.value[k];
    improves_a[k] = lowers(offers.value[k], a.value[k]) ? T(1) : T(0);
    improves_b[k] = lowers(offers.value_b[k], b.value[k]) ? T(1) : T(0);
  }
  for (Index k = 0; k < kLanes; ++k) {
    candidates.add_if(improves_a[k] != 0, block.end[k], offers.value[k], offers.root[k]);
  }
  for (Index k = 0; k < kLanes; ++k) {
    if (improves_b[k] != 0) candidates.add_if(true, block.end[links.second(k)], offers.value_b[k], offers.root_b[k]);
  }
}

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT

// What CircularFront::update() makes of eight edges (the front over each of them), and of the targets over them: the
// same operations in the same order, so the same bits; shared by the two triangles at each edge.
struct Edge8 {
  Float8 length, inverse, root, t1, start_x, start_y, real;
};
BRUSHFIRE_AVX2_INLINE Edge8 edge8(Float8 length, Float8 root, Float8 t1, Float8 t2) {
  constexpr float kShorter = 1 - 8 * std::numeric_limits<float>::epsilon();
  const Float8 zero = all(0), difference = t1 - t2, sum = t1 + t2;
  const Float8 heron = (sum - all(kShorter) * length) * (sum + length) * (length - difference) * (length + difference);
  const Float8 inverse = all(1) / length, half = all(0.5f) * inverse;
  const Float8 start_x = all(0.5f) * length + difference * sum * half;
  const Float8 start_y = square_root(greater(heron, zero)) * half;
  return {length, inverse, root, t1, start_x, start_y, zero < heron};
}
BRUSHFIRE_AVX2_INLINE Edge8 permuted(const Edge8& e, __m256i index) {
  return {permuted(e.length, index),  permuted(e.inverse, index), permuted(e.root, index), permuted(e.t1, index),
          permuted(e.start_x, index), permuted(e.start_y, index), permuted(e.real, index)};
}

// Values and roots that a vertex with `turn` offers over eight edges to the targets at `dot`, `cross` and `side`.
struct Fronts8 {
  Float8 value, root;
};
BRUSHFIRE_AVX2_INLINE Fronts8 update8(const Edge8& edge, Float8 dot, Float8 cross, Float8 side, Float8 any_order,
                                      const Turn<float>& turn) {
  const Float8 x = dot * edge.inverse, y = cross * edge.inverse;
  const Float8 height = y + edge.start_y;
  const Float8 crossing = edge.start_x * y + x * edge.start_y;
  const Float8 across = x - edge.start_x;
  const Float8 straight = square_root(across * across + height * height);
  const Float8 causal = any_order | ((edge.t1 - straight) * (edge.t1 + straight) <= side * side);
  const Float8 through =
      edge.real & (all(0) <= crossing) & (crossing <= edge.length * height) & (straight < edge.t1 + side) & causal;
  return {select(through, edge.root + straight, all(turn.value) + side), select(through, edge.root, all(turn.root))};
}

BRUSHFIRE_AVX2_INLINE Float8 common_root8(const Turn<float>& turn, Float8 other_value, Float8 other_root,
                                          Float8 length) {
  const Float8 mean = all(0.5f) * (all(turn.root) + other_root);
  const Float8 highest = all(0.5f) * (all(turn.value) + other_value) - all(0.75f) * length;
  const Float8 common = lesser(mean, greater(highest, all(turn.start)));
  return select(other_value < all(MarchState<float>::kUnreached), common, all(turn.root));
}

BRUSHFIRE_AVX2_INLINE __m128 pair4(const MarchState<float>::Front* at, Index i, Index j) {
  const __m128d low = _mm_load_sd(reinterpret_cast<const double*>(at + i));
  return _mm_castpd_ps(_mm_loadh_pd(low, reinterpret_cast<const double*>(at + j)));
}
// Values and roots at the ends of eight sides.
BRUSHFIRE_AVX2_INLINE Fronts8 gather8(const MarchState<float>::Front* at, const Index* end) {
  // Sides 0 1 4 5 and 2 3 6 7, so that the halves of the shuffles below come out in order.
  const __m256 outer =
      _mm256_insertf128_ps(_mm256_castps128_ps256(pair4(at, end[0], end[1])), pair4(at, end[4], end[5]), 1);
  const __m256 inner =
      _mm256_insertf128_ps(_mm256_castps128_ps256(pair4(at, end[2], end[3])), pair4(at, end[6], end[7]), 1);
  return {{_mm256_shuffle_ps(outer, inner, 0x88)}, {_mm256_shuffle_ps(outer, inner, 0xdd)}};
}

template <bool kLabelled>
BRUSHFIRE_AVX2_INLINE Float8 lowers8(Float8 offer, Float8 old) {
  if constexpr (kLabelled) return (offer <= old) & (offer < all(MarchState<float>::kUnreached));
  return offer < old * all(kNews<float>);
}

// make_offers() for the circular front in float.
template <bool kLabelled>
BRUSHFIRE_AVX2 void make_offers8(const RingBlock<float>& block, const LaneLinks& lanes, const MarchState<float>& s,
                                 const Turn<float>& turn, Candidates<float>& candidates) {
  const Float8 never = all(MarchState<float>::kUnreached);
  const __m256i links = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(lanes.links)));
  const __m256i back = _mm256_srli_epi32(links, 4), lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const auto [value, root] = gather8(s.front_at.data(), block.end);
  Float8 support = value;
  if constexpr (kLabelled) {
    const __m256i ends = _mm256_load_si256(reinterpret_cast<const __m256i*>(block.end));
    const __m256i label = _mm256_i32gather_epi32(reinterpret_cast<const int*>(s.label.data()), ends, 4);
    const __m256i own = _mm256_set1_epi32(static_cast<int>(turn.label));
    support = select({_mm256_castsi256_ps(_mm256_cmpeq_epi32(label, own))}, value, never);
  }
  const Float8 dot = load(block.dot), cross = load(block.cross), la = load(block.length);
  const Float8 common = common_root8(turn, support, root, la);
  const Edge8 at_a = edge8(la, common, all(turn.value) - common, support - common), at_b = permuted(at_a, links);
  const auto [to_a, root_a] = update8(at_b, dot, cross, la, mask_of_bit(links, 3), turn);
  const auto [to_b, root_b] = update8(at_a, dot, cross, at_b.length, mask_of_bit(links, 7), turn);
  // Each side takes the better one of the offers of its two triangles.
  const __m256i returned = _mm256_and_si256(_mm256_permutevar8x32_epi32(back, links), _mm256_set1_epi32(7));
  const Float8 alone = {_mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(back, _mm256_set1_epi32(7)), lane))};
  const Float8 from_b = select(alone, never, permuted(to_b, back));
  const Float8 takes_b = from_b < to_a;
  const Float8 best = select(takes_b, from_b, to_a), root_best = select(takes_b, permuted(root_b, back), root_a);
  const std::uint32_t lower = bits(lowers8<kLabelled>(best, value));
  const __m256i packed = packing(lower);
  const __m256i end = _mm256_load_si256(reinterpret_cast<const __m256i*>(block.end));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(candidates.end + candidates.count),
                      _mm256_permutevar8x32_epi32(end, packed));
  _mm256_storeu_ps(candidates.value + candidates.count, permuted(best, packed).v);
  _mm256_storeu_ps(candidates.root + candidates.count, permuted(root_best, packed).v);
  candidates.count += static_cast<Index>(std::popcount(lower));
  const Float8 first = {_mm256_castsi256_ps(_mm256_cmpeq_epi32(returned, lane))};
  const Float8 value_b = select(first, all(0), permuted(value, links));  // nothing is less than 0: done with above
  const std::uint32_t lower_b = bits(lowers8<kLabelled>(to_b, value_b));
  if (lower_b == 0) return;
  alignas(32) float offered[kLanes], passed[kLanes];
  store(offered, to_b);
  store(passed, root_b);
  for (std::uint32_t more = lower_b; more != 0; more &= more - 1) {
    const Index k = static_cast<Index>(std::countr_zero(more));
    candidates.add_if(true, block.end[lanes.second(k)], offered[k], passed[k]);
  }
}

#endif

// Equal values go to the lower label.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void accept(MarchState<T>& s, Index w, T offer, T root, Index label) {
  auto& at = s.front_at[w];
  const T old = at.value;
  const std::uint8_t state = s.open[w];
  if ((state & ~kOpen) >= kMaxPops) return;
  if constexpr (kLabelled) {
    if (!(offer < old * kNews<T>) && !(offer <= old && label < s.label[w])) return;
    s.label[w] = label;
  } else {
    if (!(offer < old * kNews<T>)) return;
  }
  at.value = offer;
  if constexpr (Front::kBends) at.root = root;
  const BucketQueue::Bucket bucket = s.bucket_of(offer);
  // Where it waits already, in the same bucket, that will do.
  const bool waits = ((state & kOpen) != 0) & (bucket == s.bucket_of(old));
  s.open[w] = state | kOpen;
  s.touched.push_if(old == MarchState<T>::kUnreached, w);
  s.queue.push_if(!waits, w, bucket);
}

// Gaussian curvature bends the front that passes over it: its curvature 1/r falls by the curvature on the way (the
// Riccati equation of geodesic circles). Bounded so that no vertex turns it over, and it stays a circle.
template <class T>
BRUSHFIRE_INLINE void bend_front(const Rings<T>& rings, MarchState<T>& s, Index v) {
  const T bend = rings.bend[v];
  auto& at = s.front_at[v];
  const T radius = at.value - at.root;
  if (bend == 0 || !(radius > 0)) return;
  // 1/after = 1/(1/radius - bend); the bounds are those of the radius.
  constexpr T kMostPerVertex = 2, kFlattest = 8;
  const T shrinking = 1 - bend * radius;
  const T largest = std::max(radius, std::min(kMostPerVertex * radius, kFlattest * at.value));
  const T after = shrinking > 1 / kFlattest ? radius / shrinking : largest;
  at.root = at.value - std::clamp(after, radius / kMostPerVertex, largest);
}

// How offers are made: by loops that compilers turn into vector instructions, as far as these go.
template <class Front, bool kLabelled, class T>
struct InLoops {
  BRUSHFIRE_INLINE static void offers(const RingBlock<T>& block, const LaneLinks& links, const MarchState<T>& s,
                                      const Turn<T>& turn, Candidates<T>& candidates) {
    make_offers<Front, kLabelled>(block, links, [&](Index w) { return s.front_at[w].value; }, s, turn, candidates);
  }
};

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
// Or in registers.
template <class Front, bool kLabelled, class T>
struct InRegisters : InLoops<Front, kLabelled, T> {};

template <bool kLabelled>
struct InRegisters<CircularFront, kLabelled, float> {
  BRUSHFIRE_INLINE static void offers(const RingBlock<float>& block, const LaneLinks& links, const MarchState<float>& s,
                                      const Turn<float>& turn, Candidates<float>& candidates) {
    make_offers8<kLabelled>(block, links, s, turn, candidates);
  }
};
#endif

// Vertex v offers values to its neighbours.
template <template <class, bool, class> class Maker, class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void relax(const Rings<T>& rings, MarchState<T>& s, Index v, Candidates<T>& candidates) {
  if constexpr (Front::kBends) bend_front(rings, s, v);
  Turn<T> turn{s.front_at[v].value, 0, 0, 0};
  if constexpr (kLabelled) {
    turn.label = s.label[v];
    turn.start = s.start[turn.label];
  }
  turn.root = Front::kBends ? s.front_at[v].root : turn.start;
  const Index end = rings.layout.block_offset[v + 1];
  for (Index i = rings.layout.block_offset[v]; i < end; ++i) {
    candidates.count = 0;
    Maker<Front, kLabelled, T>::offers(rings.blocks[i], rings.layout.links[i], s, turn, candidates);
    for (Index c = 0; c < candidates.count; ++c) {
      accept<Front, kLabelled>(s, candidates.end[c], candidates.value[c], candidates.root[c], turn.label);
    }
  }
}

// What the vertices that come up next will need: first where their blocks are, then the blocks.
template <class T>
BRUSHFIRE_INLINE void prefetch(const Rings<T>& rings, const MarchState<T>& s, const Pile& bucket, std::size_t i) {
#if defined(__GNUC__)
  constexpr std::size_t kOffsetsAhead = 12, kBlocksAhead = 5, kCacheLine = 64;
  if (i + kOffsetsAhead < bucket.size()) {
    const Index v = bucket[i + kOffsetsAhead];
    __builtin_prefetch(&rings.layout.block_offset[v]);
    __builtin_prefetch(&s.front_at[v]);
    __builtin_prefetch(&rings.bend[v]);
    __builtin_prefetch(&s.open[v]);
  }
  if (i + kBlocksAhead < bucket.size()) {
    const Index v = bucket[i + kBlocksAhead];
    const Index first = rings.layout.block_offset[v], last = rings.layout.block_offset[v + 1];
    __builtin_prefetch(&rings.layout.links[first]);
    const char* block = reinterpret_cast<const char*>(rings.blocks.data() + first);
    const char* end = reinterpret_cast<const char*>(rings.blocks.data() + last);
    for (; block < end; block += kCacheLine) __builtin_prefetch(block);
  }
#else
  (void)rings, (void)s, (void)bucket, (void)i;
#endif
}

template <template <class, bool, class> class Maker, class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE std::size_t slice_body(const Rings<T>& rings, MarchState<T>& s, std::size_t begin) {
  Candidates<T> candidates;
  std::size_t i = begin;
  for (; i < s.queue.current().size() && i < begin + kSlice; ++i) {
    prefetch(rings, s, s.queue.current(), i);
    const Index v = s.queue.current()[i];
    if ((s.open[v] & kOpen) == 0) continue;
    s.open[v] = static_cast<std::uint8_t>((s.open[v] ^ kOpen) + 1);
    ++s.pops;
    relax<Maker, Front, kLabelled>(rings, s, v, candidates);
  }
  return i;
}

template <class Front, bool kLabelled, class T>
std::size_t slice_baseline(const Rings<T>& rings, MarchState<T>& s, std::size_t begin) {
  return slice_body<InLoops, Front, kLabelled>(rings, s, begin);
}

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
template <class Front, bool kLabelled, class T>
BRUSHFIRE_AVX2 std::size_t slice_avx2(const Rings<T>& rings, MarchState<T>& s, std::size_t begin) {
  return slice_body<InRegisters, Front, kLabelled>(rings, s, begin);
}
#endif

template <class Front, bool kLabelled, class T>
MarchSlice<T> slice_for(Variant variant) {
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
  if (variant == Variant::Best && __builtin_cpu_supports("avx2")) return slice_avx2<Front, kLabelled, T>;
#else
  static_cast<void>(variant);
#endif
  return slice_baseline<Front, kLabelled, T>;
}

}  // namespace

template <class T>
void MarchState<T>::resize(Index vertex_count) {
  front_at.assign(static_cast<std::size_t>(vertex_count) + 1, Front{});
  open.assign(front_at.size(), 0);
  touched.clear();
  label.clear();
  fixed_value.clear();
}

template <class T>
void MarchState<T>::reset() {
  if (touched_most()) {
    std::fill(front_at.begin(), front_at.end(), Front{});
    std::fill(open.begin(), open.end(), std::uint8_t{0});
    std::fill(label.begin(), label.end(), kNoIndex);
    std::fill(fixed_value.begin(), fixed_value.end(), kUnreached);
  } else {
    for (const Index v : touched) {
      front_at[v] = Front{};
      open[v] = 0;
      if (!label.empty()) label[v] = kNoIndex;
      if (!fixed_value.empty()) fixed_value[v] = kUnreached;
    }
  }
  touched.clear();
  queue.reset();
  pops = 0;
}

template <class T>
BucketQueue::Bucket MarchState<T>::bucket_of(T v) const {
  constexpr T kFarthest = T(1ll << 62);  // of buckets: what is farther shares the last one
  const T bucket = v * buckets_per_unit;
  return bucket < kFarthest ? static_cast<BucketQueue::Bucket>(bucket) : BucketQueue::Bucket{1} << 62;
}

template <class T>
void MarchState<T>::offer(Index place, T v, Index source) {
  Front& at = front_at[place];
  if (labelled ? std::pair(v, source) < std::pair(at.value, label[place]) : v < at.value) {
    if (at.value == kUnreached) touched.push(place);
    at = {v, labelled ? start[source] : T(0)};
    if (labelled) label[place] = source;
    open[place] = kOpen;
    queue.push(place, bucket_of(v));
  }
}

template <class T>
MarchSlice<T> march_slice(FrontModel model, bool labelled, Variant variant) {
  if (model == FrontModel::Planar) {
    return labelled ? slice_for<PlanarFront, true, T>(variant) : slice_for<PlanarFront, false, T>(variant);
  }
  return labelled ? slice_for<CircularFront, true, T>(variant) : slice_for<CircularFront, false, T>(variant);
}

template <class T>
void march_label_setting(const Rings<T>& rings, MarchState<T>& s, const std::function<void()>& poll) {
  using Entry = std::pair<T, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const Index v : s.touched) queue.emplace(s.front_at[v].value, v);
  s.fixed_value.resize(s.front_at.size(), MarchState<T>::kUnreached);
  Candidates<T> candidates;
  while (!queue.empty()) {
    const auto [t, v] = queue.top();
    queue.pop();
    if (s.open[v] == 0) continue;
    s.open[v] = 0;
    s.fixed_value[v] = t;
    if (++s.pops % kSlice == 0) poll();
    const Index label = s.label[v];
    const Turn<T> turn{t, s.start[label], s.start[label], label};
    const Index end = rings.layout.block_offset[v + 1];
    for (Index i = rings.layout.block_offset[v]; i < end; ++i) {
      candidates.count = 0;
      make_offers<LiteralCircularFront, true>(
          rings.blocks[i], rings.layout.links[i], [&](Index w) { return s.fixed_value[w]; }, s, turn, candidates);
      for (Index c = 0; c < candidates.count; ++c) {
        const Index w = candidates.end[c];
        T& value = s.front_at[w].value;
        if (s.fixed_value[w] != MarchState<T>::kUnreached || !(candidates.value[c] < value)) continue;
        if (value == MarchState<T>::kUnreached) s.touched.push(w);
        value = candidates.value[c];
        s.label[w] = label;
        s.open[w] = 1;
        queue.emplace(value, w);
      }
    }
  }
}

template struct MarchState<float>;
template struct MarchState<double>;
template MarchSlice<float> march_slice<float>(FrontModel, bool, Variant);
template MarchSlice<double> march_slice<double>(FrontModel, bool, Variant);
template void march_label_setting<float>(const Rings<float>&, MarchState<float>&, const std::function<void()>&);
template void march_label_setting<double>(const Rings<double>&, MarchState<double>&, const std::function<void()>&);

}  // namespace brushfire::detail
