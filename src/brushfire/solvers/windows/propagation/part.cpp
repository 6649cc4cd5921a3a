// The events of a part, in turn.
#include <brushfire/solvers/windows/propagation/part.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/windows/propagation/prefetching.h>
#include <brushfire/solvers/windows/propagation/pseudo_sources.h>
#include <brushfire/solvers/windows/propagation/single_windows.h>
#include <brushfire/solvers/windows/propagation/window_lists.h>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {
namespace {

void throw_if_cancelled(const RunState& run) {
  const CancelToken* cancel = run.problem->cancel;
  if (cancel && cancel->cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
}

}  // namespace

void Part::activate(std::unique_ptr<Activity> activity, std::int64_t bucket) {
  state_.activity = std::move(activity);
  state_.activity->queue.reset(state_.run->bucket_width, bucket);
}

void Part::forget() {
  state_.vertices.forget();
  updates_ = 0;
  state_.memory.clear();
  state_.trails.clear();
  state_.spines.clear();
  state_.kept.clear();
  if (!state_.activity) return;
  // The run was stopped.
  for (WindowFace& f : state_.run->structure.faces_of(state_.number)) f.waiting = kNoIndex;
  state_.activity->clear();
}

void Part::work(std::int64_t last, Workbench& bench) {
  constexpr std::uint64_t kPoll = 1024;
  PartState& part = at(bench);
  EventQueue& queue = part.activity->queue;
  const Prefetching prefetching(part);
  EventQueue::Event event;
  queue.advance_to(last);
  prefetching.first();
  const bool by_turns = part.run->structure.has_needles;
  while (by_turns ? queue.pop_by_turns(last, event) : queue.pop(last, event)) {
    if (++updates_ % kPoll == 0) throw_if_cancelled(*part.run);
    if (!event.is_list) {
      prefetching.next_vertices();
      if (part.vertices.pseudo_source(event.index).waiting) propagate_from_vertex(part, event.index);
      continue;
    }
    prefetching.next_lists();
    if constexpr (!kWide) {
      if (goes_in_lists(part, event.index)) {
        propagate_list(part, event.index);
        continue;
      }
    }
    propagate_windows(part, event.index);
  }
  collect_fallen();
}

// Each is told as it is now, as often as it fell in this round.
void Part::collect_fallen() {
  state_.vertices.take_fallen([&](Index v) { state_.activity->outbox.send(FallenMessage{v}); });
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
