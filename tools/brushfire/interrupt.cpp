// A thread of its own waits for the signals: it may do what a signal handler must not.
#include "interrupt.h"

#include <brushfire/core/error.h>
#include <brushfire/io/unfinished.h>

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <string_view>
#include <system_error>
#include <thread>

namespace brushfire::tool {
namespace {

// With what stopping takes it is 0.3 s at most from the signal to the end.
constexpr std::chrono::milliseconds kPatience{150};

CancelToken interrupted;
std::atomic<int> signal_number{SIGINT};
std::atomic<bool> said{false};

void wait_for_signal(const sigset_t& signals) {
  int number = 0;
  if (sigwait(&signals, &number) != 0) return;
  signal_number.store(number);
  interrupted.cancel();
  // The next one ends the program, as if nothing had been done here.
  for (const int s : {SIGINT, SIGTERM}) {
    if (sigismember(&signals, s) == 1) std::signal(s, SIG_DFL);
  }
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  std::this_thread::sleep_for(kPatience);
  remove_unfinished_files();
  say_interrupted();
  _exit(interrupted_exit_code());
}

// A program started with the signal ignored (nohup, a background job) keeps ignoring it.
bool is_ignored(int signal) {
  struct sigaction now{};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

CancelToken& cancel_token() { return interrupted; }

void stop_if_interrupted() {
  if (interrupted.cancelled()) throw Error(ErrorCode::Cancelled, "interrupted");
}

int interrupted_exit_code() { return 128 + signal_number.load(); }

void say_interrupted() {
  constexpr std::string_view kLine = "brushfire: interrupted\n";
  pollfd err{STDERR_FILENO, POLLOUT, 0};
  // Where stderr is a pipe that nobody reads there is nothing to wait for.
  if (!said.exchange(true) && poll(&err, 1, 0) == 1)
    static_cast<void>(!write(STDERR_FILENO, kLine.data(), kLine.size()));
}

void cancel_on_interrupt() {
  // A closed pipe is an error of writing, told in one line, and not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int s : {SIGINT, SIGTERM}) {
    if (!is_ignored(s)) sigaddset(&signals, s);
  }
  // Blocked here, and so in all threads that are yet to come: only the one that waits for them gets them.
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  try {
    std::thread([signals] { wait_for_signal(signals); }).detach();
  } catch (const std::system_error&) {
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);  // no thread to be had: signals end the program themselves
  }
}

}  // namespace brushfire::tool
