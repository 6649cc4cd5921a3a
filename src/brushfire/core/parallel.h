// Parallel loops: a team of threads that shares out the numbers from 0 on, and sleeps in between.
#pragma once

#include <brushfire/core/progress.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace brushfire {

// How many threads a caller's number stands for: 0 means one per processor; 1 where the platform has no threads.
unsigned thread_count(unsigned requested) noexcept;

// A fixed number of threads, the calling one among them, for one loop after the other. Where the platform has no
// threads (WebAssembly without them) everything runs in the caller; also in a forked child of the process that made the
// team, where its size is 1. (Fork between loops, not within one.)
class ThreadTeam {
 public:
  // worker < size() numbers the thread, index the piece of work.
  using Body = std::function<void(unsigned worker, std::size_t index)>;
  // What threads do while they wait for work. Sleeps: they block. Spins: for the first 50 us they look
  // for the next loop again and again, for loops of microseconds in quick succession. (Yielding instead is cheap on an
  // idle machine; on a loaded one it gives away milliseconds at a time.)
  enum class Idle : std::uint8_t { Sleeps, Spins };

  explicit ThreadTeam(unsigned threads, Idle idle = Idle::Sleeps);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  unsigned size() const noexcept;  // threads, the caller counted

  // Calls body once for every index in [0, count), and returns when all are done. The indices are given out one by
  // one, ascending; who gets which is left to chance, so whatever body computes must depend on the index alone, and
  // the result is then the same for any number of threads. The caller is worker 0 and works too; threads that have not
  // come by the time all indices are given out are not waited for.
  //
  // When a body throws, or `cancel` is set, no further index is given out; once the running ones are done the exception
  // of the lowest index is thrown, or else Error(Cancelled). Everything written in a body is visible afterwards. In
  // every body the thread listens to what the caller listens to (see cancel.h).
  void run(std::size_t count, const Body& body, const CancelToken* cancel = nullptr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// One loop on a team of its own. Costs some 20 us per thread.
void parallel_for(std::size_t count, unsigned threads, const ThreadTeam::Body& body,
                  const CancelToken* cancel = nullptr);

}  // namespace brushfire
