// Storage for arrays that are filled once: not set to zero first.
#pragma once

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace brushfire {

// An allocator that leaves numbers, and aggregates of numbers (whatever their members' initialisers say), uninitialised
// where std::allocator would set them to zero: touching memory for the first time costs as much as computing what goes
// there. (Huge pages were tried: docs/decisions/speed.md.)
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {  // NOLINT(readability-identifier-naming): the standard's name
    using other = UninitializedAllocator<U>;
  };

  UninitializedAllocator() = default;
  template <class U>
  UninitializedAllocator(const UninitializedAllocator<U>&) {}  // NOLINT(google-explicit-constructor): a rebound one

  template <class U>
  void construct(U*) {
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);  // exists by being allocated
  }
  template <class U, class First, class... Rest>
  void construct(U* at, First&& first, Rest&&... rest) {
    ::new (static_cast<void*>(at)) U(std::forward<First>(first), std::forward<Rest>(rest)...);
  }
};

// A vector whose elements are not initialised where no value is given: UninitializedArray<T>(n), resize(n).
template <class T>
using UninitializedArray = std::vector<T, UninitializedAllocator<T>>;

}  // namespace brushfire
