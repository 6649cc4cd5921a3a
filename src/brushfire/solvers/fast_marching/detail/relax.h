// A vertex takes a candidate for its value, or not; and the curvature of the surface corrects its front.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/solvers/fast_marching/detail/candidate_updates.h>
#include <brushfire/solvers/fast_marching/detail/march_state.h>
#include <brushfire/solvers/fast_marching/detail/ring_blocks.h>

#include <algorithm>
#include <cstdint>

namespace brushfire::fast_marching {

template <class T>
using Part = typename MarchState<T>::Part;

// On curved surfaces values can chase each other in circles for hundreds of rounds, ever lower; the limit ends that.
inline constexpr std::uint8_t kMaxPops = 3;

// Equal values go to the lower label.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void relax(MarchState<T>& s, Part<T>& part, Index w, T candidate, T sigma, Index label) {
  auto& at = s.front_at[w];
  const T old = at.value;
  const std::uint8_t state = s.open[w];
  if ((state & Openness::kPops) >= kMaxPops) return;
  if constexpr (kLabelled) {
    if (!(candidate < old * kFalls<T>) && !(candidate <= old && label < s.label[w])) return;
    s.label[w] = label;
  } else {
    if (!(candidate < old * kFalls<T>)) return;
  }
  at.value = candidate;
  if constexpr (Front::kHasRadius) at.sigma = sigma;
  const BucketQueue::Bucket bucket = s.bucket_of(candidate);
  // Where it waits already, in the same bucket, that will do.
  const bool waits = ((state & Openness::kOpen) != 0) & (bucket == s.bucket_of(old));
  s.open[w] = state | Openness::kOpen;
  part.touched.push_if(old == MarchState<T>::kUnreached, w);
  if ((state & (Openness::kShared | Openness::kNews)) == Openness::kShared) [[unlikely]] {
    s.open[w] = state | Openness::kOpen | Openness::kNews;
    part.news.push(w);
    s.layout->prefetch_links(w);
  }
  part.queue.push_if(!waits, w, bucket);
}

// Gaussian curvature flattens the front that passes over it: its curvature 1/r falls by that of the way (the
// Riccati equation of geodesic circles). Bounded so that no vertex makes it hollow, and it stays a circle.
template <class T>
BRUSHFIRE_INLINE void correct_curvature(const Rings<T>& rings, MarchState<T>& s, Index v) {
  const T correction = rings.heads[v].correction;
  auto& at = s.front_at[v];
  const T radius = at.value - at.sigma;
  if (correction == 0 || !(radius > 0)) return;
  // 1/after = 1/(1/radius - correction); the bounds are those of the radius.
  constexpr T kMostPerVertex = 2, kFlattest = 8;
  const T shrinking = 1 - correction * radius;
  const T largest = std::max(radius, std::min(kMostPerVertex * radius, kFlattest * at.value));
  const T after = shrinking > 1 / kFlattest ? radius / shrinking : largest;
  at.sigma = at.value - std::clamp(after, radius / kMostPerVertex, largest);
}

}  // namespace brushfire::fast_marching
