// Long computations with the GIL released, that Ctrl-C stops and that report their progress.
#pragma once

#include "bind.h"

#include <brushfire/core/cancel.h>
#include <brushfire/core/progress.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

namespace brushfire::python {

// Python runs signal handlers in the main thread only, and only between two steps of the interpreter. So where a call
// comes from the main thread, or wants progress, the computation gets a thread of its own, and the calling one looks
// every kLookInterval whether there is a signal or something to report. An exception from either cancels.
class Computation {
 public:
  explicit Computation(nb::object progress) : progress_(std::move(progress)) {}

  const CancelToken* cancel() const { return &cancel_; }
  Progress progress() {
    if (progress_.is_none()) return {};
    return [this](double share) { share_.store(share, std::memory_order_relaxed); };
  }

  // Calls compute() without the GIL; returns what it returns. `brief`: not worth a thread.
  template <class Compute>
  auto run(bool brief, Compute&& compute) {
    using Value = std::invoke_result_t<Compute>;
    std::optional<Value> value;
    std::exception_ptr failure;
    const auto body = [&]() noexcept {
      const CancelScope listen(&cancel_);
      try {
        value.emplace(compute());
      } catch (...) {
        failure = std::current_exception();
      }
    };
    if (progress_.is_none() && (brief || !in_main_thread())) {
      const nb::gil_scoped_release release;
      body();
    } else {
      watch(body);
    }
    if (failure) std::rethrow_exception(failure);
    return std::move(*value);
  }

 private:
  static constexpr std::chrono::milliseconds kLookInterval{40};

  static bool in_main_thread() {
    const nb::module_ threading = nb::module_::import_("threading");
    return threading.attr("current_thread")().is(threading.attr("main_thread")());
  }

  template <class Body>
  void watch(const Body& body) {
    std::mutex mutex;
    std::condition_variable finished;
    bool done = false;
    std::thread worker([&] {
      body();
      const std::lock_guard lock(mutex);
      done = true;
      finished.notify_one();
    });
    const auto wait = [&](std::chrono::milliseconds time) {
      const nb::gil_scoped_release release;
      std::unique_lock lock(mutex);
      return finished.wait_for(lock, time, [&] { return done; });
    };
    try {
      while (!wait(kLookInterval)) look();
    } catch (...) {
      cancel_.cancel();
      {
        const nb::gil_scoped_release release;
        worker.join();
      }
      throw;
    }
    worker.join();
    if (!progress_.is_none()) progress_(1.0);
  }

  void look() {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (!progress_.is_none()) progress_(share_.load(std::memory_order_relaxed));
  }

  nb::object progress_;
  CancelToken cancel_;
  std::atomic<double> share_{0};
};

// What takes no progress: compute() without the GIL, stopped by Ctrl-C.
template <class Compute>
auto listening(bool brief, Compute&& compute) {
  return Computation(nb::none()).run(brief, std::forward<Compute>(compute));
}

}  // namespace brushfire::python
