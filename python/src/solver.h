// _core.Solver: the workspace of runs on one mesh, for everything that reads a field.
#pragma once

#include "bind.h"

#include <mutex>

namespace brushfire::python {

// Calls from several threads wait for each other.
class Solver {
 public:
  explicit Solver(const Domain& domain) : solver_(domain) {}

  const Domain& domain() const { return solver_.domain(); }
  const Mesh& mesh() const { return solver_.mesh(); }

  // use(DistanceSolver&), while nobody else does. Without the GIL: who waits for the solver must not hold it.
  template <class Use>
  auto with(Use&& use) {
    const std::lock_guard lock(mutex_);
    return use(solver_);
  }

 private:
  DistanceSolver solver_;
  std::mutex mutex_;
};

}  // namespace brushfire::python
