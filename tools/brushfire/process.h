// What this process costs the machine: processor time and memory. For measurements.
#pragma once

#include <cstdint>
#include <vector>

namespace brushfire::tool {

// Processor time of this process in seconds, all threads together. Other programs on the machine do not show in it,
// except through shared caches and memory.
double cpu_seconds();

// Resident memory in bytes: now, and the most there has been (since reset_peak_memory()); 0 where the system does not
// tell.
std::uint64_t resident_memory();
std::uint64_t peak_memory();

// Gives freed memory back to the system and counts the peak from now on. False where the system cannot.
bool reset_peak_memory();

// The middle value (the mean of the two middle ones); 0 of nothing.
double median(std::vector<double> values);

}  // namespace brushfire::tool
