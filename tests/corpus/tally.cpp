// Sums and tables.
#include "corpus/tally.h"

#include <algorithm>
#include <cstdio>

namespace brushfire::corpus {
namespace {

using Count = unsigned long long;

}  // namespace

void Tally::add(const Task& task, const Outcome& o) {
  using Kind = Task::Kind;
  unsure += o.unsure;
  if (task.kind == Kind::Truth) {
    no_truth += o.ending != Ending::Done;
    return;
  }
  hung += o.ending == Ending::Hung;
  crashed += o.ending == Ending::Crashed;
  refused += o.ending == Ending::Refused;
  if (task.kind == Kind::Paths) {
    paths += o.compared;
    lost += o.lost;
    path_beyond += o.beyond;
    path_worst = std::max(path_worst, o.worst);
  } else if (task.kind == Kind::Windows) {
    window_violations += o.beyond + o.unbound;
  } else if (task.of_windows()) {
    side_violations += o.beyond;
  } else if (task.kind == Kind::Other) {
    other_beyond += o.beyond;
  } else {
    compared += o.compared;
    beyond += o.beyond;
    unbound += o.unbound;
    worst = std::max(worst, o.worst);
  }
}

void Tally::add(const Tally& t) {
  compared += t.compared, beyond += t.beyond, unbound += t.unbound;
  hung += t.hung, crashed += t.crashed, refused += t.refused;
  paths += t.paths, lost += t.lost, path_beyond += t.path_beyond;
  window_violations += t.window_violations, side_violations += t.side_violations, other_beyond += t.other_beyond;
  no_truth += t.no_truth, unsure += t.unsure;
  worst = std::max(worst, t.worst), path_worst = std::max(path_worst, t.path_worst);
}

std::uint64_t Tally::wrong() const {
  return beyond + unbound + hung + crashed + refused + lost + path_beyond + window_violations + side_violations +
         other_beyond;
}

void print_head_of_families() {
  std::printf(
      "| family | cases | compared | beyond | worst | bound broken | hangs | crashes | errors | paths | lost | off the "
      "field | worst | windows | lower, upper | others | no truth | oracle unsure |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
}

void print_row(const std::string& name, std::uint64_t cases, const Tally& t) {
  std::printf(
      "| %s | %llu | %llu | %llu | %.1e | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %.1e | %llu | %llu | %llu | "
      "%llu | %llu |\n",
      name.c_str(), Count{cases}, Count{t.compared}, Count{t.beyond}, t.worst, Count{t.unbound}, Count{t.hung},
      Count{t.crashed}, Count{t.refused}, Count{t.paths}, Count{t.lost}, Count{t.path_beyond}, t.path_worst,
      Count{t.window_violations}, Count{t.side_violations}, Count{t.other_beyond}, Count{t.no_truth}, Count{t.unsure});
  std::fflush(stdout);
}

void LawTally::add(const std::string& name, const Outcome& o) {
  compared += o.compared;
  beyond += o.beyond;
  hung += o.ending == Ending::Hung;
  crashed += o.ending == Ending::Crashed;
  refused += o.ending == Ending::Refused;
  worst = std::max(worst, o.worst);
  if (o.seconds <= slowest) return;
  slowest = o.seconds;
  slowest_at = name;
}

void print_head_of_laws() {
  std::printf(
      "| meshes | number | compared | beyond | worst | hangs | crashes | errors | slowest | |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|---|\n");
}

void print_row(const std::string& name, const LawTally& t) {
  std::printf("| %s | %llu | %llu | %llu | %.1e | %llu | %llu | %llu | %.2f s | %s |\n", name.c_str(), Count{t.meshes},
              Count{t.compared}, Count{t.beyond}, t.worst, Count{t.hung}, Count{t.crashed}, Count{t.refused}, t.slowest,
              t.slowest_at.c_str());
  std::fflush(stdout);
}

}  // namespace brushfire::corpus
