// Populates pages by madvise(), where there is such an advice.
#include <brushfire/core/populate.h>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <cstdint>

namespace brushfire {

void populate([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
  constexpr std::size_t kLeast = std::size_t{1} << 20;
  if (bytes < kLeast) return;
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  const std::size_t inside = (bytes - before) / page * page;
  // An advice: where it is not understood, pages come one by one.
  static_cast<void>(madvise(static_cast<std::byte*>(begin) + before, inside, MADV_POPULATE_WRITE));
#endif
}

}  // namespace brushfire
