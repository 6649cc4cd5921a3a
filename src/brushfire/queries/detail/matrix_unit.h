// Rows of a matrix in another unit than the mesh's.
#pragma once

#include <brushfire/core/error.h>

#include <cmath>
#include <span>
#include <vector>

namespace brushfire::detail {

inline void require_unit(double unit) {
  if (!(unit > 0) || !std::isfinite(unit)) {
    throw Error(ErrorCode::InvalidArgument, "the unit of a matrix is a finite number > 0");
  }
}

// Divided in doubles, whatever the type.
template <class T>
std::vector<T> in_unit(std::span<const T> values, double unit) {
  std::vector<T> result(values.begin(), values.end());
  if (unit == 1) return result;
  for (T& v : result) v = static_cast<T>(static_cast<double>(v) / unit);
  return result;
}

}  // namespace brushfire::detail
