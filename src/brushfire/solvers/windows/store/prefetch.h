// A hint to the processor that memory will be needed soon.
#pragma once

namespace brushfire::windows {

// Nothing in WebAssembly, which has no such hint, so that nothing is computed for it either.
[[gnu::always_inline]] inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) && !defined(__wasm__)
  __builtin_prefetch(address);
  // Without this, GCC takes functions that only prefetch to be without effect and drops calls of them.
  __asm__ volatile("" : : "r"(address));
#endif
}

}  // namespace brushfire::windows
