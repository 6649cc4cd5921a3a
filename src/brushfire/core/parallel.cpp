// The thread team: one word says which loop it is, whether it can still be joined, and how many have.
#include <brushfire/core/parallel.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

// WebAssembly without the threads proposal has neither std::thread nor anything to run it on.
#if defined(__wasi__) || (defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__))
#define BRUSHFIRE_HAS_THREADS 0
#else
#define BRUSHFIRE_HAS_THREADS 1
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#endif

#if BRUSHFIRE_HAS_THREADS && (defined(__unix__) || defined(__APPLE__))
#include <pthread.h>
#define BRUSHFIRE_HAS_FORK 1
#else
#define BRUSHFIRE_HAS_FORK 0
#endif

namespace brushfire {
namespace {

// One loop, as all workers see it.
struct Loop {
  std::size_t count = 0;
  const ThreadTeam::Body* body = nullptr;
  const CancelToken* cancel = nullptr;
  const CancelToken* heard = nullptr;  // what the caller listens to
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
};

// What went wrong first, in the order of the indices.
struct Failure {
  std::size_t index = 0;
  std::exception_ptr exception;
};

// Takes indices until there are none left. Never throws: returns the exception of the body, if it threw.
Failure work(Loop& loop, unsigned worker) noexcept {
  const CancelScope listen(loop.heard);
  while (!loop.stop.load(std::memory_order_relaxed)) {
    if (loop.cancel && loop.cancel->cancelled()) {
      loop.stop.store(true, std::memory_order_relaxed);
      break;
    }
    const std::size_t i = loop.next.fetch_add(1, std::memory_order_relaxed);
    if (i >= loop.count) break;
    try {
      (*loop.body)(worker, i);
    } catch (...) {
      loop.stop.store(true, std::memory_order_relaxed);
      return {i, std::current_exception()};
    }
  }
  return {};
}

void finish(const Loop& loop, const Failure& failure) {
  if (failure.exception) std::rethrow_exception(failure.exception);
  if (loop.stop.load(std::memory_order_relaxed)) throw Error(ErrorCode::Cancelled, "cancelled");
}

}  // namespace

#if BRUSHFIRE_HAS_THREADS

namespace {

void keep_first(Failure& first, Failure&& other) {
  if (other.exception && (!first.exception || other.index < first.index)) first = std::move(other);
}

// What all threads of a team agree on, in one word: the number of the loop, whether it can be joined, and how many
// helpers have joined it and not left yet.
class LoopWord {
 public:
  static constexpr std::uint64_t kOpen = 1, kHelper = 2, kLoop = std::uint64_t{1} << 24;

  // For the caller. No helper is in a loop when the next one is opened.
  void open() { word_.store((word_.load(std::memory_order_relaxed) | (kLoop - 1)) + 1 + kOpen); }
  void close() { word_.fetch_and(~kOpen); }
  bool busy() const { return (word_.load() & (kLoop - 1)) >= kHelper; }

  // For helpers. `seen`: the last loop that this one took part in or came too late for.
  bool is_news(std::uint64_t seen) const { return word_.load() / kLoop != seen; }
  bool join(std::uint64_t& seen) {
    std::uint64_t now = word_.load();
    while (now / kLoop != seen && (now & kOpen) != 0) {
      if (word_.compare_exchange_weak(now, now + kHelper)) {
        seen = now / kLoop;
        return true;
      }
    }
    seen = now / kLoop;
    return false;
  }
  // True for the last one to leave a closed loop.
  bool leave() { return ((word_.fetch_sub(kHelper) - kHelper) & (kLoop - 1)) == 0; }

 private:
  std::atomic<std::uint64_t> word_{0};
};

// Lets the processor's other half work, where there is one.
void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__) && defined(__GNUC__)
  __asm__ volatile("yield");
#endif
}

// How often the process has been forked off on the way to this one. A child has its parent's memory, but of its threads
// only the one that forked.
std::atomic<unsigned> forks{0};

unsigned count_forks() {
#if BRUSHFIRE_HAS_FORK
  static const int watched = pthread_atfork(nullptr, nullptr, [] { forks.fetch_add(1); });
  static_cast<void>(watched);
#endif
  return forks.load();
}

// Looks again and again whether `done`, for as long as going to sleep and waking up again would take.
template <class Done>
bool comes_soon(const Done& done) {
  constexpr int kLooks = 64;  // between two glances at the clock
  constexpr std::chrono::microseconds kPatience{50};
  const auto begin = std::chrono::steady_clock::now();
  do {
    for (int i = 0; i < kLooks; ++i) {
      if (done()) return true;
      pause();
    }
  } while (std::chrono::steady_clock::now() - begin < kPatience);
  return false;
}

}  // namespace

struct ThreadTeam::State {
  explicit State(Idle idle) : spins(idle == Idle::Spins) {}

  LoopWord word;
  Loop* loop = nullptr;  // valid for those who have joined
  std::atomic<bool> quit{false};
  const bool spins;
  const unsigned born_after = count_forks();

  std::mutex mutex;
  std::condition_variable wake, done;
  std::atomic<std::size_t> sleepers{0};  // on `wake`
  std::atomic<bool> caller_sleeps{false};
  Failure failure;  // with the mutex
  std::vector<std::thread> helpers;

  // In a child of the process that the helpers live in. They may have held the mutex, so nothing here is of any use.
  bool is_bereft() const { return forks.load(std::memory_order_relaxed) != born_after; }

  void help(unsigned worker) {
    std::uint64_t seen = 0;
    while (wait_for_loop(seen)) {
      if (!word.join(seen)) continue;
      Failure mine = work(*loop, worker);
      if (mine.exception) {
        const std::lock_guard lock(mutex);
        keep_first(failure, std::move(mine));
      }
      if (word.leave() && caller_sleeps.load()) {
        const std::lock_guard lock(mutex);
        done.notify_one();
      }
    }
  }

  // False when the team is dissolved.
  bool wait_for_loop(std::uint64_t seen) {
    const auto called = [&] { return quit.load() || word.is_news(seen); };
    if (!(spins && comes_soon(called))) {
      std::unique_lock lock(mutex);
      ++sleepers;  // before the last look: who opens a loop looks for sleepers afterwards
      wake.wait(lock, called);
      --sleepers;
    }
    return !quit.load();
  }

  void call() {
    if (sleepers.load() == 0) return;
    const std::lock_guard lock(mutex);
    wake.notify_all();
  }

  void wait_for_helpers() {
    const auto over = [&] { return !word.busy(); };
    if (over() || (spins && comes_soon(over))) return;
    std::unique_lock lock(mutex);
    caller_sleeps.store(true);
    done.wait(lock, over);
    caller_sleeps.store(false);
  }
};

unsigned thread_count(unsigned requested) noexcept {
  return std::max(1u, requested == 0 ? std::thread::hardware_concurrency() : requested);
}

ThreadTeam::ThreadTeam(unsigned threads, Idle idle) : state_(std::make_unique<State>(idle)) {
  State& s = *state_;
  try {
    for (unsigned worker = 1; worker < thread_count(threads); ++worker) {
      s.helpers.emplace_back([&s, worker] { s.help(worker); });
    }
  } catch (const std::system_error&) {  // NOLINT(bugprone-empty-catch)
    // The system gives no more threads: those that there are do the work.
  }
}

ThreadTeam::~ThreadTeam() {
  if (state_->is_bereft()) {
    // Whoever closes a condition variable waits for those who wait for it, and these never wake: left as it is.
    static_cast<void>(state_.release());  // NOLINT(bugprone-unused-return-value)
    return;
  }
  state_->quit.store(true);
  state_->call();
  for (std::thread& t : state_->helpers) t.join();
}

unsigned ThreadTeam::size() const noexcept {
  return state_->is_bereft() ? 1 : static_cast<unsigned>(state_->helpers.size()) + 1;
}

void ThreadTeam::run(std::size_t count, const Body& body, const CancelToken* cancel) {
  Loop loop{count, &body, cancel, current_cancel_token()};
  State& s = *state_;
  const bool together = count > 1 && size() > 1;
  if (together) {
    s.loop = &loop;
    s.word.open();
    s.call();
  }
  Failure failure = work(loop, 0);
  if (together) {
    s.word.close();
    s.wait_for_helpers();
    const std::lock_guard lock(s.mutex);
    keep_first(failure, std::exchange(s.failure, {}));
  }
  finish(loop, failure);
}

#else

struct ThreadTeam::State {};

unsigned thread_count(unsigned) noexcept { return 1; }
ThreadTeam::ThreadTeam(unsigned, Idle) {}
ThreadTeam::~ThreadTeam() = default;
unsigned ThreadTeam::size() const noexcept { return 1; }

void ThreadTeam::run(std::size_t count, const Body& body, const CancelToken* cancel) {
  Loop loop{count, &body, cancel, current_cancel_token()};
  const Failure failure = work(loop, 0);
  finish(loop, failure);
}

#endif

void parallel_for(std::size_t count, unsigned threads, const ThreadTeam::Body& body, const CancelToken* cancel) {
  const std::size_t useful = std::max<std::size_t>(1, std::min<std::size_t>(thread_count(threads), count));
  ThreadTeam(static_cast<unsigned>(useful)).run(count, body, cancel);
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): a forked child leaves its team behind

}  // namespace brushfire
