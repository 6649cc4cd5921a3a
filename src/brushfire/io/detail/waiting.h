// Waiting for pipes without becoming deaf.
#pragma once

#include <cstddef>

namespace brushfire::detail {

// One call of read() or write() moves so much at most: a disk takes some milliseconds for it.
inline constexpr std::size_t kLongestCall = std::size_t{1} << 24;

// Return when a call would not block, or has something to report (an end, an error). Throw Error(Cancelled).
void wait_until_readable(int descriptor);
void wait_until_writable(int descriptor);
// For what can only be tried again: a pipe that has no reader yet.
void wait_a_little();

}  // namespace brushfire::detail
