// Storage for arrays that are filled once: not set to zero first.
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace brushfire {

// An allocator that leaves numbers uninitialised where std::allocator would set them to zero: touching memory for the
// first time costs as much as computing what goes there. (Huge pages were tried: docs/decisions/marching.md.)
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };

  UninitializedAllocator() = default;
  template <class U>
  UninitializedAllocator(const UninitializedAllocator<U>&) {}  // NOLINT(google-explicit-constructor): a rebound one

  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;  // not U(): no zeros
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
