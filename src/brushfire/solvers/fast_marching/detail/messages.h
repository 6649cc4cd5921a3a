// What a part receives from the others before its round.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/fast_marching/detail/march_state.h>
#include <brushfire/solvers/fast_marching/detail/relax.h>

#include <algorithm>
#include <cstdint>

namespace brushfire::fast_marching {

// A part's news have been sent; who saw them is free to have others.
template <class T>
void forget_news(MarchState<T>& s, Part<T>& part) {
  for (const Index v : part.news) s.open[v] &= static_cast<std::uint8_t>(~Openness::kNews);
  part.news.clear();
}

// Whether a value fell and went on to its neighbours in the part's last round.
template <class T>
bool was_rash(const MarchState<T>& s, Index v) {
  return (s.open[v] & (Openness::kNews | Openness::kOpen)) == Openness::kNews;
}

// Two neighbours that both were rash in the same round did not see each other: the later one is taken up again, which
// does not count.
template <class T>
void see_each_other(MarchState<T>& s, Part<T>& part, Index ghost, T fell_to) {
  const Index owner = s.layout->owner[ghost - s.layout->first_ghost()];
  for (const Index v : s.layout->around(ghost)) {
    const T value = s.front_at[v].value;
    if (!was_rash(s, v) || value < fell_to || (value == fell_to && v < owner)) continue;
    if ((s.open[v] & Openness::kLatePops) == Openness::kLatePops) continue;
    s.open[v] = Openness::forgiven(s.open[v]) | Openness::kOpen;
    part.queue.push(v, s.bucket_of(value));
  }
}

// A ghost's vertex fell.
template <class Front, bool kLabelled, class T>
BRUSHFIRE_INLINE void receive(MarchState<T>& s, Part<T>& part, const typename MarchState<T>::Message& message) {
  const Index ghost = message.place;
  auto& at = s.front_at[ghost];
  bool falls = message.value < at.value;
  if constexpr (kLabelled) falls |= message.value == at.value && message.label < s.label[ghost];
  if (!falls) return;  // it fell further by a candidate of this part, or this is where its value came from
  part.touched.push_if(at.value == MarchState<T>::kUnreached, ghost);
  at = {message.value, message.sigma};
  if constexpr (kLabelled) s.label[ghost] = message.label;
  if constexpr (Front::kHasRadius) {
    s.open[ghost] |= Openness::kOpen;
    part.queue.push(ghost, s.bucket_of(message.value));
  }
}

// The messages about ghosts first: which values of this part fell in the last round is still known.
template <class Front, bool kLabelled, class T>
void receive_messages(MarchState<T>& s, Part<T>& part) {
  if (part.last_round + 1 != s.round) forget_news(s, part);
  part.last_round = s.round;
  for (const Index c : part.incoming) {
    const auto& channel = s.channels[c];
    for (const auto& message : channel.received()) {
      prefetch(&s.front_at[message.place]);
      prefetch(&s.open[message.place]);
    }
  }
  const bool rash = std::any_of(part.news.begin(), part.news.end(), [&](Index v) { return was_rash(s, v); });
  for (const Index c : part.incoming) {
    const auto& channel = s.channels[c];
    for (const auto& message : channel.received()) {
      if (!s.layout->is_ghost(message.place)) continue;
      receive<Front, kLabelled>(s, part, message);
      if (rash && s.bucket_of(message.value) <= s.bucket) see_each_other(s, part, message.place, message.value);
    }
  }
  forget_news(s, part);
  for (const Index c : part.incoming) {
    auto& channel = s.channels[c];
    for (const auto& message : channel.received()) {
      if (s.layout->is_ghost(message.place)) continue;
      std::uint8_t& state = s.open[message.place];
      if (message.value < s.front_at[message.place].value) state = Openness::forgiven(state);
      relax<Front, kLabelled>(s, part, message.place, message.value, message.sigma, message.label);
    }
    channel.clear_received();
  }
  part.incoming.clear();
}

}  // namespace brushfire::fast_marching
