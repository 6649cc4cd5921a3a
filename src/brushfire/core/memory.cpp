// Available memory, from where Linux tells it.
#include <brushfire/core/detail/memory.h>

#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <limits>

#if defined(__EMSCRIPTEN__)
#include <malloc.h>
#endif

namespace brushfire {

#if defined(__EMSCRIPTEN__)

// A module's memory grows up to 4 GB; what was let go of in it is taken again first.
std::uint64_t available_memory() {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 32, kPage = std::uint64_t{1} << 16;
  return kMost - kPage * __builtin_wasm_memory_size(0) + static_cast<std::uint64_t>(mallinfo().fordblks);
}

#else

namespace {

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

// The first number in the file; kUnknown where there is no such file or no number ("max").
std::uint64_t number_in(const char* path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? number : kUnknown;
}

std::uint64_t available_in_system() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    std::uint64_t kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return kilobytes * 1024;
  }
  return kUnknown;
}

std::uint64_t available_in_control_group() {
  const std::uint64_t limit = number_in("/sys/fs/cgroup/memory.max");
  const std::uint64_t used = number_in("/sys/fs/cgroup/memory.current");
  if (limit == kUnknown || used == kUnknown) return kUnknown;
  return limit > used ? limit - used : 0;
}

}  // namespace

std::uint64_t available_memory() { return std::min(available_in_system(), available_in_control_group()); }

#endif

std::string bytes_as_text(std::uint64_t bytes) {
  constexpr std::array kUnits{"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < kUnits.size(); ++unit) value /= 1000;
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g %s", value, kUnits[unit]);
  return text.data();
}

void require_memory(std::uint64_t bytes, std::uint64_t limit, const std::string& what, const std::string& advice) {
  // No array is larger than what its size can be, whatever the caller allows.
  constexpr std::uint64_t kMost = std::numeric_limits<std::size_t>::max();
  const std::uint64_t available = std::min(limit == 0 ? available_memory() : limit, kMost);
  if (bytes <= available) return;
  throw Error(ErrorCode::TooLarge, what + " needs " + bytes_as_text(bytes) + ", but " + bytes_as_text(available) +
                                       " are available: " + advice);
}

}  // namespace brushfire
