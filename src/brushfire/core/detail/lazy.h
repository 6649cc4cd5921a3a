// Values that are computed on first use.
#pragma once

#include <atomic>
#include <mutex>
#include <utility>

namespace brushfire {

// Safe from several threads.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(Make&& make) const {
    if (!ready_.load(std::memory_order_acquire)) {  // call_once() alone costs ten times this
      std::call_once(once_, [&] {
        value_ = make();
        ready_.store(true, std::memory_order_release);
      });
    }
    return value_;
  }
  bool ready() const { return ready_.load(std::memory_order_acquire); }

  // Where it is known already; before anybody asks.
  void set(T value) {
    std::call_once(once_, [&] {
      value_ = std::move(value);
      ready_.store(true, std::memory_order_release);
    });
  }

 private:
  mutable std::atomic<bool> ready_ = false;
  mutable std::once_flag once_;
  mutable T value_;
};

}  // namespace brushfire
