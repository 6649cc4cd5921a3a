// One part of the mesh in a run: it works off its queue in rounds, and receives messages between them.
#pragma once

#include <brushfire/solvers/partition/rounds.h>
#include <brushfire/solvers/windows/propagation/part_state.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

class Part {
 public:
  Part(RunState& run, Index number) : state_(run, number) {}

  // ---- between two rounds, when no part is at work

  bool is_active() const { return state_.activity != nullptr; }
  void activate(std::unique_ptr<Activity> activity, std::int64_t bucket);
  std::unique_ptr<Activity> retire() { return std::move(state_.activity); }
  bool is_idle() const { return state_.activity->queue.empty(); }
  partition::Outlook outlook() const { return state_.activity->queue.outlook(); }
  // Messages to other parts; the caller delivers and clears them.
  Outbox& outbox() {
    collect_fallen();
    return state_.activity->outbox;
  }
  // To start at a source, or to receive a message.
  PartState& at(Workbench& bench) {
    state_.bench = &bench;
    return state_;
  }
  OwnVertices& vertices() { return state_.vertices; }
  const OwnVertices& vertices() const { return state_.vertices; }
  std::span<KeptWindow> kept() { return state_.kept; }
  // Events since this was asked last.
  std::uint64_t count_updates() { return std::exchange(updates_, 0); }
  // What is left of the last run, whether it came to its end or not.
  void forget();

  // ---- a round

  // All that is to be done up to bucket number `last`. Throws Error(Cancelled).
  void work(std::int64_t last, Workbench& bench);

 private:
  void collect_fallen();

  PartState state_;
  std::uint64_t updates_ = 0;
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
