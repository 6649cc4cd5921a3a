// What a forked child of this process comes to.
#pragma once

#include <string>

#if defined(__unix__) || defined(__APPLE__)
#define BRUSHFIRE_CAN_FORK 1
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#else
#define BRUSHFIRE_CAN_FORK 0
#endif

namespace brushfire::test {

#if BRUSHFIRE_CAN_FORK

// Runs `holds` in a forked child: "yes" or "no", "hangs" where it has not ended in `seconds`, or how it died.
template <class Holds>
std::string in_forked_child(const Holds& holds, unsigned seconds = 20) {
  const pid_t child = fork();
  if (child < 0) return "no child";
  if (child == 0) {
    std::signal(SIGALRM, SIG_DFL);
    alarm(seconds);
    bool yes = false;
    try {
      yes = holds();
    } catch (...) {
      _exit(2);
    }
    _exit(yes ? 0 : 1);  // nothing of the parent's is closed, flushed or checked for leaks
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) return "lost";
  if (WIFSIGNALED(status)) {
    return WTERMSIG(status) == SIGALRM ? "hangs" : "died of signal " + std::to_string(WTERMSIG(status));
  }
  const int code = WEXITSTATUS(status);
  return code == 0 ? "yes" : code == 1 ? "no" : "ended with " + std::to_string(code);
}

#endif

}  // namespace brushfire::test
