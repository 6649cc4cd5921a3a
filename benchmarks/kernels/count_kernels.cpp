// Runs kernels once for callgrind, which counts the instructions of counted() and of what it calls: budgets.sh.
//
//   count_kernels KERNEL ...    each is prepared, run once to warm up, and run once counted
//   count_kernels --compiler    what it was built with
#include <cstdio>
#include <stdexcept>
#include <string>

#include "kernels.h"

// Its name is what callgrind looks for.
extern "C" [[gnu::noinline]] double counted(const brushfire::benchmark::Run& run) { return run(); }

int main(int count, char** arguments) {
  try {
    const auto kernels = brushfire::benchmark::kernels();
    for (int i = 1; i < count; ++i) {
      if (std::string(arguments[i]) == "--compiler") {
#ifdef __clang__
        std::printf("clang++ %d\n", __clang_major__);
#else
        std::printf("g++ %d\n", __GNUC__);
#endif
        continue;
      }
      bool found = false;
      for (const auto& kernel : kernels) {
        if (kernel.name != arguments[i]) continue;
        found = true;
        const brushfire::benchmark::Run run = kernel.prepare();
        const double warm = run();
        if (counted(run) != warm) throw std::runtime_error(kernel.name + ": a second run computes something else");
      }
      if (!found) throw std::runtime_error("there is no kernel '" + std::string(arguments[i]) + "'");
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "count_kernels: %s\n", error.what());
    return 1;
  }
  return 0;
}
