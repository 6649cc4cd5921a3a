// The inner loops of the march, once per front model, label mode and instruction set.
//
// Compiled without math errno and floating-point traps (see CMakeLists.txt), which lets compilers turn the loop over
// the lanes of a block into vector instructions. Nothing is contracted or reordered: every instruction set gives the
// same bits.
#include <brushfire/solvers/fast_marching/march.h>

#include <brushfire/solvers/fast_marching/triangle_update.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#if defined(__GNUC__)
#define BRUSHFIRE_INLINE [[gnu::always_inline]] inline
#else
#define BRUSHFIRE_INLINE inline
#endif

#if defined(__x86_64__) && defined(__GNUC__)
#define BRUSHFIRE_HAS_AVX2_VARIANT 1
#endif

namespace brushfire::detail {
namespace {

// A value has to fall by more than rounding to be news: otherwise two ways of equal length would chase each other.
template <class T>
inline constexpr T kNews = 1 - 4 * std::numeric_limits<T>::epsilon();

// The state byte of a vertex: whether its value has news for its neighbours, and how often it came up so far. On curved
// surfaces values can chase each other in circles for hundreds of rounds, ever lower; the limit ends that.
constexpr std::uint8_t kOpen = 128;
constexpr std::uint8_t kMaxPops = 3;

// One number for each of the two others of each triangle of a block.
template <class T>
struct alignas(64) Pairs {
  T a[kLanes], b[kLanes];
};

// What a vertex offers to the two others of each triangle of a block, and the roots that go with the offers.
template <class T>
struct Offers {
  Pairs<T> value, root;
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

// Offers from `support` values at the other vertex. Bit k of the result: lane k improves a; bit kLanes + k: b.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE std::uint32_t offers_of(const RingBlock<T>& block, const T* support, const MarchState<T>& s,
                                         const Turn<T>& turn, Offers<T>& offers) {
  // Gathered first: only the loop without indices vectorises everywhere.
  Pairs<T> supports, values, roots;
  for (Index k = 0; k < kLanes; ++k) {
    supports.a[k] = support[block.a[k]];
    supports.b[k] = support[block.b[k]];
    values.a[k] = s.value[block.a[k]];
    values.b[k] = s.value[block.b[k]];
    if constexpr (Front::kBends) {
      roots.a[k] = s.root[block.a[k]];
      roots.b[k] = s.root[block.b[k]];
    }
    if constexpr (kLabelled) {  // fronts of other labels support nothing
      if (s.label[block.a[k]] != turn.label) supports.a[k] = MarchState<T>::kUnreached;
      if (s.label[block.b[k]] != turn.label) supports.b[k] = MarchState<T>::kUnreached;
    }
  }
  std::uint32_t improves = 0;
  for (Index k = 0; k < kLanes; ++k) {
    const T la = std::abs(block.length_a[k]), lb = std::abs(block.length_b[k]);
    const T dot = block.dot[k], cross = block.cross[k];
    const T ia = 1 / la, ib = 1 / lb;
    const bool any_order_a = block.length_a[k] < 0, any_order_b = block.length_b[k] < 0;
    const T root_a = Front::kBends ? common_root(turn, supports.b[k], roots.b[k], lb) : turn.start;
    const T root_b = Front::kBends ? common_root(turn, supports.a[k], roots.a[k], la) : turn.start;
    const T to_a = root_a + Front::update(UpdateTriangle<T>{lb, ib, dot * ib, cross * ib, la, any_order_a},
                                          turn.value - root_a, supports.b[k] - root_a);
    const T to_b = root_b + Front::update(UpdateTriangle<T>{la, ia, dot * ia, cross * ia, lb, any_order_b},
                                          turn.value - root_b, supports.a[k] - root_b);
    offers.value.a[k] = to_a;
    offers.value.b[k] = to_b;
    if constexpr (Front::kBends) {  // along the edge the vertex passes on its own root
      offers.root.a[k] = to_a < turn.value + la ? root_a : turn.root;
      offers.root.b[k] = to_b < turn.value + lb ? root_b : turn.root;
    }
    bool lowers_a = to_a < values.a[k] * kNews<T>, lowers_b = to_b < values.b[k] * kNews<T>;
    if constexpr (kLabelled) {  // equal values may go to another label
      lowers_a = (to_a <= values.a[k]) & (to_a < MarchState<T>::kUnreached);
      lowers_b = (to_b <= values.b[k]) & (to_b < MarchState<T>::kUnreached);
    }
    improves |= (lowers_a ? 1u << k : 0u) | (lowers_b ? 1u << (kLanes + k) : 0u);
  }
  return improves;
}

// Equal values go to the lower label.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void accept(MarchState<T>& s, Index w, T offer, T root, Index label) {
  const T old = s.value[w];
  if ((s.open[w] & ~kOpen) >= kMaxPops) return;
  if constexpr (kLabelled) {
    if (!(offer < old * kNews<T>) && !(offer <= old && label < s.label[w])) return;
    s.label[w] = label;
  } else {
    if (!(offer < old * kNews<T>)) return;
  }
  if (old == MarchState<T>::kUnreached) s.touched.push_back(w);
  s.value[w] = offer;
  if constexpr (Front::kBends) s.root[w] = root;
  s.open[w] |= kOpen;
  s.queue.push(w, s.bucket_of(offer));
}

// Gaussian curvature bends the front that passes over it: its curvature 1/r falls by the curvature on the way (the
// Riccati equation of geodesic circles). Bounded so that no vertex turns it over, and it stays a circle.
template <class T>
BRUSHFIRE_INLINE void bend_front(const Rings<T>& rings, MarchState<T>& s, Index v) {
  const T bend = rings.bend[v];
  const T radius = s.value[v] - s.root[v];
  if (bend == 0 || !(radius > 0)) return;
  // 1/after = 1/(1/radius - bend); the bounds are those of the radius.
  constexpr T kMostPerVertex = 2, kFlattest = 8;
  const T shrinking = 1 - bend * radius;
  const T largest = std::max(radius, std::min(kMostPerVertex * radius, kFlattest * s.value[v]));
  const T after = shrinking > 1 / kFlattest ? radius / shrinking : largest;
  s.root[v] = s.value[v] - std::clamp(after, radius / kMostPerVertex, largest);
}

template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void relax(const Rings<T>& rings, MarchState<T>& s, Index v) {
  if constexpr (Front::kBends) bend_front(rings, s, v);
  Turn<T> turn{s.value[v], 0, 0, 0};
  if constexpr (kLabelled) {
    turn.label = s.label[v];
    turn.start = s.start[turn.label];
  }
  turn.root = Front::kBends ? s.root[v] : turn.start;
  Offers<T> offers;
  const Index end = rings.layout.block_offset[v + 1];
  for (Index i = rings.layout.block_offset[v]; i < end; ++i) {
    const RingBlock<T>& block = rings.blocks[i];
    std::uint32_t improves = offers_of<Front, kLabelled>(block, s.value.data(), s, turn, offers);
    while (improves != 0) {
      const Index lane = static_cast<Index>(std::countr_zero(improves)), k = lane % kLanes;
      improves &= improves - 1;
      if (lane < kLanes) {
        accept<Front, kLabelled>(s, block.a[k], offers.value.a[k], offers.root.a[k], turn.label);
      } else {
        accept<Front, kLabelled>(s, block.b[k], offers.value.b[k], offers.root.b[k], turn.label);
      }
    }
  }
}

// What the vertices that come up next will need: first where their blocks are, then the blocks.
template <class T>
BRUSHFIRE_INLINE void prefetch(const Rings<T>& rings, const MarchState<T>& s, const std::vector<Index>& bucket,
                               std::size_t i) {
#if defined(__GNUC__)
  constexpr std::size_t kOffsetsAhead = 12, kBlocksAhead = 5, kCacheLine = 64;
  if (i + kOffsetsAhead < bucket.size()) {
    const Index v = bucket[i + kOffsetsAhead];
    __builtin_prefetch(&rings.layout.block_offset[v]);
    __builtin_prefetch(&s.value[v]);
    __builtin_prefetch(&s.root[v]);
    __builtin_prefetch(&rings.bend[v]);
    __builtin_prefetch(&s.open[v]);
  }
  if (i + kBlocksAhead < bucket.size()) {
    const Index v = bucket[i + kBlocksAhead];
    const char* block = reinterpret_cast<const char*>(rings.blocks.data() + rings.layout.block_offset[v]);
    const char* end = reinterpret_cast<const char*>(rings.blocks.data() + rings.layout.block_offset[v + 1]);
    for (; block < end; block += kCacheLine) __builtin_prefetch(block);
  }
#else
  (void)rings, (void)s, (void)bucket, (void)i;
#endif
}

template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE std::size_t slice_body(const Rings<T>& rings, MarchState<T>& s, std::size_t begin) {
  std::size_t i = begin;
  for (; i < s.queue.current().size() && i < begin + kSlice; ++i) {
    prefetch(rings, s, s.queue.current(), i);
    const Index v = s.queue.current()[i];
    if ((s.open[v] & kOpen) == 0) continue;
    s.open[v] = static_cast<std::uint8_t>((s.open[v] ^ kOpen) + 1);
    ++s.pops;
    relax<Front, kLabelled>(rings, s, v);
  }
  return i;
}

template <class Front, bool kLabelled, class T>
std::size_t slice_baseline(const Rings<T>& rings, MarchState<T>& s, std::size_t begin) {
  return slice_body<Front, kLabelled>(rings, s, begin);
}

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
template <class Front, bool kLabelled, class T>
[[gnu::target("avx2,bmi,lzcnt")]] std::size_t slice_avx2(const Rings<T>& rings, MarchState<T>& s, std::size_t begin) {
  return slice_body<Front, kLabelled>(rings, s, begin);
}
#endif

template <class Front, bool kLabelled, class T>
MarchSlice<T> best_slice() {
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
  if (__builtin_cpu_supports("avx2")) return slice_avx2<Front, kLabelled, T>;
#endif
  return slice_baseline<Front, kLabelled, T>;
}

}  // namespace

template <class T>
void MarchState<T>::resize(Index vertex_count) {
  value.assign(static_cast<std::size_t>(vertex_count) + 1, kUnreached);
  open.assign(value.size(), 0);
  root.assign(value.size(), 0);
  touched.clear();
  label.clear();
  fixed_value.clear();
}

template <class T>
void MarchState<T>::reset() {
  for (const Index v : touched) {
    value[v] = kUnreached;
    open[v] = 0;
    if (!label.empty()) label[v] = kNoIndex;
    if (!fixed_value.empty()) fixed_value[v] = kUnreached;
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
  if (labelled ? std::pair(v, source) < std::pair(value[place], label[place]) : v < value[place]) {
    if (value[place] == kUnreached) touched.push_back(place);
    value[place] = v;
    root[place] = labelled ? start[source] : T(0);
    if (labelled) label[place] = source;
    open[place] = kOpen;
    queue.push(place, bucket_of(v));
  }
}

template <class T>
MarchSlice<T> march_slice(FrontModel model, bool labelled) {
  if (model == FrontModel::Planar)
    return labelled ? best_slice<PlanarFront, true, T>() : best_slice<PlanarFront, false, T>();
  return labelled ? best_slice<CircularFront, true, T>() : best_slice<CircularFront, false, T>();
}

template <class T>
void march_label_setting(const Rings<T>& rings, MarchState<T>& s, const std::function<void()>& poll) {
  using Entry = std::pair<T, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const Index v : s.touched) queue.emplace(s.value[v], v);
  s.fixed_value.resize(s.value.size(), MarchState<T>::kUnreached);
  Offers<T> offers;
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
      const RingBlock<T>& block = rings.blocks[i];
      const std::uint32_t improves =
          offers_of<LiteralCircularFront, true>(block, s.fixed_value.data(), s, turn, offers);
      for (Index lane = 0; lane < 2 * kLanes; ++lane) {
        const Index w = lane < kLanes ? block.a[lane] : block.b[lane - kLanes];
        const T offer = lane < kLanes ? offers.value.a[lane] : offers.value.b[lane - kLanes];
        if ((improves >> lane & 1u) == 0) continue;
        if (s.fixed_value[w] != MarchState<T>::kUnreached || !(offer < s.value[w])) continue;
        if (s.value[w] == MarchState<T>::kUnreached) s.touched.push_back(w);
        s.value[w] = offer;
        s.label[w] = label;
        s.open[w] = 1;
        queue.emplace(offer, w);
      }
    }
  }
}

template struct MarchState<float>;
template struct MarchState<double>;
template MarchSlice<float> march_slice<float>(FrontModel, bool);
template MarchSlice<double> march_slice<double>(FrontModel, bool);
template void march_label_setting<float>(const Rings<float>&, MarchState<float>&, const std::function<void()>&);
template void march_label_setting<double>(const Rings<double>&, MarchState<double>&, const std::function<void()>&);

}  // namespace brushfire::detail
