// The march: takes vertices from the queue in order of their values and offers values to the rings around them.
#pragma once

#include <brushfire/core/bucket_queue.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/fast_marching/ring_blocks.h>
#include <brushfire/solvers/fast_marching/vector_target.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace brushfire::detail {

enum class FrontModel : std::uint8_t { Circular, LiteralCircular, Planar };

// The state of one run, by place in the ring layout, kept between runs: reset() costs what the last run touched.
// The entry beyond the last vertex stands for "no vertex": never reached.
template <class T>
struct MarchState {
  static constexpr T kUnreached = std::numeric_limits<T>::infinity();

  // Side by side, as who needs the one needs the other.
  struct Front {
    T value = kUnreached;  // >= 0; +inf: not reached yet
    T root = 0;            // value minus radius of the front that brought it (circular fronts)
  };

  std::vector<Front> front_at;     // [vertex_count + 1]
  std::vector<std::uint8_t> open;  // [vertex_count + 1] the value has not been offered to the neighbours yet
  std::vector<Index> label;        // [vertex_count + 1] where labelled
  std::vector<T> start;            // [labels] the value that each label's front started with
  Pile touched;                    // places with a value
  std::vector<T> fixed_value;      // [vertex_count + 1], label-setting only: the value once it is fixed
  BucketQueue queue;
  T buckets_per_unit = 1;
  T front = 0;            // the lower end of the current bucket: what is below is final
  bool labelled = false;  // several sources or offsets: fronts of different labels do not mix
  std::uint64_t pops = 0;

  // Whether going through all vertices costs less than through those that were touched.
  bool touched_most() const { return touched.size() > front_at.size() / 4; }

  void resize(Index vertex_count);
  void reset();
  BucketQueue::Bucket bucket_of(T v) const;
  void offer(Index place, T v, Index source);  // from outside the march: keeps the lowest (value, label)
};

// Takes up to kSlice vertices from the current bucket, from number `begin` on, and offers their values to their
// neighbours; what improves a vertex puts it back into the queue. Returns the number to go on with.
inline constexpr std::size_t kSlice = 8192;

template <class T>
using MarchSlice = std::size_t (*)(const Rings<T>&, MarchState<T>&, std::size_t begin);

template <class T>
MarchSlice<T> march_slice(FrontModel model, bool labelled, Variant variant = Variant::Best);

// Label-setting in strict order, as the paper of 2002 has it, to the end: its values need not grow along the way, so
// there is no radius to stop at. Calls `poll` every kSlice vertices.
template <class T>
void march_label_setting(const Rings<T>& rings, MarchState<T>& state, const std::function<void()>& poll);

}  // namespace brushfire::detail
