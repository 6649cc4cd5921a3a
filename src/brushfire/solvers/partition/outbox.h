// Messages of several types that wait to be delivered.
#pragma once

#include <tuple>
#include <vector>

namespace brushfire::partition {

// A part sends while it works; when all parts have stopped, one thread reads and delivers the messages type by type, in
// the order of the types and, within one, as they were sent. So what is received depends on who sent it and on nothing
// else. Keeps its memory when it is cleared.
template <class... Messages>
class Outbox {
 public:
  template <class Message>
  [[gnu::always_inline]] void send(const Message& message) {
    std::get<std::vector<Message>>(messages_).push_back(message);
  }
  template <class Message>
  const std::vector<Message>& all() const {
    return std::get<std::vector<Message>>(messages_);
  }
  bool empty() const { return (all<Messages>().empty() && ...); }
  void clear() { (std::get<std::vector<Messages>>(messages_).clear(), ...); }

 private:
  std::tuple<std::vector<Messages>...> messages_;
};

}  // namespace brushfire::partition
