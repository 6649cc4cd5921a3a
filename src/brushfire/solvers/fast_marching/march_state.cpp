// Who works in a round, and which messages are delivered between two rounds.
#include <brushfire/solvers/fast_marching/detail/march_state.h>

#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/prefetch.h>

#include <algorithm>
#include <utility>

namespace brushfire::fast_marching {

template <class T>
MarchState<T>::MarchState(const partition::VertexPartition& shared_out)
    : layout(&shared_out),
      front_at(shared_out.places()),
      open(shared_out.places()),
      parts(shared_out.count()),
      channels(shared_out.channels.size()),
      outlook(shared_out.count()) {
  prefault(front_at);
  std::fill(front_at.begin(), front_at.end(), Front{});
  prefault(open);
  std::fill(open.begin(), open.end(), std::uint8_t{0});
  layout->for_each_shared_vertex([&](Index v) { open[v] = Openness::kShared; });
  std::fill(open.begin() + layout->first_ghost(), open.end(), Openness::kShared);
}

template <class T>
void MarchState<T>::reset() {
  for (const Index p : used) {
    if (parts[p].used) reset_part(p);
  }
  used.clear();
  awake.clear();
  due.clear();
  bucket = -1;
}

template <class T>
void MarchState<T>::reset_part(Index p) {
  Part& part = parts[p];
  const auto forget = [&](Index from, Index to) {
    std::fill(front_at.begin() + from, front_at.begin() + to, Front{});
    std::for_each(open.begin() + from, open.begin() + to, [](std::uint8_t& o) { o &= Openness::kShared; });
    if (!label.empty()) std::fill(label.begin() + from, label.begin() + to, kNoIndex);
    if (!fixed_value.empty()) std::fill(fixed_value.begin() + from, fixed_value.begin() + to, kUnreached);
  };
  if (touched_most(p)) {
    forget(begin(p), end(p));
    forget(layout->first_ghost() + layout->ghost_offset[p], layout->first_ghost() + layout->ghost_offset[p + 1]);
  } else {
    for (const Index place : part.touched) forget(place, place + 1);
  }
  part.queue.reset();
  part.touched.clear();
  part.news.clear();
  for (Pile* in_use : {&part.incoming, &part.outgoing}) {
    for (const Index c : *in_use) channels[c].clear();
    in_use->clear();
  }
  part.pops = 0;
  part.used = part.awake = false;
  outlook[p] = {};
}

template <class T>
void MarchState<T>::seed(Index place, T v, Index source) {
  Front& at = front_at[place];
  if (!(labelled ? std::pair(v, source) < std::pair(at.value, label[place]) : v < at.value)) return;
  Part& part = parts[layout->of(place)];
  part.touched.push_if(at.value == kUnreached, place);
  at = {v, labelled ? start[source] : T(0)};
  if (labelled) label[place] = source;
  part.news.push_if((open[place] & (Openness::kShared | Openness::kNews)) == Openness::kShared, place);
  open[place] = static_cast<std::uint8_t>(open[place] | Openness::kOpen | (open[place] & Openness::kShared) >> 1);
  part.queue.push(place, bucket_of(v));
  wake(layout->of(place));
}

// Those that are woken by the start of a run send what they start with, too.
template <class T>
void MarchState<T>::wake(Index p) {
  Part& part = parts[p];
  if (part.awake) return;
  part.awake = true;
  awake.insert(std::lower_bound(awake.begin(), awake.end(), p), p);
  if (!part.used) used.push_back(p);
  part.used = true;
}

template <class T>
void MarchState<T>::begin_run() {
  ++round;
  due.clear();
  for (const Index p : awake) {
    send_news(p);
    due.push_back({p, outlook[p].load});
  }
}

template <class T>
bool MarchState<T>::next_round() {
  deliver();
  ++round;
  lowest = partition::next_round(awake, bucket, [&](Index p) { return outlook[p]; }, due);
  if (due.empty()) return false;
  bucket = std::max(bucket, lowest);
  load = 0;
  for (const partition::Due& d : due) {
    load += d.load;
    for (const Index c : parts[d.part].incoming) channels[c].flip();
  }
  std::erase_if(awake, [&](Index p) {
    parts[p].awake = outlook[p].bucket != partition::Outlook::kNever;
    return !parts[p].awake;
  });
  return true;
}

template <class T>
void MarchState<T>::deliver() {
  for (const partition::Due& d : due) {
    for (const Index c : parts[d.part].outgoing) {
      const Index to = layout->channels[c].receiver;
      wake(to);
      if (channels[c].announce()) parts[to].incoming.push(c);
      partition::Outlook& waits = outlook[to];
      if (channels[c].lowest_bucket() < waits.bucket) waits = {channels[c].lowest_bucket(), 0};
      if (channels[c].lowest_bucket() == waits.bucket) waits.load += channels[c].sent();
    }
    parts[d.part].outgoing.clear();
  }
}

template <class T>
void MarchState<T>::send_news(Index p) {
  Part& part = parts[p];
  for (const Index place : part.news) prefetch(layout->links_of(place).data());
  for (const Index place : part.news) send(part, place);
  const Bucket next = part.queue.next();
  outlook[p] = {next, part.queue.in(next).size()};
}

template <class T>
void MarchState<T>::send(Part& part, Index place) {
  const Front& at = front_at[place];
  const Bucket falls_into = bucket_of(at.value);
  for (const auto [to, c] : layout->links_of(place)) {
    const Message message{to, labelled ? label[place] : 0, at.value, at.sigma};
    if (channels[c].send(message, falls_into, round)) part.outgoing.push(c);
  }
}

template <class T>
bool MarchState<T>::touched_most(Index p) const {
  const std::size_t ghosts = layout->ghost_offset[p + 1] - layout->ghost_offset[p];
  return parts[p].touched.size() > (end(p) - begin(p) + ghosts) / 4;
}

template <class T>
Index MarchState<T>::end(Index part) const {
  return std::min(layout->vertex_count, (part + 1) << layout->shift);
}

template <class T>
std::size_t MarchState<T>::touched() const {
  std::size_t count = 0;
  for (const Index p : used) count += parts[p].touched.size();
  return count;
}

template <class T>
std::uint64_t MarchState<T>::pops() const {
  std::uint64_t count = 0;
  for (const Index p : used) count += parts[p].pops;
  return count;
}

template struct MarchState<float>;
template struct MarchState<double>;

}  // namespace brushfire::fast_marching
