// Memory that is about to be written, made present all at once.
#pragma once

#include <brushfire/core/detail/uninitialized.h>

#include <cstddef>

namespace brushfire {

// Where the system can (Linux 5.14), makes the pages between `begin` and `begin + bytes` present, which costs less than
// a fault for each of them when it is written. Says nothing about what is in them; does nothing to less than a
// quarter of a megabyte.
void prefault(void* begin, std::size_t bytes) noexcept;

template <class T>
void prefault(UninitializedArray<T>& array) noexcept {
  prefault(array.data(), array.size() * sizeof(T));
}

// The same ahead of who writes an array from its beginning on, two megabytes at a time; what was there is lost. For
// arrays of many megabytes in large pages (Linux: transparent huge pages), where the system can and as long as these
// come quickly: they save faults now and misses of the TLB later, but a virtual machine's host may take twenty times as
// long to provide one as to provide small pages.
class PagesAhead {
 public:
  PagesAhead() = default;
  PagesAhead(void* begin, std::size_t bytes) noexcept;

  // Where the next write goes. Cheap to ask again and again.
  void reach(const void* at) noexcept {
    if (at >= present_ && present_ < end_) make_present(at);
  }

 private:
  void make_present(const void* at) noexcept;

  std::byte* present_ = nullptr;  // up to here pages are present
  std::byte* end_ = nullptr;
  bool large_ = false;
};

}  // namespace brushfire
