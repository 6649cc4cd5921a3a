// The only file that knows Eigen.
#include <brushfire/solvers/heat/cholesky.h>

#include <brushfire/config.h>
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <array>
#include <type_traits>

#ifdef BRUSHFIRE_HAS_EIGEN
#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#endif

namespace brushfire::heat {

#ifdef BRUSHFIRE_HAS_EIGEN

namespace {

// Numbers side by side: one factorization does the arithmetic of several matrices.
template <class Scalar, int N>
struct Abreast {
  std::array<Scalar, N> at{};

  Abreast() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): as Eigen makes its constants
  Abreast(double value) { at.fill(Scalar(value)); }
  Abreast& operator+=(const Abreast& b) { return *this = *this + b; }
  Abreast& operator-=(const Abreast& b) { return *this = *this - b; }
  friend Abreast operator+(const Abreast& a, const Abreast& b) {
    return each([&](int i) { return a.at[i] + b.at[i]; });
  }
  friend Abreast operator-(const Abreast& a, const Abreast& b) {
    return each([&](int i) { return a.at[i] - b.at[i]; });
  }
  friend Abreast operator*(const Abreast& a, const Abreast& b) {
    return each([&](int i) { return a.at[i] * b.at[i]; });
  }
  friend Abreast operator/(const Abreast& a, const Abreast& b) {
    return each([&](int i) { return a.at[i] / b.at[i]; });
  }
  friend bool operator==(const Abreast& a, const Abreast& b) { return a.at == b.at; }
  // Compiled by Eigen for LL^T, which is not used.
  friend bool operator<=(const Abreast& a, const Abreast& b) { return a.at <= b.at; }
  friend Abreast sqrt(const Abreast& a) { return a; }

 private:
  template <class Make>
  static Abreast each(const Make& make) {
    Abreast result;
    for (int i = 0; i < N; ++i) result.at[i] = make(i);
    return result;
  }
};

}  // namespace
}  // namespace brushfire::heat

namespace Eigen {

template <int N>
struct NumTraits<brushfire::heat::Abreast<double, N>> : GenericNumTraits<brushfire::heat::Abreast<double, N>> {
  using Real = brushfire::heat::Abreast<double, N>;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N,
    AddCost = N,
    MulCost = N
  };
};

}  // namespace Eigen

namespace brushfire::heat {
namespace {

template <class Scalar, int N>
using Packed = std::conditional_t<N == 1, Scalar, Abreast<Scalar, N>>;

template <class Scalar, int N>
Scalar& lane(Packed<Scalar, N>& packed, int k) {
  if constexpr (N == 1) {
    return packed;
  } else {
    return packed.at[k];
  }
}

// What the factorization leaves, taken apart by matrices.
template <class Scalar>
struct Taken {
  std::vector<int> position, start, row;
  std::vector<std::vector<Scalar>> values;
  std::vector<std::vector<double>> inverse_diagonal;
};

template <class Scalar, int N>
Taken<Scalar> factor(const Pattern& pattern, std::span<const std::vector<Scalar>> values) {
  using Entry = Packed<Scalar, N>;
  const int n = pattern.columns();
  std::vector<Entry> packed(pattern.row.size());
  for (std::size_t e = 0; e < packed.size(); ++e) {
    for (int k = 0; k < N; ++k) lane<Scalar, N>(packed[e], k) = values[k][e];
  }
  const Eigen::Map<const Eigen::SparseMatrix<Entry>> matrix(n, n, static_cast<int>(packed.size()), pattern.start.data(),
                                                            pattern.row.data(), packed.data());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Entry>, Eigen::Lower> ldlt;
  ldlt.analyzePattern(matrix);
  stop_if_cancelled();
  ldlt.factorize(matrix);
  stop_if_cancelled();

  Taken<Scalar> taken;
  taken.values.resize(N);
  taken.inverse_diagonal.resize(N);
  taken.position.assign(ldlt.permutationP().indices().data(), ldlt.permutationP().indices().data() + n);
  const auto& lower = ldlt.matrixL().nestedExpression();
  const int entries = lower.outerIndexPtr()[n];
  taken.start.assign(lower.outerIndexPtr(), lower.outerIndexPtr() + n + 1);
  taken.row.assign(lower.innerIndexPtr(), lower.innerIndexPtr() + entries);
  const auto diagonal = ldlt.vectorD();
  for (int k = 0; k < N; ++k) {
    taken.values[k].resize(entries);
    for (int e = 0; e < entries; ++e) taken.values[k][e] = lane<Scalar, N>(const_cast<Entry&>(lower.valuePtr()[e]), k);
    taken.inverse_diagonal[k].resize(n);
    for (int i = 0; i < n; ++i) {
      Entry d = diagonal[i];
      const double value = std::real(lane<Scalar, N>(d, k));
      if (ldlt.info() != Eigen::Success || !(value > 0)) {
        throw Error(ErrorCode::InvalidArgument,
                    "the heat method's equations cannot be factored on this mesh: its lengths differ too much, or "
                    "faces are used as they are (delaunay off)");
      }
      taken.inverse_diagonal[k][i] = 1 / value;
    }
  }
  return taken;
}

}  // namespace

bool can_factor() { return true; }
void require_factorization() {}

template <class Scalar>
Factors<Scalar>::Factors(const Pattern& pattern, std::span<const std::vector<Scalar>> values) {
  Taken<Scalar> taken;
  if constexpr (std::is_same_v<Scalar, double>) {
    taken = values.size() == 1   ? factor<double, 1>(pattern, values)
            : values.size() == 2 ? factor<double, 2>(pattern, values)
                                 : factor<double, 3>(pattern, values);
  } else {
    taken = factor<Scalar, 1>(pattern, values);
  }
  position_ = std::move(taken.position);
  start_ = std::move(taken.start);
  row_ = std::move(taken.row);
  values_ = std::move(taken.values);
  inverse_diagonal_ = std::move(taken.inverse_diagonal);
}

void solve_dense(std::span<const double> matrix, std::span<double> b) {
  const auto n = static_cast<Eigen::Index>(b.size());
  const Eigen::Map<const Eigen::MatrixXd> a(matrix.data(), n, n);
  Eigen::Map<Eigen::VectorXd> x(b.data(), n);
  x = a.selfadjointView<Eigen::Lower>().ldlt().solve(x).eval();
}

#else

bool can_factor() { return false; }
void require_factorization() {
  if (!BRUSHFIRE_HEAT) {
    throw Error(ErrorCode::InvalidArgument, "the heat method was left out of this build (BRUSHFIRE_HEAT=OFF)");
  }
  throw Error(ErrorCode::InvalidArgument,
              "the heat method needs Eigen, which this build lacks: install it (Debian and Ubuntu: libeigen3-dev) and "
              "build again");
}

template <class Scalar>
Factors<Scalar>::Factors(const Pattern&, std::span<const std::vector<Scalar>>) {
  require_factorization();
}

void solve_dense(std::span<const double>, std::span<double>) { require_factorization(); }

#endif

template <class Scalar>
template <std::size_t kWidth>
void Factors<Scalar>::solve_columns(std::size_t k, Scalar* x) const {
  const int n = static_cast<int>(position_.size());
  const Scalar* const value = values_[k].data();
  const auto row = [&](int i) { return x + kWidth * static_cast<std::size_t>(i); };
  for (int j = 0; j < n; ++j) {
    std::array<Scalar, kWidth> top;
    std::copy_n(row(j), kWidth, top.begin());
    if (std::all_of(top.begin(), top.end(), [](const Scalar& s) { return s == Scalar{}; })) continue;
    for (int e = start_[j]; e < start_[j + 1]; ++e) {
      Scalar* const below = row(row_[e]);
      for (std::size_t w = 0; w < kWidth; ++w) below[w] -= value[e] * top[w];
    }
  }
  for (int j = n - 1; j >= 0; --j) {
    std::array<Scalar, kWidth> sum;
    std::copy_n(row(j), kWidth, sum.begin());
    for (Scalar& s : sum) s *= inverse_diagonal_[k][j];
    for (int e = start_[j]; e < start_[j + 1]; ++e) {
      const Scalar factor = conjugate(value[e]);
      const Scalar* const below = row(row_[e]);
      for (std::size_t w = 0; w < kWidth; ++w) sum[w] -= factor * below[w];
    }
    std::copy_n(sum.begin(), kWidth, row(j));
  }
}

template <class Scalar>
void Factors<Scalar>::solve(std::size_t k, std::size_t width, std::span<Scalar> x) const {
  constexpr std::size_t kMost = 8;
  const std::size_t n = position_.size();
  std::vector<Scalar> permuted;
  for (std::size_t first = 0; first < width;) {
    const std::size_t left = width - first;
    const std::size_t now = left >= kMost ? kMost : left >= 4 ? 4 : left >= 2 ? 2 : 1;
    permuted.resize(n * now);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t w = 0; w < now; ++w) permuted[now * position_[i] + w] = x[width * i + first + w];
    }
    stop_if_cancelled();
    if (now == kMost) solve_columns<kMost>(k, permuted.data());
    if (now == 4) solve_columns<4>(k, permuted.data());
    if (now == 2) solve_columns<2>(k, permuted.data());
    if (now == 1) solve_columns<1>(k, permuted.data());
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t w = 0; w < now; ++w) x[width * i + first + w] = permuted[now * position_[i] + w];
    }
    first += now;
  }
}

template class Factors<double>;
template class Factors<std::complex<double>>;

}  // namespace brushfire::heat
