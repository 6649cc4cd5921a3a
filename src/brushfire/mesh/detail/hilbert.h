// The place of a cell on the Hilbert curve.
#pragma once

#include <cstdint>

namespace brushfire::detail {

inline constexpr int kHilbertBits = 10;  // the cube has 2^kHilbertBits cells a side

// x, y, z below 2^kHilbertBits; the result is below 2^(3 kHilbertBits). Defined in locality_order.cpp.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z);

}  // namespace brushfire::detail
