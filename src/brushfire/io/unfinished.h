// Files that are being written, for programs that have to end meanwhile.
#pragma once

namespace brushfire {

// Removes the temporary files of all outputs that this process has begun and not completed (see docs/files.md), and
// keeps threads that are writing one from going on: for use before _exit() only. From any thread, not from a signal
// handler.
void remove_unfinished_files() noexcept;

}  // namespace brushfire
