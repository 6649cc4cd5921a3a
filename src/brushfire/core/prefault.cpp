// Prefaults pages by madvise(), where there is such an advice.
#include <brushfire/core/detail/prefault.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace brushfire {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;
constexpr std::size_t kWorthLargePages = 8 * kLargePage;  // some may come slowly before that is noticed

#if defined(__linux__) && defined(MADV_HUGEPAGE)
constexpr int kLarge = MADV_HUGEPAGE, kSmall = MADV_NOHUGEPAGE;
#else
constexpr int kLarge = 0, kSmall = 0;
#endif

// Advice on the whole large pages in between.
void advise([[maybe_unused]] std::byte* begin, [[maybe_unused]] std::byte* end, [[maybe_unused]] int advice) noexcept {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  const std::size_t before = (kLargePage - reinterpret_cast<std::uintptr_t>(begin) % kLargePage) % kLargePage;
  const auto bytes = static_cast<std::size_t>(end - begin);
  if (bytes < before + kLargePage) return;
  static_cast<void>(madvise(begin + before, (bytes - before) / kLargePage * kLargePage, advice));
#endif
}

#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
// The first page that is not present; `end` where all are. What an allocator hands out again often is, and asking costs
// a tenth of prefaulting what is present.
std::byte* first_absent(std::byte* begin, std::byte* end, std::size_t page) noexcept {
  constexpr std::size_t kAtOnce = 256;
  std::array<unsigned char, kAtOnce> present;
  while (begin < end) {
    const std::size_t pages = std::min(kAtOnce, static_cast<std::size_t>(end - begin) / page);
    if (mincore(begin, pages * page, present.data()) != 0) return begin;
    const auto* const absent =
        std::find_if(present.data(), present.data() + pages, [](unsigned char p) { return (p & 1u) == 0; });
    begin += static_cast<std::size_t>(absent - present.data()) * page;
    if (absent != present.data() + pages) return begin;
  }
  return end;
}
#endif

}  // namespace

void prefault([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
  constexpr std::size_t kLeast = std::size_t{256} << 10;
  if (bytes < kLeast) return;
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto at = reinterpret_cast<std::uintptr_t>(begin);
  std::byte* const end = static_cast<std::byte*>(begin) + bytes - (at + bytes) % page;
  std::byte* const first = first_absent(static_cast<std::byte*>(begin) + (page - at % page) % page, end, page);
  // An advice: where it is not understood, pages come one by one.
  if (first < end) static_cast<void>(madvise(first, static_cast<std::size_t>(end - first), MADV_POPULATE_WRITE));
#endif
}

PagesAhead::PagesAhead(void* begin, std::size_t bytes) noexcept
    : present_(static_cast<std::byte*>(begin)), end_(present_ + bytes), large_(bytes >= kWorthLargePages) {
  if (large_) advise(present_, end_, kLarge);
}

// From one large page to the next. (Asking for large pages for all arrays of that size was worse:
// docs/decisions/speed.md.)
void PagesAhead::make_present(const void* at) noexcept {
  // Twice what small pages take for as much memory. Large ones take 200, or 4000 where they are not at hand.
  constexpr std::chrono::microseconds kSlow{1500};
  while (at >= present_ && present_ < end_) {
    const std::size_t rest = kLargePage - reinterpret_cast<std::uintptr_t>(present_) % kLargePage;
    const std::size_t bytes = std::min(rest, static_cast<std::size_t>(end_ - present_));
    const auto begin = std::chrono::steady_clock::now();
    prefault(present_, bytes);
    // A host may provide what is present only now, small page by small page.
    constexpr std::size_t kSmallPage = 4096;
    for (std::size_t i = 0; large_ && i < bytes; i += kSmallPage) present_[i] = std::byte{0};
    present_ += bytes;
    if (!large_ || std::chrono::steady_clock::now() - begin < kSlow) continue;
    large_ = false;
    advise(present_, end_, kSmall);
  }
}

}  // namespace brushfire
