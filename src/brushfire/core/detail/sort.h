// Sorting what is sorted once a run or once a mesh.
//
// Every std::sort is two to six kilobytes of code for its kind of element and its order, eighty of them a quarter of
// what a page would fetch. So where a module of WebAssembly is made, all elements of one size share a merge sort that
// asks for the order through a pointer, and is half as fast. Natively this is std::sort. Inner loops have std::sort
// itself.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <type_traits>
#include <vector>

namespace brushfire::detail {

#if defined(__EMSCRIPTEN__)
inline constexpr bool kSmallCode = true;
#else
inline constexpr bool kSmallCode = false;
#endif

// Whether the element at `a` goes before that at `b`.
using Precedes = bool (*)(const void* order, const void* a, const void* b);

// Stable; `scratch` has room for half of the `count` elements of kSize bytes.
template <std::size_t kSize>
void merge_sort(std::byte* first, std::size_t count, std::byte* scratch, Precedes precedes, const void* order) {
  if (count < 2) return;
  const std::size_t half = count / 2;
  std::byte* const middle = first + half * kSize;
  merge_sort<kSize>(first, half, scratch, precedes, order);
  merge_sort<kSize>(middle, count - half, scratch, precedes, order);
  if (!precedes(order, middle, middle - kSize)) return;
  std::memcpy(scratch, first, half * kSize);
  const std::byte *a = scratch, *b = middle;
  const std::byte *const a_end = scratch + half * kSize, *const b_end = first + count * kSize;
  for (std::byte* to = first; a != a_end; to += kSize) {
    const std::byte*& from = b != b_end && precedes(order, b, a) ? b : a;
    std::memcpy(to, from, kSize);
    from += kSize;
  }
}

// Elements that may be moved as bytes: pairs and tuples of numbers, too, which only say that they are assigned
// otherwise.
template <class T>
inline constexpr bool kMovesAsBytes = std::is_trivially_copy_constructible_v<T> && std::is_trivially_destructible_v<T>;

template <class T, class Order>
void sort_bytes(T* first, std::size_t count, const Order& order) {
  const Precedes precedes = [](const void* o, const void* a, const void* b) {
    return static_cast<bool>((*static_cast<const Order*>(o))(*static_cast<const T*>(a), *static_cast<const T*>(b)));
  };
  constexpr std::size_t kFew = 16;
  alignas(T) std::array<std::byte, kFew / 2 * sizeof(T)> few;
  std::vector<std::byte> many;
  if (count > kFew) many.resize(count / 2 * sizeof(T));
  merge_sort<sizeof(T)>(reinterpret_cast<std::byte*>(first), count, count > kFew ? many.data() : few.data(), precedes,
                        &order);
}

// Elements between two iterators into an array. Equal ones stay in no particular order.
template <class Iterator, class Order = std::less<>>
void sort(Iterator first, Iterator last, const Order& order = {}) {
  using T = typename std::iterator_traits<Iterator>::value_type;
  if constexpr (kSmallCode && kMovesAsBytes<T>) {
    if (first != last) sort_bytes(std::to_address(first), static_cast<std::size_t>(last - first), order);
  } else {
    std::sort(first, last, order);
  }
}

// Equal ones keep their order.
template <class Iterator, class Order = std::less<>>
void stable_sort(Iterator first, Iterator last, const Order& order = {}) {
  using T = typename std::iterator_traits<Iterator>::value_type;
  if constexpr (kSmallCode && kMovesAsBytes<T>) {
    if (first != last) sort_bytes(std::to_address(first), static_cast<std::size_t>(last - first), order);
  } else {
    std::stable_sort(first, last, order);
  }
}

}  // namespace brushfire::detail
