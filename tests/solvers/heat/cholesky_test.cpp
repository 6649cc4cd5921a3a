// The factorization: real and Hermitian matrices solved, others refused.
#include <brushfire/core/error.h>
#include <brushfire/mesh/shapes.h>
#include <brushfire/solvers/heat/cholesky.h>
#include <brushfire/solvers/heat/operators.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace brushfire {
namespace {

using heat::Factors;
using heat::Pattern;

template <class Scalar>
Scalar conjugate(Scalar a) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return a;
  } else {
    return std::conj(a);
  }
}

template <class Scalar>
std::vector<Scalar> times(const Pattern& p, const std::vector<Scalar>& matrix, const std::vector<Scalar>& x) {
  std::vector<Scalar> y(x.size());
  for (int c = 0; c < p.columns(); ++c) {
    for (int e = p.start[c]; e < p.start[c + 1]; ++e) {
      y[p.row[e]] += matrix[e] * x[c];
      if (p.row[e] != c) y[c] += conjugate(matrix[e]) * x[p.row[e]];
    }
  }
  return y;
}

heat::Operators torus() {
  heat::Operators o = heat::operators_of(heat::triangulation_of(shapes::torus(40, 17).mesh(), heat::Cover::Single));
  for (int c = 0; c < o.pattern.columns(); ++c) o.laplacian[o.pattern.start[c]] += o.mass[c];
  return o;
}

class Cholesky : public testing::Test {
 protected:
  void SetUp() override {
    if (!heat::can_factor()) GTEST_SKIP() << "this build has no Eigen";
  }
};

TEST_F(Cholesky, SolvesEveryMatrixOfThePatternForAnyNumberOfColumns) {
  const heat::Operators o = torus();
  std::vector<std::vector<double>> matrices{o.laplacian, o.laplacian, o.laplacian};
  for (double& entry : matrices[1]) entry *= 3;
  for (int c = 0; c < o.pattern.columns(); ++c) matrices[2][o.pattern.start[c]] += 1 + c % 7;
  const std::size_t n = o.mass.size();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (std::size_t count = 1; count <= 3; ++count) {
    const Factors<double> factors(o.pattern, std::span(matrices).first(count));
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t width = 1; width <= 15; ++width) {
        std::vector<std::vector<double>> truth(width, std::vector<double>(n));
        std::vector<double> x(n * width);
        for (std::size_t j = 0; j < width; ++j) {
          for (double& t : truth[j]) t = number(random);
          const std::vector<double> b = times(o.pattern, matrices[k], truth[j]);
          for (std::size_t i = 0; i < n; ++i) x[width * i + j] = b[i];
        }
        factors.solve(k, width, x);
        for (std::size_t j = 0; j < width; ++j) {
          for (std::size_t i = 0; i < n; ++i) ASSERT_NEAR(x[width * i + j], truth[j][i], 1e-11) << k << " " << width;
        }
      }
    }
  }
}

TEST_F(Cholesky, SolvesHermitianMatrices) {
  const heat::Operators o = torus();
  std::vector<std::complex<double>> matrix(o.laplacian.begin(), o.laplacian.end());
  for (int c = 0; c < o.pattern.columns(); ++c) {
    for (int e = o.pattern.start[c] + 1; e < o.pattern.start[c + 1]; ++e) matrix[e] *= std::polar(1.0, 0.1 * e);
  }
  const Factors<std::complex<double>> factors(o.pattern, {&matrix, 1});
  std::vector<std::complex<double>> truth;
  for (int i = 0; i < o.pattern.columns(); ++i) truth.push_back(std::polar(1.0 + 0.1 * (i % 5), 1.7 * i));
  std::vector<std::complex<double>> x = times(o.pattern, matrix, truth);
  factors.solve(0, 1, x);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(std::abs(x[i] - truth[i]), 0, 1e-11);
}

TEST_F(Cholesky, AMatrixThatIsNotPositiveIsAnError) {
  const heat::Operators o = torus();
  std::vector<double> negative = o.laplacian;
  negative[o.pattern.start[5]] = -1;
  EXPECT_THROW(Factors<double>(o.pattern, {&negative, 1}), Error);
}

TEST(CholeskyWithoutEigen, SaysWhatToInstall) {
  if (heat::can_factor()) GTEST_SKIP() << "this build has Eigen";
  try {
    heat::require_factorization();
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("libeigen3-dev"), std::string::npos);
  }
}

}  // namespace
}  // namespace brushfire
