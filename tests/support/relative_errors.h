// How far values are from the truth.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace brushfire::test {

struct RelativeErrors {
  double mean = 0, largest = 0;
};

// Of values whose truth is finite and above 0; there must be some.
inline RelativeErrors relative_errors(const std::vector<double>& found, const std::vector<double>& truth) {
  RelativeErrors e;
  double count = 0;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (!(truth[v] > 0) || !std::isfinite(truth[v])) continue;
    const double error = std::abs(found[v] / truth[v] - 1);
    e.mean += error;
    e.largest = std::max(e.largest, error);
    ++count;
  }
  e.mean /= count;
  return e;
}

}  // namespace brushfire::test
