// The threads of an engine that works on a mesh in parts, round by round.
#pragma once

#include <brushfire/core/parallel.h>
#include <brushfire/solvers/partition/scheduler.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

namespace brushfire::partition {

// The work on a part must not depend on which thread does it: the results are then the same for any number of threads.
class WorkerTeam {
 public:
  // `steal_after`: see Scheduler.
  explicit WorkerTeam(std::chrono::microseconds steal_after) : scheduler_(steal_after) {}

  // As many threads as are asked for (0: one per processor), but not more than there are parts. Called before every
  // run: parts are then given to threads anew.
  void assemble(unsigned requested, std::size_t parts);

  unsigned size() const { return team_ ? team_->size() : 1; }  // threads, the caller counted
  // For other loops; null where the caller is alone.
  ThreadTeam* team() const { return team_.get(); }

  // One round: work(worker, part) for every part that is due, worker < size().
  template <class Work>
  void work(const std::vector<Due>& due, const Work& work) {
    if (!team_) {
      for (const Due& d : due) work(0u, d.part);
      return;
    }
    scheduler_.deal(due);
    // No more than two captures: the function then needs no memory of its own.
    team_->run(team_->size(), [this, &work](unsigned worker, std::size_t) {
      scheduler_.take(worker, [&](Index part) { work(worker, part); });
    });
  }

 private:
  Scheduler scheduler_;
  unsigned threads_ = 1;              // that were wanted; the system may have given fewer
  std::unique_ptr<ThreadTeam> team_;  // where there are several
};

}  // namespace brushfire::partition
