// Ctrl-C and SIGTERM: what runs is asked to stop, and what does not listen is ended.
#pragma once

#include <brushfire/core/progress.h>

namespace brushfire::tool {

// From now on SIGINT and SIGTERM set the token that everything the program calls listens to; what has not ended
// kPatience later (in the midst of another library's work, or blocked by a pipe that nobody reads) is ended: files that
// were being written are removed, and the program exits with interrupted_exit_code(). A second signal ends it at once.
// Writing to a closed pipe fails instead of ending the program.
void cancel_on_interrupt();

// The token that every computation of the program listens to.
CancelToken& cancel_token();

// Throws Error(Cancelled) once the token is set. For the stretches between computations.
void stop_if_interrupted();

// As shells count: 128 and the number of the signal that came: 130 after Ctrl-C, 143 after SIGTERM.
int interrupted_exit_code();

// Says so on stderr, once.
void say_interrupted();

}  // namespace brushfire::tool
