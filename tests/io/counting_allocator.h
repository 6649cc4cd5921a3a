// Counts what the process allocates through operator new: link counting_allocator.cpp.
#pragma once

#include <cstddef>

namespace brushfire::test {

std::size_t memory_in_use();
std::size_t memory_peak();  // since the last reset
void reset_memory_peak();
std::size_t allocation_count();  // so far

}  // namespace brushfire::test
