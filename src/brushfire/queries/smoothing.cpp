// Distances within the kernel's reach become its weights.
#include <brushfire/queries/smoothing.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/queries/vertex_measures.h>

#include <cmath>
#include <string>

namespace brushfire {

SparseMatrix<double> smoothing_kernel(const Domain& domain, double sigma, const MatrixOptions& options) {
  if (!(sigma > 0) || !std::isfinite(sigma)) {
    throw Error(ErrorCode::InvalidArgument, "sigma " + std::to_string(sigma) + " is not a finite number > 0");
  }
  const std::vector<double> area = vertex_areas(domain);
  SparseMatrix<double> kernel = distances_within<double>(domain, kKernelReach * sigma, std::nullopt, options);
  for (std::size_t row = 0; row + 1 < kernel.row_start.size(); ++row) {
    double sum = 0;
    for (auto i = static_cast<std::size_t>(kernel.row_start[row]); i < kernel.row_start[row + 1]; ++i) {
      const double share = kernel.value[i] / sigma;
      kernel.value[i] = std::exp(-0.5 * share * share) * area[kernel.column[i]];
      sum += kernel.value[i];
    }
    for (auto i = static_cast<std::size_t>(kernel.row_start[row]); i < kernel.row_start[row + 1]; ++i) {
      // Faces without area all around: the vertex itself is all there is.
      kernel.value[i] = sum > 0 ? kernel.value[i] / sum : (kernel.column[i] == row ? 1 : 0);
    }
  }
  return kernel;
}

std::vector<double> smoothed(const SparseMatrix<double>& kernel, std::span<const double> values) {
  if (values.size() != kernel.columns) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(values.size()) + " values for " + std::to_string(kernel.columns) + " vertices");
  }
  std::vector<double> result(values.begin(), values.end());
  Poll poll(256);
  for (std::size_t row = 0; row + 1 < kernel.row_start.size(); ++row) {
    poll();
    if (std::isnan(values[row])) continue;
    double sum = 0, weight = 0;
    for (auto i = static_cast<std::size_t>(kernel.row_start[row]); i < kernel.row_start[row + 1]; ++i) {
      const double value = values[kernel.column[i]];
      if (std::isnan(value)) continue;
      sum += kernel.value[i] * value;
      weight += kernel.value[i];
    }
    if (weight > 0) result[row] = sum / weight;
  }
  return result;
}

}  // namespace brushfire
