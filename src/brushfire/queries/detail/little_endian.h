// Values as the bytes that files have.
#pragma once

#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <brushfire/io/detail/binary.h>

namespace brushfire::detail {

template <class T>
std::string as_little_endian(std::span<const T> values) {
  if constexpr (std::endian::native == std::endian::little) {
    return std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  } else {
    std::string bytes(values.size_bytes(), '\0');
    for (std::size_t k = 0; k < values.size(); ++k) store(values[k], bytes.data() + k * sizeof(T), std::endian::little);
    return bytes;
  }
}

}  // namespace brushfire::detail
