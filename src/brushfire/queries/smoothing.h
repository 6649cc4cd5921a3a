// Smoothing of values on a surface with a Gaussian of the geodesic distance.
#pragma once

#include <brushfire/mesh/domain.h>
#include <brushfire/queries/distance_matrix.h>

#include <span>
#include <vector>

namespace brushfire {

// The full width at half maximum of a Gaussian of standard deviation 1: sigma = fwhm / kFwhmPerSigma.
inline constexpr double kFwhmPerSigma = 2.3548200450309493;  // 2 sqrt(2 ln 2)
// A kernel ends at this many sigma, where it is 3.4e-4 of its height.
inline constexpr double kKernelReach = 4;

// One row per vertex: exp(-d^2 / (2 sigma^2)) times the area of each vertex within kKernelReach sigma, divided by their
// sum, so that rows sum to 1 and what is dense in vertices does not count for more. Nothing is carried through walls;
// the row of a vertex in no open face is empty. Throws Error(InvalidArgument) for a sigma that is not finite and > 0,
// and as distances_within() does, whose cost it has.
SparseMatrix<double> smoothing_kernel(const Domain& domain, double sigma, const MatrixOptions& options = {});

// The rows' means of one value per vertex. Values that are NaN do not count (the weights of the others are made to sum
// to 1), and a vertex whose own value is NaN, or whose row is empty, keeps what it has. Throws
// Error(InvalidArgument) where there is not one value per column. O(entries).
std::vector<double> smoothed(const SparseMatrix<double>& kernel, std::span<const double> values);

}  // namespace brushfire
