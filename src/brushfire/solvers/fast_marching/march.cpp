// The loops of the march, once per front model, label mode and instruction set.
//
// Compiled without math errno and floating-point traps (see CMakeLists.txt), which lets compilers turn the loop over
// the lanes of a block into vector instructions. Nothing is contracted or reordered: every instruction set gives the
// same bits.
#include <brushfire/solvers/fast_marching/march.h>

#include <brushfire/solvers/fast_marching/offers.h>
#include <brushfire/solvers/fast_marching/offers8.h>
#include <brushfire/solvers/fast_marching/triangle_update.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace brushfire::detail {
namespace {

// The state byte of a vertex: whether its value has news for its neighbours, and how often it came up so far. On curved
// surfaces values can chase each other in circles for hundreds of rounds, ever lower; the limit ends that.
constexpr std::uint8_t kOpen = 128;
constexpr std::uint8_t kMaxPops = 3;

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
struct InRegisters {
  BRUSHFIRE_INLINE static void offers(const RingBlock<T>& block, const LaneLinks& links, const MarchState<T>& s,
                                      const Turn<T>& turn, Candidates<T>& candidates) {
    make_offers8<Front, kLabelled>(block, links, s, turn, candidates);
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

// What the vertices that come up next will need: first where their blocks are, then the blocks, then the values at the
// ends of the sides in their first ones.
template <class T>
BRUSHFIRE_INLINE void prefetch(const Rings<T>& rings, const MarchState<T>& s, const Pile& bucket, std::size_t i) {
#if defined(__GNUC__)
  constexpr std::size_t kOffsetsAhead = 12, kBlocksAhead = 5, kEndsAhead = 2, kCacheLine = 64;
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
  if (i + kEndsAhead < bucket.size()) {
    const Index first = rings.layout.block_offset[bucket[i + kEndsAhead]];
    if (first < rings.blocks.size()) {  // vertices without faces have none
      for (const Index end : rings.blocks[first].end) __builtin_prefetch(&s.front_at[end]);
    }
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
  if (variant == Variant::Best && has_avx2()) return slice_avx2<Front, kLabelled, T>;
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
