// How much memory there is, so that what cannot fit is refused before it is tried.
#pragma once

#include <cstdint>
#include <string>

namespace brushfire {

// Bytes that this process can still take without swapping: what the system calls available, or what the process's
// control group leaves, whichever is less. The largest number where the platform does not tell.
std::uint64_t available_memory();

// "3.1 GB": three digits at most, powers of 1000.
std::string bytes_as_text(std::uint64_t bytes);

// Throws Error(TooLarge) where `bytes` exceed `limit` (0: available_memory()). The message says what needs how much and
// what there is, and ends in `advice`: "a 160000 x 160000 float32 matrix needs 102 GB, but 21.3 GB are available: ...".
void require_memory(std::uint64_t bytes, std::uint64_t limit, const std::string& what, const std::string& advice);

}  // namespace brushfire
