// How long a vertex may wait for another one's offer.
#pragma once

#include <brushfire/core/detail/inline.h>

#include <algorithm>

namespace brushfire::carried_source {

// Of an offer of v over an edge to the target: see SideEnd.
template <class T>
struct Need {
  T need = 0, bulge = 0;
};

// How much later than v, at least, the front reaches the target: it lies on the line from b to the target, or farther
// from v. Let that line have the distance h from v, and v's foot the distance m from the target: a source at distance r
// from v, r >= |vb|, beyond the edge, reaches the target from at least m + sqrt(r^2 - h^2) away; and
// r - sqrt(r^2 - h^2) <= h^2 / (2 (r - h)). `along`: from v to the target, from_other: from b, length: from v to b.
template <class T>
BRUSHFIRE_INLINE Need<T> need_of(T along, T from_other, T length) {
  const T shorter = std::min(along, from_other), longer = std::max(along, from_other);
  const T product = T(0.5) * (shorter * shorter + (longer - length) * (longer + length));
  const T foot = from_other > 0 ? std::clamp(product / from_other, -along, along) : T(0);
  return {foot, T(0.5) * (foot > 0 ? (along - foot) * (along + foot) : along * along)};
}

}  // namespace brushfire::carried_source
