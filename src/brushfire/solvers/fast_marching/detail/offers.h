// What a vertex offers to the ends of the sides of a block: in loops that compilers turn into vector instructions, as
// far as these go.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/fast_marching/detail/march.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>
#include <brushfire/solvers/fast_marching/detail/triangle_update.h>

#include <limits>

namespace brushfire::fast_marching {

// A value has to fall by more than rounding to be news: otherwise two ways of equal length would chase each other.
template <class T>
inline constexpr T kNews = 1 - 4 * std::numeric_limits<T>::epsilon();

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

}  // namespace brushfire::fast_marching
