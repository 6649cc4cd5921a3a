// Ctrl-C: asks the running computation to stop; a second one ends the program at once.
#pragma once

#include <brushfire/core/progress.h>

namespace brushfire::tool {

// The token that every computation of the program is given.
CancelToken& cancel_token();

// Throws Error(Cancelled) once the token is set. For the stretches between computations.
void stop_if_interrupted();

// From now on SIGINT and SIGTERM set the token, and writing to a closed pipe fails instead of ending the program.
void cancel_on_interrupt();

}  // namespace brushfire::tool
