// Numbers out of bytes, in either byte order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

namespace brushfire::detail {

// The T whose bytes start at p (unaligned), in the given byte order.
template <class T>
T load(const char* p, std::endian order) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, p, sizeof(T));
  if (order != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class T>
void store(T value, char* p, std::endian order) {
  std::memcpy(p, &value, sizeof(T));
  if (order != std::endian::native) std::reverse(p, p + sizeof(T));
}

}  // namespace brushfire::detail
