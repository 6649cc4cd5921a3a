// Sparse Cholesky factors of symmetric positive definite matrices, and solving with them for several right-hand sides
// side by side. The ordering, the symbolic and the numeric factorization are Eigen's (SimplicialLDLT); built without
// Eigen, everything here throws Error(InvalidArgument) that names what to install.
#pragma once

#include <brushfire/core/types.h>

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace brushfire::heat {

// Whether this build has Eigen.
bool can_factor();
// Throws what the factorizations throw without it.
void require_factorization();

inline double conjugate(double a) { return a; }
inline std::complex<double> conjugate(std::complex<double> a) { return std::conj(a); }

// The pattern of symmetric matrices: for every column its diagonal entry and the entries below, rows ascending.
struct Pattern {
  std::vector<int> start;  // [columns + 1]
  std::vector<int> row;    // [entries]
  int columns() const { return static_cast<int>(start.size()) - 1; }
};

// L D L^H = P A P^T for several matrices A of one pattern, which share the permutation P and the pattern of L.
template <class Scalar>
class Factors {
 public:
  // values[k][e]: entry e of matrix k. Up to three matrices, factored together. Throws Error(InvalidArgument) where one
  // of them is far from positive definite. Costs little more than one sparse factorization.
  Factors(const Pattern& pattern, std::span<const std::vector<Scalar>> values);

  // Solves A_k x = b for `width` right-hand sides: x[width * i + j] is entry i of column j, b before and x after.
  void solve(std::size_t k, std::size_t width, std::span<Scalar> x) const;

  std::size_t entries() const { return row_.size(); }

 private:
  template <std::size_t kWidth>
  void solve_columns(std::size_t k, Scalar* x) const;

  std::vector<int> position_;                // [columns] of the original's rows, where the permutation takes them
  std::vector<int> start_, row_;             // of L, strictly below the diagonal, column by column
  std::vector<std::vector<Scalar>> values_;  // [matrices][entries]
  std::vector<std::vector<double>> inverse_diagonal_;
};

// Solves A x = b for a dense symmetric positive definite A, [n * n]; b becomes x.
void solve_dense(std::span<const double> matrix, std::span<double> b);

extern template class Factors<double>;
extern template class Factors<std::complex<double>>;

}  // namespace brushfire::heat
