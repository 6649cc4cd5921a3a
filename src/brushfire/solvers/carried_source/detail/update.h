// The update over one edge (update_kernel.h), for every target; of single numbers as it is compiled for any machine.
#pragma once

#include <brushfire/core/detail/lanes.h>

#include <limits>
#include <type_traits>

namespace brushfire::carried_source {

template <class T>
inline constexpr T kEpsilon = std::numeric_limits<T>::epsilon();

// Values are the same, but for rounding, below this.
template <class T>
inline constexpr T kTie = 1 + 8 * kEpsilon<T>;

// A ray that misses the edge by this share of its length is let through. It would be longer through the end that it
// misses, by the square of that share: by less than rounding.
template <class T>
inline constexpr T kGrazing = std::is_same_v<T, float> ? T(0x1p-12) : T(0x1p-26);

}  // namespace brushfire::carried_source

#define BRUSHFIRE_KERNEL_IS_WIDE
#define BRUSHFIRE_KERNEL <brushfire/solvers/carried_source/detail/update_kernel.h>
#include <brushfire/core/detail/each_target.h>

namespace brushfire::carried_source {

using portable::BendingEnds;
using portable::frame_over;
using portable::Offer;
using portable::offer_beside;
using portable::offer_over;
using portable::OfferFrame;
using portable::source_below;
using portable::SourceAt;
using portable::turn_round;

}  // namespace brushfire::carried_source
