// Which parts work in a round.
#pragma once

#include <brushfire/solvers/partition/scheduler.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace brushfire::partition {

// The lowest bucket in which something waits, and about how much is in it.
struct Outlook {
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  std::int64_t bucket = kNever;
  std::size_t load = 0;
};

// The lowest bucket in which any of the parts `active` has something: Outlook::kNever where nothing waits. `due`: those
// that have something up to there, or up to `at_least` where that is higher, in the order of `active`.
// `outlook_of(part)` is an Outlook.
template <class OutlookOf>
std::int64_t next_round(const std::vector<Index>& active, std::int64_t at_least, const OutlookOf& outlook_of,
                        std::vector<Due>& due) {
  std::int64_t lowest = Outlook::kNever;
  due.clear();
  for (const Index p : active) {
    const Outlook outlook = outlook_of(p);
    if (outlook.bucket == Outlook::kNever || outlook.bucket > std::max(lowest, at_least)) continue;
    if (outlook.bucket < lowest && lowest > at_least) due.clear();
    lowest = std::min(lowest, outlook.bucket);
    due.push_back({p, outlook.load});
  }
  return lowest;
}

}  // namespace brushfire::partition
