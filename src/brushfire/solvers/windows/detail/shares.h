// Who works on which parts: as evenly as may be, and on the same ones in round after round.
#pragma once

#include <brushfire/core/types.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace brushfire::detail {

// A part that changes hands takes all its windows from one processor's cache to the other's, which costs about as much
// as working on them. So every thread has parts of its own; some are given away where the loads differ, and who is done
// early helps out.
class Shares {
 public:
  struct Due {
    Index part;
    std::size_t load;
  };

  // Before the first round of a run.
  void reset(std::size_t parts, unsigned threads);
  // The parts of a round, for the threads.
  void deal(const std::vector<Due>& due);
  // All that falls to `thread` in this round, and then what others have not begun: work(part). For all threads at once.
  template <class Work>
  void take(unsigned thread, const Work& work) {
    for (const bool own : {true, false}) {
      for (const Due& d : *due_) {
        if ((owner_[d.part] == thread) != own || taken_[d.part].load(std::memory_order_relaxed)) continue;
        if (!taken_[d.part].exchange(true, std::memory_order_relaxed)) work(d.part);
      }
    }
  }

 private:
  static constexpr unsigned kNobody = ~0u;

  const std::vector<Due>* due_ = nullptr;
  std::vector<unsigned> owner_;           // [parts]
  std::vector<std::size_t> load_;         // [threads]
  std::vector<std::atomic<bool>> taken_;  // [parts]
};

}  // namespace brushfire::detail
