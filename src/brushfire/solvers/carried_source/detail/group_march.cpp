// Buckets of the lanes' mean, one kernel for each target. (Compiled without math errno and floating-point traps.)
#include <brushfire/solvers/carried_source/detail/group_march.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/lanes.h>
#include <brushfire/core/detail/prefetch.h>
#include <brushfire/solvers/carried_source/detail/march_constants.h>
#include <brushfire/solvers/carried_source/detail/offer_frame.h>
#include <brushfire/solvers/carried_source/detail/update.h>

#include <algorithm>
#include <bit>

namespace brushfire::carried_source {
namespace {

constexpr std::size_t kOffsetAhead = 16, kRecordAhead = 8, kEndsAhead = 3, kRecordLines = 10, kCacheLine = 64;
constexpr Index kUsualSides = 8;

BRUSHFIRE_INLINE BucketQueue::Bucket group_bucket(float bucket) {
  constexpr float kLast = 0x1p60f;
  return static_cast<BucketQueue::Bucket>(bucket < kLast ? bucket : kLast);
}

}  // namespace
}  // namespace brushfire::carried_source

#define BRUSHFIRE_KERNEL_IS_WIDE
#define BRUSHFIRE_KERNEL <brushfire/solvers/carried_source/detail/group_march_kernel.h>
#include <brushfire/core/detail/each_target.h>

namespace brushfire::carried_source {

GroupMarch::GroupMarch(const Records<float>& records, Variant variant, int most_turns)
    : records_(records), variant_(variant) {
  GroupState& s = state_;
  s.most_turns = most_turns;
  s.fronts.resize(records.vertex_count);
  for (Index v = 0; v < records.vertex_count; ++v) {
    GroupFront& f = s.fronts[v];
    f.own = {};
    f.own.around = records.around[v];
    std::fill_n(f.value, kGroupLanes, GroupState::kUnreached);
    std::fill_n(f.sigma, kGroupLanes, GroupState::kUnreached);
    std::fill_n(f.x, kGroupLanes, 0.0f), std::fill_n(f.y, kGroupLanes, 0.0f);
    std::fill_n(f.sector, kGroupLanes, SectorSet{1});
  }
  // One more than there can be: the last one is written and not counted.
  s.ahead.resize(records.most_sides + 1), s.alongs.resize(records.most_sides + 1);
  s.closed.resize(records.most_sides), s.offers.resize(records.most_updates + 1);
  s.per_unit = static_cast<float>(1 / (kBucketWidth * records.mean_edge));
  s.slack = static_cast<float>(kSlack * records.mean_edge);
  s.farther = static_cast<float>(kFarther * records.mean_edge);
  settling_ = static_cast<float>(kSettling * records.mean_edge);
}

void GroupMarch::reset() {
  GroupState& s = state_;
  // Also of the vertices that fell, but that a run which was given up did not come to.
  const auto forget = [&s](Index v) {
    std::fill_n(s.fronts[v].value, kGroupLanes, GroupState::kUnreached);
    const Around<float> around = s.fronts[v].own.around;
    s.fronts[v].own = {};
    s.fronts[v].own.around = around;
  };
  for (const Index v : s.touched) forget(v);
  for (const Index v : s.fallen) forget(v);
  s.touched.clear(), s.fallen.clear(), s.pass.clear();
  s.queue.reset();
  s.settled = 0, s.exhausted = false;
  s.turns = s.updates = 0;
  s.lanes = 0;
}

void GroupMarch::begin_at(int lane, Index vertex) {
  GroupState& s = state_;
  GroupFront& f = s.fronts[vertex];
  f.value[lane] = f.sigma[lane] = f.x[lane] = f.y[lane] = 0;
  f.sector[lane] = 1;
  GroupVertex& own = s.fronts[vertex].own;
  own.fresh |= 1u << lane;
  ++s.lanes;
  s.fallen.push_if(!own.listed, vertex);
  own.listed = true;
}

bool GroupMarch::run(float spread, float last, Beyond beyond) {
  GroupState& s = state_;
  s.beyond = beyond == Beyond::Ignored ? last : GroupState::kUnreached;
  s.rim = s.beyond + settling_;
  s.later = kLater * spread / static_cast<float>(s.lanes);
  do {
    const float front = static_cast<float>(s.queue.cursor()) / s.per_unit - (1 + kLater) * spread - settling_;
    if (front > last) return true;
    s.settled = std::max(0.0f, front);
    stop_if_cancelled();
    BRUSHFIRE_ON_WIDE_TARGET(variant_, work_group(s, records_));
  } while (!s.exhausted && s.queue.advance());
  return !s.exhausted;
}

}  // namespace brushfire::carried_source
