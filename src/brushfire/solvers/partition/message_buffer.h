// What one part sends to one other, round by round.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace brushfire::partition {

// Its sender writes into one half while its receiver reads, and empties, the other one: both may be at work at the same
// time. Between two rounds flip() makes what was sent what is received.
template <class Message>
class alignas(64) MessageBuffer {
 public:
  // `bucket`: into which bucket of the receiver the message falls. True for the first message in this round.
  bool send(const Message& message, std::int64_t bucket, std::uint64_t round) {
    std::vector<Message>& sent = halves_[writes_];
    lowest_ = sent.empty() ? bucket : std::min(lowest_, bucket);
    sent.push_back(message);
    return std::exchange(last_round_, round) != round;
  }
  std::size_t sent() const { return halves_[writes_].size(); }
  std::int64_t lowest_bucket() const { return lowest_; }  // of what was sent

  // True the first time: the receiver then has to be told that something waits for it.
  bool announce() { return !std::exchange(announced_, true); }
  void flip() { writes_ ^= 1; }
  const std::vector<Message>& received() const { return halves_[1 - writes_]; }
  void clear_received() {
    halves_[1 - writes_].clear();
    announced_ = false;
  }
  void clear() {
    for (std::vector<Message>& half : halves_) half.clear();
    announced_ = false;
  }

 private:
  std::array<std::vector<Message>, 2> halves_;
  std::uint64_t last_round_ = 0;
  std::int64_t lowest_ = 0;
  std::uint8_t writes_ = 0;
  bool announced_ = false;
};

}  // namespace brushfire::partition
