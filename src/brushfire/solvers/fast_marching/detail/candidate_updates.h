// Values that a vertex has for its neighbours, before it is said which of them are taken.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>

#include <limits>

namespace brushfire::fast_marching {

// By how much a value has to fall: by more than rounding, otherwise two ways of equal length would chase each other.
template <class T>
inline constexpr T kFalls = 1 - 4 * std::numeric_limits<T>::epsilon();

// The vertex that was taken from the queue. Sigma: the value at the centre of its front, which is its value less the
// front's radius (fronts that have one; otherwise the value that its label started with).
template <class T>
struct PoppedVertex {
  T value, sigma;
  T start;  // of its label
  Index label;
};

// The candidate updates of a block that improve, or seem to: several may be for one vertex.
template <class T>
struct CandidateUpdates {
  static constexpr Index kRoom = 3 * kLanes;  // whole registers are written
  alignas(64) Index end[kRoom];
  alignas(64) T value[kRoom];
  alignas(64) T sigma[kRoom];
  Index count = 0;

  BRUSHFIRE_INLINE void add(Index w, T candidate, T its_sigma) {
    end[count] = w, value[count] = candidate, sigma[count] = its_sigma;
    ++count;
  }
};

}  // namespace brushfire::fast_marching
