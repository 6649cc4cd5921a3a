// What a march of several sources at once keeps: sixteen fronts at every vertex, one to a lane.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/solvers/carried_source/detail/records.h>

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace brushfire::carried_source {

inline constexpr int kGroupLanes = 16;

// What lanes share at a vertex.
struct GroupVertex {
  static constexpr std::uint32_t kLanes = (1u << kGroupLanes) - 1, kNew = kLanes + 1;
  static constexpr BucketQueue::Bucket kNowhere = BucketQueue::kNever;

  // The lanes that fell since the vertex's last turn; kNew: it had none. 0: it is closed.
  std::uint32_t fresh = kNew;
  std::uint16_t turns = 0;
  bool reached = false, listed = false;  // stands in touched, in fallen
  // The lanes in which a neighbour had a turn since, and left the offers over the edge between them to this vertex.
  std::uint32_t owed = 0;
  BucketQueue::Bucket waits_in = kNowhere;
  Around<float> around;  // of the vertex; stays

  bool waits_for_turn() const { return ((fresh & kLanes) | owed) != 0; }
};

// The fronts of all sources at a vertex, in five cache lines. Where a lane has no value, +inf, the rest of it means
// nothing.
struct alignas(64) GroupFront {
  float value[kGroupLanes], sigma[kGroupLanes], x[kGroupLanes], y[kGroupLanes];
  std::uint16_t sector[kGroupLanes];  // a bit, of a SectorSet
  GroupVertex own;
};
static_assert(sizeof(GroupFront) == 5 * 64);

struct GroupState {
  static constexpr float kUnreached = std::numeric_limits<float>::infinity();

  UninitializedArray<GroupFront> fronts;  // [vertex_count]
  BucketQueue queue;
  Pile touched, fallen;  // fallen: may have fallen in this pass
  std::vector<Index> pass;
  std::vector<std::pair<float, Index>> next;  // of this bucket, by key
  // Of the turn at hand.
  std::vector<Index> ahead, alongs;  // sides
  std::vector<std::uint8_t> closed;  // by side
  struct PlannedOffer {
    Index side = 0;
    Update update;
  };
  std::vector<PlannedOffer> offers;
  float per_unit = 1, slack = 0, farther = 0;  // of the mesh
  int most_turns = 0;                          // of a vertex
  float settled = 0;                           // values below no longer change
  int lanes = 0;                               // that began
  float later = 0;                             // what a lane without a value adds to a key
  float beyond = kUnreached;                   // a vertex all of whose values are greater has no turn
  float rim = kUnreached;                      // lanes whose value is greater are no reason for a turn
  bool exhausted = false;                      // a vertex used up its turns
  std::uint64_t turns = 0, updates = 0;
};

}  // namespace brushfire::carried_source
