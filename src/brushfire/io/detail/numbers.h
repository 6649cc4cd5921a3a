// The number types that files have, and arrays of them as doubles or indices.
#pragma once

#include <brushfire/io/detail/binary.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace brushfire::detail {

enum class NumberType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

// What a file says about sizes, as a size in memory: the largest there is where that is less, which nothing holds.
constexpr std::size_t as_size(std::uint64_t n) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::size_t>::max();
  return static_cast<std::size_t>(std::min(n, kMost));
}

constexpr std::size_t size_of(NumberType t) {
  constexpr std::uint8_t kSize[]{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSize[static_cast<std::size_t>(t)];
}
constexpr bool is_integer(NumberType t) { return t < NumberType::Float32; }

// Calls use(T{}) with the C++ type of `t`.
template <class Use>
decltype(auto) with_type(NumberType t, Use&& use) {
  switch (t) {
    case NumberType::Int8:
      return use(std::int8_t{});
    case NumberType::UInt8:
      return use(std::uint8_t{});
    case NumberType::Int16:
      return use(std::int16_t{});
    case NumberType::UInt16:
      return use(std::uint16_t{});
    case NumberType::Int32:
      return use(std::int32_t{});
    case NumberType::UInt32:
      return use(std::uint32_t{});
    case NumberType::Int64:
      return use(std::int64_t{});
    case NumberType::UInt64:
      return use(std::uint64_t{});
    case NumberType::Float32:
      return use(float{});
    case NumberType::Float64:
      break;
  }
  return use(double{});
}

inline double load_number(NumberType type, const char* p, std::endian order) {
  return with_type(type, [&](auto t) { return static_cast<double>(load<decltype(t)>(p, order)); });
}

// `count` numbers from packed bytes. Integers beyond 2^53 round, which no vertex number or coordinate reaches.
inline void load_numbers(NumberType type, const char* p, std::endian order, std::size_t count, double* out) {
  with_type(type, [&](auto t) {
    for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<double>(load<decltype(t)>(p + k * sizeof t, order));
  });
}

}  // namespace brushfire::detail
