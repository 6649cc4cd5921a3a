// operator new and delete that keep count. A file of its own, so that the compiler cannot look into them.
#include "counting_allocator.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> in_use{0}, peak{0};

}  // namespace

namespace brushfire::test {

std::size_t memory_in_use() { return in_use; }
std::size_t memory_peak() { return peak; }
void reset_memory_peak() { peak = in_use.load(); }

}  // namespace brushfire::test

void* operator new(std::size_t size) {
  void* p = std::malloc(size);
  if (p == nullptr) throw std::bad_alloc();
  const std::size_t now = in_use += malloc_usable_size(p);
  std::size_t before = peak;
  while (now > before && !peak.compare_exchange_weak(before, now)) {
  }
  return p;
}

void operator delete(void* p) noexcept {
  in_use -= malloc_usable_size(p);
  std::free(p);
}

void operator delete(void* p, std::size_t) noexcept { operator delete(p); }
