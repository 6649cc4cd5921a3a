// A sparse matrix and its transpose, merged row by row.
#include <brushfire/core/error.h>
#include <brushfire/queries/matrix_job.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

// The columns of each row ascend, as rows are gone through in their order.
template <class T>
SparseMatrix<T> transposed(const SparseMatrix<T>& m) {
  SparseMatrix<T> t;
  t.columns = static_cast<Index>(m.row_start.size() - 1);
  t.row_start.assign(std::size_t{m.columns} + 1, 0);
  for (const Index c : m.column) ++t.row_start[std::size_t{c} + 1];
  for (std::size_t c = 0; c < m.columns; ++c) t.row_start[c + 1] += t.row_start[c];
  t.column.resize(m.column.size());
  t.value.resize(m.value.size());
  std::vector<std::uint64_t> next(t.row_start.begin(), t.row_start.end() - 1);
  for (std::size_t i = 0; i + 1 < m.row_start.size(); ++i) {
    for (auto k = static_cast<std::size_t>(m.row_start[i]); k < m.row_start[i + 1]; ++k) {
      const auto to = static_cast<std::size_t>(next[m.column[k]]++);
      t.column[to] = static_cast<Index>(i);
      t.value[to] = m.value[k];
    }
  }
  return t;
}

}  // namespace

template <class T>
SparseMatrix<T> symmetrized(const SparseMatrix<T>& matrix, Symmetry symmetry) {
  if (matrix.row_start.size() != std::size_t{matrix.columns} + 1) {
    throw Error(ErrorCode::InvalidArgument, "a symmetric matrix needs as many rows as columns");
  }
  const SparseMatrix<T> other = transposed(matrix);
  SparseMatrix<T> both;
  both.columns = matrix.columns;
  both.row_start.push_back(0);
  for (std::size_t i = 0; i + 1 < matrix.row_start.size(); ++i) {
    auto a = static_cast<std::size_t>(matrix.row_start[i]), b = static_cast<std::size_t>(other.row_start[i]);
    while (a < matrix.row_start[i + 1] || b < other.row_start[i + 1]) {
      const Index column_a = a < matrix.row_start[i + 1] ? matrix.column[a] : kNoIndex;
      const Index column_b = b < other.row_start[i + 1] ? other.column[b] : kNoIndex;
      both.column.push_back(std::min(column_a, column_b));
      if (column_a == column_b) {
        const T x = matrix.value[a++], y = other.value[b++];
        both.value.push_back(symmetry == Symmetry::Mean ? x / 2 + y / 2 : std::min(x, y));
      } else {
        both.value.push_back(column_a < column_b ? matrix.value[a++] : other.value[b++]);
      }
    }
    both.row_start.push_back(both.column.size());
  }
  return both;
}

template SparseMatrix<float> symmetrized(const SparseMatrix<float>&, Symmetry);
template SparseMatrix<double> symmetrized(const SparseMatrix<double>&, Symmetry);

}  // namespace brushfire
