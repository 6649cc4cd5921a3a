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

constexpr std::uint8_t kOpen = 128;
constexpr std::uint8_t kMaxPops = 3;

template <class T>
struct alignas(64) Offers {
  T to_a[kLanes], to_b[kLanes];
};

// What a vertex of value `t` offers to the two others of each triangle of the block, from `support` values at the other
// one. Bit k of the result: lane k improves a; bit kLanes + k: b.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE std::uint32_t offers_of(const RingBlock<T>& block, const T* support, const T* value,
                                         const Index* label, T t, T start, Index own_label, Offers<T>& offers) {
  std::uint32_t improves = 0;
  for (Index k = 0; k < kLanes; ++k) {
    const Index a = block.a[k], b = block.b[k];
    T at_a = support[a], at_b = support[b];
    if constexpr (kLabelled) {
      at_a = label[a] == own_label ? at_a - start : MarchState<T>::kUnreached;
      at_b = label[b] == own_label ? at_b - start : MarchState<T>::kUnreached;
    }
    const T la = std::abs(block.length_a[k]), lb = std::abs(block.length_b[k]), dot = block.dot[k],
            cross = block.cross[k];
    const T ia = 1 / la, ib = 1 / lb;
    T to_a = Front::update(UpdateTriangle<T>{lb, ib, dot * ib, cross * ib, la, block.length_a[k] < 0}, t, at_b);
    T to_b = Front::update(UpdateTriangle<T>{la, ia, dot * ia, cross * ia, lb, block.length_b[k] < 0}, t, at_a);
    if constexpr (kLabelled) {
      to_a += start;
      to_b += start;
    }
    offers.to_a[k] = to_a;
    offers.to_b[k] = to_b;
    const T keep = kLabelled ? T(1) : kNews<T>;
    improves |= (to_a <= value[a] * keep ? 1u << k : 0u) | (to_b <= value[b] * keep ? 1u << (kLanes + k) : 0u);
  }
  return improves;
}

// Equal values go to the lower label.
template <bool kLabelled, class T>
BRUSHFIRE_INLINE void accept(MarchState<T>& s, Index w, T offer, Index label) {
  const T old = s.value[w];
  const bool lower = offer < old * kNews<T>;
  if constexpr (kLabelled) {
    if (!lower && !(offer <= old && label < s.label[w])) return;
    s.label[w] = label;
  } else {
    if (!lower) return;
  }
  if ((s.open[w] & ~kOpen) >= kMaxPops) return;
  if (old == MarchState<T>::kUnreached) s.touched.push_back(w);
  s.value[w] = offer;
  s.open[w] |= kOpen;
  s.queue.push(w, s.bucket_of(offer));
}

template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void relax(const Rings<T>& rings, MarchState<T>& s, Index v) {
  const Index label = kLabelled ? s.label[v] : 0;
  const T start = kLabelled ? s.start[label] : T(0);
  const T t = s.value[v] - start;
  Offers<T> offers;
  const Index end = rings.layout.block_offset[v + 1];
  for (Index i = rings.layout.block_offset[v]; i < end; ++i) {
    const RingBlock<T>& block = rings.blocks[i];
    std::uint32_t improves =
        offers_of<Front, kLabelled>(block, s.value.data(), s.value.data(), s.label.data(), t, start, label, offers);
    while (improves != 0) {
      const Index lane = static_cast<Index>(std::countr_zero(improves));
      improves &= improves - 1;
      if (lane < kLanes) {
        if (block.a[lane] + 1 < s.value.size()) accept<kLabelled>(s, block.a[lane], offers.to_a[lane], label);
      } else if (block.b[lane - kLanes] + 1 < s.value.size()) {
        accept<kLabelled>(s, block.b[lane - kLanes], offers.to_b[lane - kLanes], label);
      }
    }
  }
}

template <class T>
BRUSHFIRE_INLINE void prefetch(const Rings<T>& rings, const MarchState<T>& s, const std::vector<Index>& bucket,
                               std::size_t i) {
#if defined(__GNUC__)
  if (i + 6 < bucket.size()) {
    __builtin_prefetch(&rings.layout.block_offset[bucket[i + 6]]);
    __builtin_prefetch(&s.value[bucket[i + 6]]);
  }
  if (i + 2 < bucket.size()) {
    const char* block = reinterpret_cast<const char*>(&rings.blocks[rings.layout.block_offset[bucket[i + 2]]]);
    for (std::size_t line = 0; line < sizeof(RingBlock<T>); line += 64) __builtin_prefetch(block + line);
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
void march_label_setting(const Rings<T>& rings, MarchState<T>& s, T limit) {
  using Entry = std::pair<T, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const Index v : s.touched) queue.emplace(s.value[v], v);
  s.fixed_value.resize(s.value.size(), MarchState<T>::kUnreached);
  Offers<T> offers;
  while (!queue.empty()) {
    const auto [t, v] = queue.top();
    queue.pop();
    if (t > limit) break;
    if (s.open[v] == 0) continue;
    s.open[v] = 0;
    s.fixed_value[v] = t;
    ++s.pops;
    const Index label = s.label[v];
    const T start = s.start[label];
    const Index end = rings.layout.block_offset[v + 1];
    for (Index i = rings.layout.block_offset[v]; i < end; ++i) {
      const RingBlock<T>& block = rings.blocks[i];
      const std::uint32_t improves = offers_of<LiteralCircularFront, true>(
          block, s.fixed_value.data(), s.value.data(), s.label.data(), t - start, start, label, offers);
      for (Index lane = 0; lane < 2 * kLanes; ++lane) {
        const Index w = lane < kLanes ? block.a[lane] : block.b[lane - kLanes];
        const T offer = lane < kLanes ? offers.to_a[lane] : offers.to_b[lane - kLanes];
        if ((improves >> lane & 1u) == 0 || w + 1 == s.value.size()) continue;
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
template void march_label_setting<float>(const Rings<float>&, MarchState<float>&, float);
template void march_label_setting<double>(const Rings<double>&, MarchState<double>&, double);

}  // namespace brushfire::detail
