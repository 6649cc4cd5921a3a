// Memory that is about to be written, made present all at once.
#pragma once

#include <brushfire/core/uninitialized.h>

#include <cstddef>

namespace brushfire {

// Where the system can (Linux 5.14), makes the pages between `begin` and `begin + bytes` present, which costs less than
// a fault for each of them when it is written. Says nothing about what is in them; does nothing to less than a
// megabyte.
void populate(void* begin, std::size_t bytes) noexcept;

template <class T>
void populate(UninitializedArray<T>& array) noexcept {
  populate(array.data(), array.size() * sizeof(T));
}

}  // namespace brushfire
