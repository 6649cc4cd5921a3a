// The kernels that are timed and counted, each with an input that never changes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace brushfire::benchmark {

// One run of a kernel; the number it returns depends on all that was computed, so that nothing is left out.
using Run = std::function<double()>;

struct Kernel {
  std::string name;              // without blanks
  std::size_t items = 0;         // that one run handles: vertices, windows, faces, look-ups
  std::function<Run()> prepare;  // builds the input; runs may be repeated and then do the same again
};

std::vector<Kernel> kernels();

}  // namespace brushfire::benchmark
