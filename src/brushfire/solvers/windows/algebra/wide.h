// Run-time choice of wider vector instructions for loops over columns.
#pragma once

// Put before a function: it is compiled for wider vectors as well, and the loader chooses by the processor. The results
// are the same: no sum is reordered, no product fused. The file needs -O3 -fno-math-errno -fno-trapping-math for square
// roots and comparisons to become vector instructions. (A macro, because attributes have no other name.)
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if __GNUC__ >= 12
#define BRUSHFIRE_WIDE __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else  // does not know levels (Ubuntu 22.04's g++ is 11)
#define BRUSHFIRE_WIDE __attribute__((target_clones("default", "avx2")))
#endif
#else
#define BRUSHFIRE_WIDE
#endif
