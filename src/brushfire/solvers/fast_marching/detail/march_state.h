// The state of a march, in parts, and the rounds in which the parts work.
//
// Every part of the mesh has a queue of its own and empties its buckets by itself. A round: each part that has work in
// the current bucket receives its messages, empties the bucket, and sends messages about what concerns others. There
// are as many rounds for a bucket as it takes until no message falls into it. What a part does in a round depends on
// nothing that others do in the same round, so it does not matter who works on which part, and when.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/core/types.h>
#include <brushfire/solvers/partition/message_buffer.h>
#include <brushfire/solvers/partition/rounds.h>
#include <brushfire/solvers/partition/vertex_partition.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace brushfire::fast_marching {

// The state byte of a vertex.
struct Openness {
  static constexpr std::uint8_t kOpen = 128;   // the value has not gone on to the neighbours yet
  static constexpr std::uint8_t kShared = 64;  // stays: the place is a ghost or has some
  static constexpr std::uint8_t kNews = 32;    // of a shared place: its value fell in this round (or the last one)
  // How often the vertex was taken from the queue; and how often because a part learnt late of another one, which does
  // not count as long as these bits last.
  static constexpr std::uint8_t kPops = 3;
  static constexpr std::uint8_t kLatePops = 28, kOneLatePop = 4;

  // With one time that does not count, if there was any and there may be more of these.
  static constexpr std::uint8_t forgiven(std::uint8_t state) {
    const bool may = (state & kPops) != 0 && (state & kLatePops) != kLatePops;
    return static_cast<std::uint8_t>(may ? state - 1 + kOneLatePop : state);
  }
};

// The state of one run, by place in the ring layout, kept between runs: reset() costs what the last run touched.
// The entry beyond the last vertex stands for "no vertex": never reached. Ghosts follow.
template <class T>
struct MarchState {
  static constexpr T kUnreached = std::numeric_limits<T>::infinity();
  using Bucket = BucketQueue::Bucket;

  // Side by side, as who needs the one needs the other.
  struct Front {
    T value = kUnreached;  // >= 0; +inf: not reached yet
    T sigma = 0;           // value less radius of the front that brought it (circular fronts)
  };

  // What belongs to one part, and no other touches during a round.
  struct alignas(64) Part {
    BucketQueue queue;
    Pile touched;                  // places with a value, ghosts among them
    Pile news;                     // shared places whose value fell in its last round
    Pile incoming;                 // channels with messages for it
    Pile outgoing;                 // channels through which it sent something in its last round
    std::uint64_t last_round = 0;  // that it took part in
    std::uint64_t pops = 0;
    bool used = false;   // in this run
    bool awake = false;  // something waits for it
  };

  // A value that fell.
  struct Message {
    Index place, label;  // of the receiver
    T value, sigma;
  };

  explicit MarchState(const partition::VertexPartition& shared_out);

  const partition::VertexPartition* layout;
  UninitializedArray<Front> front_at;     // [places]
  UninitializedArray<std::uint8_t> open;  // [places] see Openness
  std::vector<Index> label;               // [places] where labelled
  std::vector<T> start;                   // [labels] the value that each label's front started with
  std::vector<T> fixed_value;             // [places], label-setting only: the value once it is fixed
  std::vector<Part> parts;
  std::vector<partition::MessageBuffer<Message>> channels;
  std::vector<partition::Outlook> outlook;  // [parts] what waits for a part, in its queue and in messages
  std::vector<Index> used, awake;           // parts; `awake` ascending
  std::vector<partition::Due> due;          // the parts that work in the current round, ascending
  std::uint64_t round = 1;                  // never begins anew
  Bucket bucket = -1;                       // up to which parts work in the current round
  Bucket lowest = 0;                        // bucket in which something waits
  std::size_t load = 0;                     // about how much work there is in the round
  T buckets_per_unit = 1;
  bool labelled = false;  // several sources or offsets: fronts of different labels do not mix

  void reset();
  BRUSHFIRE_INLINE Bucket bucket_of(T v) const {
    constexpr T kFarthest = T(1ll << 62);  // of buckets: what is farther shares the last one
    const T b = v * buckets_per_unit;
    return b < kFarthest ? static_cast<Bucket>(b) : Bucket{1} << 62;
  }
  // What is below is final.
  T front() const { return static_cast<T>(lowest) / buckets_per_unit; }
  void seed(Index place, T v, Index source);  // from outside the march: keeps the lowest (value, label)

  void begin_run();  // when all seeds are in
  // Delivers messages and chooses who works in the next round; false where nothing is left.
  bool next_round();
  void send_news(Index part);  // to the parts that have ghosts of what changed

  // Whether going through all vertices of a part costs less than through those that were touched.
  bool touched_most(Index part) const;
  Index begin(Index part) const { return part << layout->shift; }
  Index end(Index part) const;
  void reset_part(Index part);
  std::size_t touched() const;
  std::uint64_t pops() const;

 private:
  void deliver();
  void send(Part& part, Index place);
  void wake(Index part);
};

}  // namespace brushfire::fast_marching
