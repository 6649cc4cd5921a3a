// A hint to the processor that memory will be needed soon.
#pragma once

#include <brushfire/core/detail/inline.h>

namespace brushfire {

// Asks for the cache line at `address`, which may be anywhere. WebAssembly knows no such hint, and would compute the
// address all the same.
BRUSHFIRE_INLINE void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) && !defined(__wasm__)
  __builtin_prefetch(address);
#endif
}

}  // namespace brushfire
