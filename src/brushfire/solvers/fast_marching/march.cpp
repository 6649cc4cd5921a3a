// The loops of the march, once per front model, label mode and instruction set.
//
// Compiled without math errno and floating-point traps (see CMakeLists.txt), which lets compilers turn the loop over
// the lanes of a block into vector instructions. Nothing is contracted or reordered: every instruction set gives the
// same bits.
#include <brushfire/solvers/fast_marching/detail/march.h>

#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/fast_marching/detail/offers.h>
#include <brushfire/solvers/fast_marching/detail/offers8.h>
#include <brushfire/solvers/fast_marching/detail/triangle_update.h>
#include <brushfire/solvers/fast_marching/detail/vector_target.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace brushfire::fast_marching {
namespace {

constexpr std::uint8_t kOpen = Openness::kOpen, kShared = Openness::kShared;

// On curved surfaces values can chase each other in circles for hundreds of turns, ever lower; the limit ends that.
constexpr std::uint8_t kMaxTurns = 3;

template <class T>
using Part = typename MarchState<T>::Part;

// Equal values go to the lower label.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void accept(MarchState<T>& s, Part<T>& part, Index w, T offer, T root, Index label) {
  auto& at = s.front_at[w];
  const T old = at.value;
  const std::uint8_t state = s.open[w];
  if ((state & Openness::kTurns) >= kMaxTurns) return;
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
  part.touched.push_if(old == MarchState<T>::kUnreached, w);
  if ((state & (kShared | Openness::kNews)) == kShared) [[unlikely]] {
    s.open[w] = state | kOpen | Openness::kNews;
    part.news.push(w);
    s.layout->prefetch_links(w);
  }
  part.queue.push_if(!waits, w, bucket);
}

// Gaussian curvature bends the front that passes over it: its curvature 1/r falls by the curvature on the way (the
// Riccati equation of geodesic circles). Bounded so that no vertex turns it over, and it stays a circle.
template <class T>
BRUSHFIRE_INLINE void bend_front(const Rings<T>& rings, MarchState<T>& s, Index v) {
  const T bend = rings.heads[v].bend;
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

// Vertex v offers values to its neighbours. A ghost has no blocks and offers nothing: its front is bent, as that of the
// vertex for which it stands.
template <template <class, bool, class> class Maker, class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void relax(const Rings<T>& rings, MarchState<T>& s, Part<T>& part, Index v,
                            Candidates<T>& candidates) {
  if constexpr (Front::kBends) bend_front(rings, s, v);
  Turn<T> turn{s.front_at[v].value, 0, 0, 0};
  if constexpr (kLabelled) {
    turn.label = s.label[v];
    turn.start = s.start[turn.label];
  }
  turn.root = Front::kBends ? s.front_at[v].root : turn.start;
  if (s.layout->is_ghost(v)) return;
  Index i = v;
  do {
    candidates.count = 0;
    Maker<Front, kLabelled, T>::offers(rings.blocks[i], rings.layout.links[i], s, turn, candidates);
    for (Index c = 0; c < candidates.count; ++c) {
      accept<Front, kLabelled>(s, part, candidates.end[c], candidates.value[c], candidates.root[c], turn.label);
    }
    i = rings.next_block(v, i);
  } while (i != 0);
}

// What a vertex that comes up soon will need: first what says where its further blocks are, then the blocks.
template <class T>
BRUSHFIRE_INLINE void prefetch_state(const Rings<T>& rings, const MarchState<T>& s, Index v) {
  prefetch(&s.front_at[v]);
  prefetch(&rings.heads[v]);
  prefetch(&s.open[v]);
}
template <class T>
BRUSHFIRE_INLINE void prefetch_block(const RingBlock<T>& block) {
  constexpr std::size_t kCacheLine = 64;
  const char* const at = reinterpret_cast<const char*>(&block);
  for (std::size_t i = 0; i < sizeof block; i += kCacheLine) prefetch(at + i);
}
template <class T>
BRUSHFIRE_INLINE void prefetch_blocks(const Rings<T>& rings, Index v) {
  if (v >= rings.layout.vertex_count) return;  // a ghost
  prefetch(&rings.layout.links[v]);
  prefetch_block(rings.blocks[v]);
  const Index more = rings.heads[v].more;  // none: block 0, which does no harm
  prefetch(&rings.layout.links[more]);
  prefetch_block(rings.blocks[more]);
}
// The values at the ends of the sides in its first block.
template <class T>
BRUSHFIRE_INLINE void prefetch_ends(const Rings<T>& rings, const MarchState<T>& s, Index v) {
  if (v >= rings.layout.vertex_count) return;
  for (const Index end : rings.blocks[v].end) prefetch(&s.front_at[end]);
}

constexpr std::size_t kStatesAhead = 12, kBlocksAhead = 5, kEndsAhead = 2;

template <class T>
BRUSHFIRE_INLINE void prefetch_after(const Rings<T>& rings, const MarchState<T>& s, const Pile& bucket, std::size_t i) {
  if (i + kStatesAhead < bucket.size()) prefetch_state(rings, s, bucket[i + kStatesAhead]);
  if (i + kBlocksAhead < bucket.size()) prefetch_blocks(rings, bucket[i + kBlocksAhead]);
  if (i + kEndsAhead < bucket.size()) prefetch_ends(rings, s, bucket[i + kEndsAhead]);
}

// A part's news are told; who saw them is free to have others.
template <class T>
void forget_news(MarchState<T>& s, Part<T>& part) {
  for (const Index v : part.news) s.open[v] &= static_cast<std::uint8_t>(~Openness::kNews);
  part.news.clear();
}

// Whether a value fell and was offered on in the part's last round.
template <class T>
bool was_rash(const MarchState<T>& s, Index v) {
  return (s.open[v] & (Openness::kNews | kOpen)) == Openness::kNews;
}

// Two neighbours that both were rash in the same round did not see each other: the later one has its turn again, which
// does not count as one of its own.
template <class T>
void see_each_other(MarchState<T>& s, Part<T>& part, Index ghost, T fell_to) {
  const Index owner = s.layout->owner[ghost - s.layout->first_ghost()];
  for (const Index v : s.layout->around(ghost)) {
    const T value = s.front_at[v].value;
    if (!was_rash(s, v) || value < fell_to || (value == fell_to && v < owner)) continue;
    if ((s.open[v] & Openness::kLateTurns) == Openness::kLateTurns) continue;
    s.open[v] = Openness::forgiven(s.open[v]) | kOpen;
    part.queue.push(v, s.bucket_of(value));
  }
}

// A ghost's vertex fell.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void hear(MarchState<T>& s, Part<T>& part, const typename MarchState<T>::Letter& letter) {
  const Index ghost = letter.place;
  auto& at = s.front_at[ghost];
  bool falls = letter.value < at.value;
  if constexpr (kLabelled) falls |= letter.value == at.value && letter.label < s.label[ghost];
  if (!falls) return;  // it fell further by an offer of this part, or this is where its value came from
  part.touched.push_if(at.value == MarchState<T>::kUnreached, ghost);
  at = {letter.value, letter.root};
  if constexpr (kLabelled) s.label[ghost] = letter.label;
  if constexpr (Front::kBends) {
    s.open[ghost] |= kOpen;
    part.queue.push(ghost, s.bucket_of(letter.value));
  }
}

// The letters about ghosts first: which values of this part fell in the last round is still known.
template <class Front, bool kLabelled, class T>
void read_letters(MarchState<T>& s, Part<T>& part) {
  if (part.last_round + 1 != s.round) forget_news(s, part);
  part.last_round = s.round;
  for (const Index c : part.inbox) {
    const auto& channel = s.channels[c];
    for (const auto& letter : channel.letters[1 - channel.writes]) {
      prefetch(&s.front_at[letter.place]);
      prefetch(&s.open[letter.place]);
    }
  }
  const bool rash = std::any_of(part.news.begin(), part.news.end(), [&](Index v) { return was_rash(s, v); });
  for (const Index c : part.inbox) {
    const auto& channel = s.channels[c];
    for (const auto& letter : channel.letters[1 - channel.writes]) {
      if (!s.layout->is_ghost(letter.place)) continue;
      hear<Front, kLabelled>(s, part, letter);
      if (rash && s.bucket_of(letter.value) <= s.bucket) see_each_other(s, part, letter.place, letter.value);
    }
  }
  forget_news(s, part);
  for (const Index c : part.inbox) {
    auto& channel = s.channels[c];
    for (const auto& letter : channel.letters[1 - channel.writes]) {
      if (s.layout->is_ghost(letter.place)) continue;
      std::uint8_t& state = s.open[letter.place];
      if (letter.value < s.front_at[letter.place].value) state = Openness::forgiven(state);
      accept<Front, kLabelled>(s, part, letter.place, letter.value, letter.root, letter.label);
    }
    channel.letters[1 - channel.writes].clear();
    channel.waits = false;
  }
  part.inbox.clear();
}

template <template <class, bool, class> class Maker, class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void empty_bucket(const Rings<T>& rings, MarchState<T>& s, Part<T>& part) {
  const Index none = s.layout->vertex_count;
  Candidates<T> candidates;
  for (std::size_t i = 0; i < std::min(part.queue.current().size(), kEndsAhead); ++i) {
    prefetch_ends(rings, s, part.queue.current()[i]);
  }
  for (std::size_t i = 0; i < part.queue.current().size(); ++i) {
    prefetch_after(rings, s, part.queue.current(), i);
    const Index v = part.queue.current()[i];
    if ((s.open[v] & kOpen) == 0) continue;
    const bool counts = v < none;  // not a ghost
    s.open[v] = static_cast<std::uint8_t>((s.open[v] ^ kOpen) + counts);
    part.pops += counts;
    relax<Maker, Front, kLabelled>(rings, s, part, v, candidates);
  }
  part.queue.clear_current();
}

template <template <class, bool, class> class Maker, class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void part_body(const Rings<T>& rings, MarchState<T>& s, Index number) {
  Part<T>& part = s.parts[number];
  read_letters<Front, kLabelled>(s, part);
  for (auto next = part.queue.next(); next <= s.bucket; next = part.queue.next()) {
    part.queue.move_to(next);
    empty_bucket<Maker, Front, kLabelled>(rings, s, part);
  }
  const Pile& waiting = part.queue.in(part.queue.next());
  for (std::size_t i = 0; i < std::min(waiting.size(), kStatesAhead); ++i) prefetch_state(rings, s, waiting[i]);
  s.tell(number);
  for (std::size_t i = 0; i < std::min(waiting.size(), kBlocksAhead); ++i) prefetch_blocks(rings, waiting[i]);
}

template <class Front, bool kLabelled, class T>
void part_baseline(const Rings<T>& rings, MarchState<T>& s, Index part) {
  part_body<InLoops, Front, kLabelled>(rings, s, part);
}

#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
template <class Front, bool kLabelled, class T>
BRUSHFIRE_AVX2 void part_avx2(const Rings<T>& rings, MarchState<T>& s, Index part) {
  part_body<InRegisters, Front, kLabelled>(rings, s, part);
}
#endif

template <class Front, bool kLabelled, class T>
MarchPart<T> part_for(Variant variant) {
#ifdef BRUSHFIRE_HAS_AVX2_VARIANT
  if (variant == Variant::Best && has_avx2()) return part_avx2<Front, kLabelled, T>;
#else
  static_cast<void>(variant);
#endif
  return part_baseline<Front, kLabelled, T>;
}

}  // namespace

template <class T>
MarchPart<T> march_part(FrontModel model, bool labelled, Variant variant) {
  if (model == FrontModel::Planar) {
    return labelled ? part_for<PlanarFront, true, T>(variant) : part_for<PlanarFront, false, T>(variant);
  }
  return labelled ? part_for<CircularFront, true, T>(variant) : part_for<CircularFront, false, T>(variant);
}

template <class T>
void march_label_setting(const Rings<T>& rings, MarchState<T>& s, const std::function<void()>& poll) {
  using Entry = std::pair<T, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  Part<T>& whole = s.parts.front();
  for (const Index v : whole.touched) queue.emplace(s.front_at[v].value, v);
  s.fixed_value.resize(s.front_at.size(), MarchState<T>::kUnreached);
  Candidates<T> candidates;
  while (!queue.empty()) {
    const auto [t, v] = queue.top();
    queue.pop();
    if (s.open[v] == 0) continue;
    s.open[v] = 0;
    s.fixed_value[v] = t;
    if (++whole.pops % kSlice == 0) poll();
    const Index label = s.label[v];
    const Turn<T> turn{t, s.start[label], s.start[label], label};
    Index i = v;
    do {
      candidates.count = 0;
      make_offers<LiteralCircularFront, true>(
          rings.blocks[i], rings.layout.links[i], [&](Index w) { return s.fixed_value[w]; }, s, turn, candidates);
      for (Index c = 0; c < candidates.count; ++c) {
        const Index w = candidates.end[c];
        T& value = s.front_at[w].value;
        if (s.fixed_value[w] != MarchState<T>::kUnreached || !(candidates.value[c] < value)) continue;
        if (value == MarchState<T>::kUnreached) whole.touched.push(w);
        value = candidates.value[c];
        s.label[w] = label;
        s.open[w] = 1;
        queue.emplace(value, w);
      }
      i = rings.next_block(v, i);
    } while (i != 0);
  }
}

template MarchPart<float> march_part<float>(FrontModel, bool, Variant);
template MarchPart<double> march_part<double>(FrontModel, bool, Variant);
template void march_label_setting<float>(const Rings<float>&, MarchState<float>&, const std::function<void()>&);
template void march_label_setting<double>(const Rings<double>&, MarchState<double>&, const std::function<void()>&);

}  // namespace brushfire::fast_marching
