// The thread team: a generation counter says that there is a new loop, a count of the busy says that it is over.
#include <brushfire/core/parallel.h>

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
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#endif

namespace brushfire {
namespace {

// One loop, as all workers see it.
struct Loop {
  std::size_t count = 0;
  const ThreadTeam::Body* body = nullptr;
  const CancelToken* cancel = nullptr;
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

void keep_first(Failure& first, Failure&& other) {
  if (other.exception && (!first.exception || other.index < first.index)) first = std::move(other);
}

void finish(const Loop& loop, const Failure& failure) {
  if (failure.exception) std::rethrow_exception(failure.exception);
  if (loop.stop.load(std::memory_order_relaxed)) throw Error(ErrorCode::Cancelled, "cancelled");
}

}  // namespace

#if BRUSHFIRE_HAS_THREADS

struct ThreadTeam::State {
  std::mutex mutex;
  std::condition_variable wake, done;
  std::uint64_t generation = 0;  // of the loop that runs or ran last
  std::size_t busy = 0;          // helpers that have not finished it
  bool quit = false;
  Loop* loop = nullptr;
  Failure failure;
  std::vector<std::thread> helpers;

  void help(unsigned worker) {
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex);
    while (true) {
      wake.wait(lock, [&] { return quit || generation != seen; });
      if (quit) return;
      seen = generation;
      Loop& current = *loop;
      lock.unlock();
      Failure mine = work(current, worker);
      lock.lock();
      keep_first(failure, std::move(mine));
      if (--busy == 0) done.notify_one();
    }
  }
};

unsigned thread_count(unsigned requested) noexcept {
  return std::max(1u, requested == 0 ? std::thread::hardware_concurrency() : requested);
}

ThreadTeam::ThreadTeam(unsigned threads) : state_(std::make_unique<State>()) {
  State& s = *state_;
  try {
    for (unsigned worker = 1; worker < thread_count(threads); ++worker) {
      s.helpers.emplace_back([&s, worker] { s.help(worker); });
    }
  } catch (const std::system_error&) {
    // The system gives no more threads: those that there are do the work.
  }
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->quit = true;
  }
  state_->wake.notify_all();
  for (std::thread& t : state_->helpers) t.join();
}

unsigned ThreadTeam::size() const noexcept { return static_cast<unsigned>(state_->helpers.size()) + 1; }

void ThreadTeam::run(std::size_t count, const Body& body, const CancelToken* cancel) {
  Loop loop{count, &body, cancel};
  State& s = *state_;
  {
    const std::lock_guard lock(s.mutex);
    s.loop = &loop;
    s.failure = {};
    s.busy = s.helpers.size();
    ++s.generation;
  }
  s.wake.notify_all();
  Failure failure = work(loop, 0);
  std::unique_lock lock(s.mutex);
  s.done.wait(lock, [&] { return s.busy == 0; });
  keep_first(failure, std::move(s.failure));
  lock.unlock();
  finish(loop, failure);
}

#else

struct ThreadTeam::State {};

unsigned thread_count(unsigned) noexcept { return 1; }
ThreadTeam::ThreadTeam(unsigned) {}
ThreadTeam::~ThreadTeam() = default;
unsigned ThreadTeam::size() const noexcept { return 1; }

void ThreadTeam::run(std::size_t count, const Body& body, const CancelToken* cancel) {
  Loop loop{count, &body, cancel};
  const Failure failure = work(loop, 0);
  finish(loop, failure);
}

#endif

void parallel_for(std::size_t count, unsigned threads, const ThreadTeam::Body& body, const CancelToken* cancel) {
  const std::size_t useful = std::max<std::size_t>(1, std::min<std::size_t>(thread_count(threads), count));
  ThreadTeam(static_cast<unsigned>(useful)).run(count, body, cancel);
}

}  // namespace brushfire
