// How long a vertex may wait for another one's offer.
#pragma once

#include <brushfire/core/detail/lanes.h>

namespace brushfire::carried_source {

// Of an offer of v over an edge to the target: see SideEnd.
template <class V>
struct Need {
  V need{}, bulge{};
};

// How much later than v, at least, the front reaches the target: it lies on the line from b to the target, or farther
// from v. Let that line have the distance h from v, and v's foot the distance m from the target: a source at distance r
// from v, r >= |vb|, beyond the edge, reaches the target from at least m + sqrt(r^2 - h^2) away; and
// r - sqrt(r^2 - h^2) <= h^2 / (2 (r - h)). `along`: from v to the target, from_other: from b, length: from v to b.
// Of numbers, or of lanes.
template <class V>
BRUSHFIRE_INLINE Need<V> need_of(V along, V from_other, V length) {
  using namespace lanes::portable;
  const V zero = V(NumberIn<V>(0)), one = V(NumberIn<V>(1)), half = V(NumberIn<V>(0.5));
  const V shorter = lesser(along, from_other), longer = greater(along, from_other);
  const V product = half * (shorter * shorter + (longer - length) * (longer + length));
  const auto apart = zero < from_other;
  const V unbound = product / select(apart, from_other, one);
  const V foot = select(apart, lesser(greater(unbound, zero - along), along), zero);
  return {foot, half * select(zero < foot, (along - foot) * (along + foot), along * along)};
}

}  // namespace brushfire::carried_source
