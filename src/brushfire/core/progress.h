// How a long computation reports where it is, and how it is stopped.
#pragma once

#include <atomic>
#include <functional>

namespace brushfire {

// Called now and then, from the thread that computes, with the share of the work that is done, in [0, 1].
using Progress = std::function<void(double share)>;

// Set from any thread (or a signal handler) to stop a computation that was given the token: it then throws
// Error(Cancelled) within some milliseconds. A plain flag, because WebAssembly's standard library has no
// std::stop_token.
class CancelToken {
 public:
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  void reset() noexcept { cancelled_.store(false, std::memory_order_relaxed); }
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> cancelled_{false};
};

}  // namespace brushfire
