// The march of up to sixteen neighbouring sources together, each in a lane of its own: what does not depend on the
// source (the queue, the records, which offers are worth making) is done once.
#pragma once

#include <brushfire/core/detail/targets.h>
#include <brushfire/solvers/carried_source/detail/group_state.h>

#include <cstdint>
#include <span>

namespace brushfire::carried_source {

// All lanes go by one order, the mean of their values, and a vertex has its turn again where any of them fell. So lanes
// should start close to each other. A lane's values depend on what is in the others, by some hundredths of a percent;
// not on the processor.
class GroupMarch {
 public:
  // More of a vertex, for all lanes together, and values chase each other. (Usual groups need up to a dozen.)
  static constexpr int kMostTurns = 40;

  // Rounding, order and sums are the same for all variants.
  explicit GroupMarch(const Records<float>& records, Variant variant = Variant::Best, int most_turns = kMostTurns);

  // Forgets what the last run left. O(vertices that it touched).
  void reset();
  void begin_at(int lane, Index vertex);
  // `spread`: by how much the values of two lanes may differ at a vertex. Values up to `last` are final. False: some
  // vertex had so many turns that nothing here should be used. Throws Error(Cancelled).
  //
  // Beyond::Ignored: vertices that all lanes reach later than `last` have no turn. A fraction of the work where `last`
  // is near; but the order around them, and with it the rounding of values below, then depends on `last`.
  enum class Beyond : std::uint8_t { Marched, Ignored };
  bool run(float spread, float last, Beyond beyond = Beyond::Marched);

  // +inf: not reached. [kGroupLanes]
  const float* values(Index v) const { return state_.fronts[v].value; }
  const GroupFront& fronts(Index v) const { return state_.fronts[v]; }
  std::uint64_t turns() const { return state_.turns; }
  std::uint64_t updates() const { return state_.updates; }
  const Pile& touched() const { return state_.touched; }

 private:
  const Records<float>& records_;
  GroupState state_;
  float settling_ = 0;
  Variant variant_;
};

}  // namespace brushfire::carried_source
