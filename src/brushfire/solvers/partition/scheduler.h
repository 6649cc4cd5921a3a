// Who works on which parts: as evenly as may be, and on the same ones in round after round.
#pragma once

#include <brushfire/core/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <vector>

namespace brushfire::partition {

// A part that works in a round, and about how much is to be done in it.
struct Due {
  Index part;
  std::size_t load;
};

// A part that changes hands takes all its windows from one processor's cache to the other's, which costs about as much
// as working on them. So every thread has parts of its own; some are given away where the loads differ, and a thread
// that is done early helps out.
class Scheduler {
 public:
  // A thread that is done early waits this long for the owner of the last part that is left before stealing it: about
  // what working on a part takes.
  explicit Scheduler(std::chrono::microseconds steal_after) : steal_after_(steal_after) {}

  // Before the first round of a run.
  void reset(std::size_t parts, unsigned threads);
  // The parts of a round, for the threads.
  void deal(const std::vector<Due>& due);
  // All that falls to `thread` in this round, and then what others do not come to: work(part). For all threads at once;
  // when it has returned to one of them, everything has been taken.
  template <class Work>
  void take(unsigned thread, const Work& work) {
    for (const Due& d : *due_) {
      if (owner_[d.part] == thread && claim(d.part)) work(d.part);
    }
    for (Index p = next_to_steal(); p != kNoIndex; p = next_to_steal()) {
      if (claim(p)) work(p);
    }
  }

 private:
  static constexpr unsigned kNobody = ~0u;

  bool claim(Index part) {
    return !taken_[part].load(std::memory_order_relaxed) && !taken_[part].exchange(true, std::memory_order_relaxed);
  }
  // A part to steal: its owner has another one to go before it, or does not come. Waits until there is one; kNoIndex:
  // all are taken.
  Index next_to_steal() const;

  std::chrono::microseconds steal_after_;
  const std::vector<Due>* due_ = nullptr;
  std::vector<unsigned> owner_;           // [parts]
  std::vector<std::size_t> load_;         // [threads]
  std::vector<std::atomic<bool>> taken_;  // [parts]
};

}  // namespace brushfire::partition
