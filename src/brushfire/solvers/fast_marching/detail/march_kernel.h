// The inner loops of the march: a part empties its bucket, every vertex of it updates its neighbours.
namespace brushfire::fast_marching::BRUSHFIRE_TARGET {
using namespace lanes::BRUSHFIRE_TARGET;

// The front over an edge is a circle around one point, whose value is the mean of the ends' sigmas; less where the
// circles around the ends would not meet (near the start, where sigma is the start's own value).
template <class T, class V>
BRUSHFIRE_INLINE V common_sigma(const PoppedVertex<T>& from, V other_value, V other_sigma, V length) {
  const V mean = T(0.5) * (from.sigma + other_sigma);
  const V highest = T(0.5) * (from.value + other_value) - T(0.75) * length;
  const V common = lesser(mean, greater(highest, V(from.start)));
  return select(other_value < V(MarchState<T>::kUnreached), common, V(from.sigma));  // not reached: has no sigma
}

// Values and sigmas.
template <class V>
struct Candidates {
  V value, sigma;
};

// What a vertex has for the targets over eight edges, at `dot`, `cross` and `side`. Along the side it passes on its own
// sigma.
template <class Front, class V, class T>
BRUSHFIRE_INLINE Candidates<V> over_edges(const FrontOverEdge<Front, V>& edge, V sigma, V dot, V cross, V side,
                                          MaskFor<V> any_order, const PoppedVertex<T>& from) {
  MaskFor<V> through;
  const V value = edge.update(dot * edge.inverse, cross * edge.inverse, side, any_order, through);
  return {select(through, sigma + value, from.value + side), select(through, sigma, V(from.sigma))};
}

// Equal values may go to another label.
template <bool kLabelled, class V>
BRUSHFIRE_INLINE std::uint32_t lowers(V candidate, V old) {
  using T = NumberIn<V>;
  if constexpr (kLabelled) return bits((candidate <= old) & (candidate < V(MarchState<T>::kUnreached)));
  return bits(candidate < old * kFalls<T>);
}

// Candidate updates for the ends of the sides of a block; and for the end of a triangle's second side, where that side
// takes another triangle's (there are more triangles than sides where some are unfolded). Fronts of other labels
// support nothing.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void find_updates(const RingBlock<T>& block, const LaneLinks& lanes, const MarchState<T>& s,
                                   const PoppedVertex<T>& from, CandidateUpdates<T>& updates) {
  using V = Lanes<T, kLanes>;
  const V never(MarchState<T>::kUnreached);
  const Numbers8 links = load_bytes<Numbers8>(lanes.links), lane = lane_numbers<Numbers8>();
  const Numbers8 upper = links >> 4;  // indices are the lowest three bits
  const Permutation<sizeof(T), kLanes> second(links), back(upper);
  const auto [value, sigma] = gather_pairs<V>(&s.front_at.data()->value, block.end);
  V support = value;
  if constexpr (Front::kFixedOnly) support = gather<V>(s.fixed_value.data(), block.end);
  if constexpr (kLabelled) {
    const Numbers8 label = gather<Numbers8>(s.label.data(), block.end);
    support = select(mask_cast<T>(label == from.label), support, never);
  }
  const V dot = load<V>(block.dot), cross = load<V>(block.cross), la = load<V>(block.length);
  V common(from.start);
  if constexpr (Front::kHasRadius) common = common_sigma(from, support, sigma, la);
  const auto over_a = FrontOverEdge<Front, V>::of(la, 1 / la, from.value - common, support - common);
  const auto over_b = over_a.permuted_by(second);
  V common_b = common;
  if constexpr (Front::kHasRadius) common_b = permuted(common, second);
  const V lb = permuted(la, second);
  const auto any_order_a = mask_cast<T>((links & LaneLinks::kAnyOrderFirst) == LaneLinks::kAnyOrderFirst);
  const auto any_order_b = mask_cast<T>((links & LaneLinks::kAnyOrderSecond) == LaneLinks::kAnyOrderSecond);
  const auto [to_a, sigma_a] = over_edges(over_b, common_b, dot, cross, la, any_order_a, from);
  const auto [to_b, sigma_b] = over_edges(over_a, common, dot, cross, lb, any_order_b, from);
  // Each side takes the better one of the candidates of its two triangles.
  const V from_b = select(mask_cast<T>((upper & 7) == lane), never, permuted(to_b, back));
  const auto takes_b = from_b < to_a;
  const V best = select(takes_b, from_b, to_a), best_sigma = select(takes_b, permuted(sigma_b, back), sigma_a);
  const std::uint32_t lower = lowers<kLabelled>(best, value);
  store_packed(updates.end + updates.count, lower, load<Numbers8>(block.end));
  store_packed(updates.value + updates.count, lower, best);
  store_packed(updates.sigma + updates.count, lower, best_sigma);
  updates.count += static_cast<Index>(std::popcount(lower));
  // The second sides whose own triangle is not the one they take candidates from.
  const Numbers8 returned = permuted(upper, Permutation<4, kLanes>(links)) & 7;
  const V value_b = select(mask_cast<T>(returned == lane), V(0), permuted(value, second));  // 0: done with above
  const std::uint32_t lower_b = lowers<kLabelled>(to_b, value_b);
  if (lower_b == 0) return;
  alignas(64) T candidate[kLanes], its_sigma[kLanes];
  store(candidate, to_b);
  store(its_sigma, sigma_b);
  for (std::uint32_t more = lower_b; more != 0; more &= more - 1) {
    const Index k = static_cast<Index>(std::countr_zero(more));
    updates.add(block.end[lanes.second(k)], candidate[k], its_sigma[k]);
  }
}

// Vertex v updates its neighbours. A ghost has no blocks and updates nothing: its front is corrected, as that of the
// vertex for which it stands.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void update_neighbours(const Rings<T>& rings, MarchState<T>& s, Part<T>& part, Index v,
                                        CandidateUpdates<T>& updates) {
  if constexpr (Front::kHasRadius) correct_curvature(rings, s, v);
  PoppedVertex<T> from{s.front_at[v].value, 0, 0, 0};
  if constexpr (kLabelled) {
    from.label = s.label[v];
    from.start = s.start[from.label];
  }
  from.sigma = Front::kHasRadius ? s.front_at[v].sigma : from.start;
  if (s.layout->is_ghost(v)) return;
  Index i = v;
  do {
    updates.count = 0;
    find_updates<Front, kLabelled>(rings.blocks[i], rings.layout.links[i], s, from, updates);
    for (Index c = 0; c < updates.count; ++c) {
      relax<Front, kLabelled>(s, part, updates.end[c], updates.value[c], updates.sigma[c], from.label);
    }
    i = rings.next_block(v, i);
  } while (i != 0);
}

template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void empty_bucket(const Rings<T>& rings, MarchState<T>& s, Part<T>& part) {
  const Index none = s.layout->vertex_count;
  CandidateUpdates<T> updates;
  for (std::size_t i = 0; i < std::min(part.queue.current().size(), kEndsAhead); ++i) {
    prefetch_ends(rings, s, part.queue.current()[i]);
  }
  for (std::size_t i = 0; i < part.queue.current().size(); ++i) {
    prefetch_after(rings, s, part.queue.current(), i);
    const Index v = part.queue.current()[i];
    if ((s.open[v] & Openness::kOpen) == 0) continue;
    const bool counts = v < none;  // not a ghost
    s.open[v] = static_cast<std::uint8_t>((s.open[v] ^ Openness::kOpen) + counts);
    part.pops += counts;
    update_neighbours<Front, kLabelled>(rings, s, part, v, updates);
  }
  part.queue.clear_current();
}

template <class Front, bool kLabelled, class T>
void march(const Rings<T>& rings, MarchState<T>& s, Index number) {
  Part<T>& part = s.parts[number];
  receive_messages<Front, kLabelled>(s, part);
  for (auto next = part.queue.next(); next <= s.bucket; next = part.queue.next()) {
    part.queue.move_to(next);
    empty_bucket<Front, kLabelled>(rings, s, part);
  }
  const Pile& waiting = part.queue.in(part.queue.next());
  for (std::size_t i = 0; i < std::min(waiting.size(), kStatesAhead); ++i) prefetch_state(rings, s, waiting[i]);
  s.send_news(number);
  for (std::size_t i = 0; i < std::min(waiting.size(), kBlocksAhead); ++i) prefetch_blocks(rings, waiting[i]);
}

template <class T>
MarchPart<T> march_part(FrontModel model, bool labelled) {
  if (model == FrontModel::Planar) return labelled ? march<PlanarFront, true, T> : march<PlanarFront, false, T>;
  return labelled ? march<CircularFront, true, T> : march<CircularFront, false, T>;
}

template <class T>
void march_label_setting(const Rings<T>& rings, MarchState<T>& s, const std::function<void()>& poll) {
  using Entry = std::pair<T, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  Part<T>& whole = s.parts.front();
  for (const Index v : whole.touched) queue.emplace(s.front_at[v].value, v);
  s.fixed_value.resize(s.front_at.size(), MarchState<T>::kUnreached);
  CandidateUpdates<T> updates;
  while (!queue.empty()) {
    const auto [t, v] = queue.top();
    queue.pop();
    if (s.open[v] == 0) continue;
    s.open[v] = 0;
    s.fixed_value[v] = t;
    if (++whole.pops % kSlice == 0) poll();
    const Index label = s.label[v];
    const PoppedVertex<T> from{t, s.start[label], s.start[label], label};
    Index i = v;
    do {
      updates.count = 0;
      find_updates<LiteralCircularFront, true>(rings.blocks[i], rings.layout.links[i], s, from, updates);
      for (Index c = 0; c < updates.count; ++c) {
        const Index w = updates.end[c];
        T& value = s.front_at[w].value;
        if (s.fixed_value[w] != MarchState<T>::kUnreached || !(updates.value[c] < value)) continue;
        if (value == MarchState<T>::kUnreached) whole.touched.push(w);
        value = updates.value[c];
        s.label[w] = label;
        s.open[w] = 1;
        queue.emplace(value, w);
      }
      i = rings.next_block(v, i);
    } while (i != 0);
  }
}

}  // namespace brushfire::fast_marching::BRUSHFIRE_TARGET
