// What a part is told of by the others before its round.
#pragma once

#include <brushfire/core/detail/inline.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/fast_marching/detail/march_state.h>
#include <brushfire/solvers/fast_marching/detail/relax.h>

#include <algorithm>
#include <cstdint>

namespace brushfire::fast_marching {

// A part's news are told; who saw them is free to have others.
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
BRUSHFIRE_INLINE void hear(MarchState<T>& s, Part<T>& part, const typename MarchState<T>::Letter& letter) {
  const Index ghost = letter.place;
  auto& at = s.front_at[ghost];
  bool falls = letter.value < at.value;
  if constexpr (kLabelled) falls |= letter.value == at.value && letter.label < s.label[ghost];
  if (!falls) return;  // it fell further by a candidate of this part, or this is where its value came from
  part.touched.push_if(at.value == MarchState<T>::kUnreached, ghost);
  at = {letter.value, letter.sigma};
  if constexpr (kLabelled) s.label[ghost] = letter.label;
  if constexpr (Front::kHasRadius) {
    s.open[ghost] |= Openness::kOpen;
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
      relax<Front, kLabelled>(s, part, letter.place, letter.value, letter.sigma, letter.label);
    }
    channel.letters[1 - channel.writes].clear();
    channel.waits = false;
  }
  part.inbox.clear();
}

}  // namespace brushfire::fast_marching
