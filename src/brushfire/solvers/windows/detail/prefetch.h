// A hint to the processor that memory will be needed soon.
#pragma once

namespace brushfire::detail {

inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#endif
}

}  // namespace brushfire::detail
