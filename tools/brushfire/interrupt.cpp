// The signal handler.
#include "interrupt.h"

#include <brushfire/core/error.h>

#include <csignal>

namespace brushfire::tool {
namespace {

// A signal handler can reach nothing but a global.
CancelToken interrupted;

void on_signal(int signal) {
  interrupted.cancel();
  std::signal(signal, SIG_DFL);
}

}  // namespace

CancelToken& cancel_token() { return interrupted; }

void stop_if_interrupted() {
  if (interrupted.cancelled()) throw Error(ErrorCode::Cancelled, "interrupted");
}

void cancel_on_interrupt() {
#ifdef SIGPIPE
  // A closed pipe is an error of writing, told in one line, and not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
#endif
  // A lock-free atomic is all that the handler touches.
  for (const int signal : {SIGINT, SIGTERM}) {
    // A program started with the signal ignored (nohup, a background job) keeps ignoring it.
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

}  // namespace brushfire::tool
