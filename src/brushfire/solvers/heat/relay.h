// Heat that has to go farther than doubles reach: it falls by a factor of e with every sqrt(t), that is about one edge,
// and is 0 some seven hundred edges away. Where it has become small it is taken as what it is there, made larger, and
// sent on: with a matrix whose off-diagonal entries are <= 0 all sums are of positive numbers, so that its digits are
// right however small it is.
#pragma once

#include <brushfire/solvers/heat/cholesky.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace brushfire::heat {

// Positive numbers, far below the least double too: value * kStep^level.
struct Heat {
  static constexpr double kStep = 1e-200;
  // The products of what is larger with matrix entries are far from denormal.
  static constexpr double kStarving = 1e-290;
  std::vector<double> value;         // [vertex_count] 0 where no heat comes
  std::vector<std::uint32_t> level;  // [vertex_count] ascends away from the sources

  // The unit of vertex v, in units of a level.
  double unit(std::size_t v, std::uint32_t in_level) const;
};

// Whether somewhere in `heated`, [vertex_count], heat has become too small to go on: every width-th value.
bool starves(const std::vector<std::uint8_t>& heated, std::span<const double> value, std::size_t width = 1);

// Asked with ascending levels for the heat at the vertices that are `beyond`, [vertex_count], in units of kStep^level.
using SendOn = std::function<std::vector<double>(std::uint32_t level, const std::vector<std::uint8_t>& beyond)>;

// From heat in units of 1, right where it is not small, heat at all the vertices that are `heated`.
Heat relayed(std::vector<double> value, std::vector<std::uint8_t> heated, const SendOn& send_on);

// The right-hand side whose solution is `last` / kStep at the vertices beyond and 0 at the others, but for what is put
// in there: what the matrix couples over their edge. Columns side by side.
template <class Scalar>
std::vector<Scalar> sent_over(const Pattern& pattern, std::span<const Scalar> matrix,
                              const std::vector<std::uint8_t>& beyond, std::span<const Scalar> last,
                              std::size_t width = 1) {
  std::vector<Scalar> next(last.size(), Scalar{});
  for (int column = 0; column < pattern.columns(); ++column) {
    for (int e = pattern.start[column] + 1; e < pattern.start[column + 1]; ++e) {
      const int row = pattern.row[e];
      if (beyond[column] == beyond[row]) continue;
      const double sign = beyond[row] ? 1 : -1;
      for (std::size_t j = 0; j < width; ++j) {
        const Scalar to_row = sign * matrix[e], to_column = -sign * conjugate(matrix[e]);
        next[width * row + j] -= to_row * (last[width * column + j] / Heat::kStep);
        next[width * column + j] -= to_column * (last[width * row + j] / Heat::kStep);
      }
    }
  }
  return next;
}

}  // namespace brushfire::heat
