// Processor time and memory, as Linux tells them; on other systems what is portable.
#include "process.h"

#include <ctime>

#include <algorithm>
#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace brushfire::tool {
namespace {

// A line of /proc/self/status. (getrusage's ru_maxrss would do, but it includes the program that started this one.)
std::uint64_t status_bytes(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string word; in >> word;) {
    std::uint64_t kib = 0;
    if (word == key && in >> kib) return 1024 * kib;
  }
  return 0;
}

}  // namespace

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::uint64_t resident_memory() { return status_bytes("VmRSS:"); }
std::uint64_t peak_memory() { return status_bytes("VmHWM:"); }

bool reset_peak_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream out("/proc/self/clear_refs");
  out << "5" << std::flush;  // the kernel's word for "the peak starts here"
  return out.good();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace brushfire::tool
