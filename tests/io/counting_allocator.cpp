// operator new and delete that keep count. A file of its own, so that the compiler cannot look into them.
#include "counting_allocator.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> in_use{0}, peak{0}, allocations{0};

void* counted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  ++allocations;
  const std::size_t now = in_use += malloc_usable_size(p);
  std::size_t before = peak;
  while (now > before && !peak.compare_exchange_weak(before, now)) {
  }
  return p;
}

}  // namespace

namespace brushfire::test {

std::size_t memory_in_use() { return in_use; }
std::size_t memory_peak() { return peak; }
void reset_memory_peak() { peak = in_use.load(); }
std::size_t allocation_count() { return allocations; }

}  // namespace brushfire::test

void* operator new(std::size_t size) { return counted(std::malloc(size)); }

void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(align, (size + align - 1) / align * align));
}

void operator delete(void* p) noexcept {
  in_use -= malloc_usable_size(p);
  std::free(p);
}

void operator delete(void* p, std::size_t) noexcept { operator delete(p); }
void operator delete(void* p, std::align_val_t) noexcept { operator delete(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { operator delete(p); }
