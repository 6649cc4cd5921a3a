// Who works on which parts: as evenly as may be, and on the same ones in round after round.
#pragma once

#include <brushfire/core/types.h>

#include <atomic>
#include <chrono>
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

  // Who is done early waits this long for the owner of the last part that is left to come, before taking it away: about
  // what working on a part takes.
  explicit Shares(std::chrono::microseconds patience) : patience_(patience) {}

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
    for (Index p = left_over(); p != kNoIndex; p = left_over()) {
      if (claim(p)) work(p);
    }
  }

 private:
  static constexpr unsigned kNobody = ~0u;

  bool claim(Index part) {
    return !taken_[part].load(std::memory_order_relaxed) && !taken_[part].exchange(true, std::memory_order_relaxed);
  }
  // A part to help out with: its owner has another one to go before it, or does not come. Waits until there is one;
  // kNoIndex: all are taken.
  Index left_over() const;

  std::chrono::microseconds patience_;
  const std::vector<Due>* due_ = nullptr;
  std::vector<unsigned> owner_;           // [parts]
  std::vector<std::size_t> load_;         // [threads]
  std::vector<std::atomic<bool>> taken_;  // [parts]
};

}  // namespace brushfire::detail
