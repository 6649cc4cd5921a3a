// Dealing out the parts of a round.
#include <brushfire/solvers/partition/scheduler.h>

#include <algorithm>

namespace brushfire::partition {

void Scheduler::reset(std::size_t parts, unsigned threads) {
  owner_.assign(parts, kNobody);
  load_.assign(threads, 0);
  if (taken_.size() != parts) taken_ = std::vector<std::atomic<bool>>(parts);
}

void Scheduler::deal(const std::vector<Due>& due) {
  due_ = &due;
  std::fill(load_.begin(), load_.end(), 0);
  std::size_t total = 0;
  for (const Due& d : due) {
    taken_[d.part].store(false, std::memory_order_relaxed);
    if (owner_[d.part] != kNobody) load_[owner_[d.part]] += d.load;
    total += d.load;
  }
  // An eighth more than the mean is left alone.
  const std::size_t most = total / load_.size() + total / (8 * load_.size());
  for (const Due& d : due) {
    unsigned& owner = owner_[d.part];
    const auto least = static_cast<unsigned>(std::min_element(load_.begin(), load_.end()) - load_.begin());
    const bool moves = owner == kNobody || (load_[owner] > most && load_[least] + d.load < load_[owner]);
    if (!moves) continue;
    if (owner != kNobody) load_[owner] -= d.load;
    load_[least] += d.load;
    owner = least;
  }
}

Index Scheduler::next_to_steal() const {
  std::chrono::steady_clock::time_point begin{};  // of waiting
  while (true) {
    std::size_t count = 0;
    Index last = kNoIndex;
    for (const Due& d : *due_) {
      if (taken_[d.part].load(std::memory_order_relaxed)) continue;
      ++count;
      last = d.part;
    }
    if (count != 1 || steal_after_.count() == 0) return last;
    const auto now = std::chrono::steady_clock::now();
    if (begin == std::chrono::steady_clock::time_point{}) begin = now;
    if (now - begin > steal_after_) return last;
  }
}

}  // namespace brushfire::partition
