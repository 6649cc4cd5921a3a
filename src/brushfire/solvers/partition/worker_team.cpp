// How many threads there are, and when they have to be started anew.
#include <brushfire/solvers/partition/worker_team.h>

#include <algorithm>

namespace brushfire::partition {

void WorkerTeam::assemble(unsigned requested, std::size_t parts) {
  const std::size_t useful = std::max<std::size_t>(1, parts);
  const auto threads = static_cast<unsigned>(std::min<std::size_t>(thread_count(requested), useful));
  scheduler_.reset(parts, threads);
  const bool bereft = threads_ > 1 && size() == 1;  // in a forked child, nobody came along
  if (threads == threads_ && !bereft) return;
  team_.reset();
  if (threads > 1) team_ = std::make_unique<ThreadTeam>(threads, ThreadTeam::Idle::Spins);
  threads_ = threads;
}

}  // namespace brushfire::partition
