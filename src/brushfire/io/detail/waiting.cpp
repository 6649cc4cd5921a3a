// poll(), again and again: a signal that comes between a look at the token and a call that blocks would else be lost.
#include <brushfire/io/detail/waiting.h>

#include <brushfire/core/cancel.h>
#include <brushfire/io/detail/posix.h>

namespace brushfire::detail {
namespace {

constexpr int kLookMilliseconds = 50;  // between two looks at the token

void wait_for(int descriptor, short events) {
  while (true) {
    stop_if_cancelled();
    posix::pollfd waited{descriptor, events, 0};
    if (posix::poll(&waited, 1, kLookMilliseconds) != 0 && waited.revents != 0) return;
  }
}

}  // namespace

void wait_until_readable(int descriptor) { wait_for(descriptor, POLLIN); }
void wait_until_writable(int descriptor) { wait_for(descriptor, POLLOUT); }

void wait_a_little() {
  stop_if_cancelled();
  posix::poll(nullptr, 0, kLookMilliseconds);
}

}  // namespace brushfire::detail
