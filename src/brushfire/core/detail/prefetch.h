// A hint to the processor that memory will be needed soon.
#pragma once

#include <brushfire/core/detail/inline.h>

namespace brushfire {

// Asks for the cache line at `address`, which may be anywhere.
BRUSHFIRE_INLINE void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#endif
}

}  // namespace brushfire
