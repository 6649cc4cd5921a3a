// The march of one field: every vertex carries the (pseudo-)source that it is seen from.
#pragma once

#include <brushfire/core/detail/bucket_queue.h>
#include <brushfire/core/detail/uninitialized.h>
#include <brushfire/solvers/carried_source/detail/offer_batch.h>
#include <brushfire/solvers/carried_source/detail/records.h>
#include <brushfire/solvers/carried_source/detail/update.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace brushfire::carried_source {

// Where a front starts: the value at a vertex, and the way from there to the source in its frame.
template <class T>
struct Start {
  Index vertex = kNoIndex;
  T value = 0, sigma = 0, x = 0, y = 0;
  Index sector = 0;
  Index label = 0;
};

// A vertex has its turn when the front is there, and again whenever its value fell since. Values that chase each other
// in circles are stopped by a limit of turns, so that a march ends after kMostTurns for each vertex.
template <class T>
class March {
 public:
  static constexpr T kUnreached = std::numeric_limits<T>::infinity();
  static constexpr int kMostTurns = 16;

  explicit March(const Records<T>& records);

  // Forgets what the last run left. O(vertices that it touched).
  void reset();
  void begin_at(const Start<T>& start);
  // `labelled`: sources are told apart; of equal values the one of the lowest label stays.
  void label_fronts(bool labelled) { labelled_ = labelled; }

  // Goes to the next bucket; false where there is none.
  bool advance() { return queue_.advance(); }
  // No vertex that still waits lies before it.
  T front() const { return static_cast<T>(queue_.cursor()) / per_unit_; }
  // Values below no longer change.
  T settled() const { return front() - settling_; }
  void work();

  T value(Index v) const { return fronts_[v].value; }
  Index label(Index v) const { return fronts_[v].label; }
  const Pile& touched() const { return touched_; }
  std::uint64_t turns() const { return turns_; }
  std::uint64_t updates() const { return updates_; }

  // The source of a vertex as a direction in its frame.
  struct Carried {
    T sigma, x, y;
    Index sector;
  };
  Carried carried(Index v) const;

 private:
  enum State : std::uint8_t { kAway, kWaiting, kClosed };  // closed: it had its turn with the value that it has

  struct alignas(8 * sizeof(T)) Front {
    T value = kUnreached, sigma = kUnreached, x = 0, y = 0;
    Around<T> around;  // of the vertex; stays
    Index label = kNoIndex;
    SectorSet sector = 1;
    std::uint8_t turns : 7 = 0, has_offer : 1 = 0;  // that waits in the batch
    std::uint8_t state = kAway;
  };

  struct Turn;
  template <bool kLabelled>
  void work_labelled();
  template <bool kLabelled>
  void turn(Index v);
  template <bool kLabelled>
  void add_offer(const Turn& at, Index target, Update u, const Side<T>& to);
  // What is worked out by itself, and accepted at once: where fronts of two sources meet, and at odd vertices.
  template <bool kLabelled>
  void offer_alone(const Turn& at, Index target, Update u, const Side<T>& to);
  template <bool kLabelled>
  void take_offers();
  // Along a side, where no edge beside it is closed.
  template <bool kLabelled>
  void offer_along(const Turn& at, Index k);
  SourceAt<T> see(const Front& f, const Side<T>& side, bool at_end, Index hand, Index lenses, SectorSet dark) const;
  template <bool kLabelled>
  void accept(Index v, const Offer<T>& offer, Index sector, Index label);

  void wait_for_turn(Front& f, Index v, bool is_in_bucket, BucketQueue::Bucket bucket);
  BucketQueue::Bucket bucket_of(T value) const;

  // Of the turn at hand.
  struct PlannedOffer {
    Index side = 0;
    Update update;
  };
  struct Lists {
    std::vector<Index> ahead, alongs;  // sides
    std::vector<PlannedOffer> offers;
  };

  const Records<T>& records_;
  UninitializedArray<Front> fronts_;
  Lists lists_;
  OfferBatch<T> batch_;
  BucketQueue queue_;
  Pile touched_;
  std::vector<Index> pass_;
  T per_unit_ = 1, slack_ = 0, farther_ = 0, settling_ = 0, settled_ = 0;
  bool labelled_ = false;
  std::uint64_t turns_ = 0, updates_ = 0;
};

extern template class March<float>;
extern template class March<double>;

}  // namespace brushfire::carried_source
