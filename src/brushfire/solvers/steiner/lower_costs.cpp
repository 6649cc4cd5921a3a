// The terms of lower_costs.h, a row at a time.
#include <brushfire/solvers/steiner/detail/lower_costs.h>

#include <algorithm>
#include <cmath>

namespace brushfire::steiner {
namespace {

// The i-th point counted from the common vertex, as a number of the row.
Index counted(const MeetingRow& row, Index i) { return row.at_last ? row.count - 1 - i : i; }

// Its distance from that vertex.
double from_vertex(const MeetingRow& row, Index i) {
  return row.at_last ? row.at[row.count - 1] - row.at[counted(row, i)] : row.at[i];
}

double longer_interval(const double* at, Index count, Index i) {
  return std::max(i > 0 ? at[i] - at[i - 1] : 0, i + 1 < count ? at[i + 1] - at[i] : 0);
}

// The most that the variance over the squared height is in the k-th interval [t0, t1] from the vertex: where t is the
// harmonic mean, (t - t0) (t1 - t) / t^2 is (t1 - t0)^2 / (4 t0 t1).
double quotient(const MeetingRow& row, double height_share, Index k) {
  if (k + 1 >= row.count) return 0;
  const double inner = from_vertex(row, k), outer = from_vertex(row, k + 1), length = outer - inner;
  if (length == 0) return 0;
  const double squares = 4 * height_share * height_share * inner * outer;
  return squares > 0 ? length * length / squares : kInfinity;
}

// `beside`: the least height of what lies next to the vertex, but not at it on both edges.
void terms(const MeetingRow& row, double height_share, double half_sine, double beside, LowerTerms& of) {
  for (Index k = 0; k < row.count; ++k) {
    const Index i = counted(row, k);
    const double reach = longer_interval(row.at, row.count, i);
    of.reach[i] = reach;
    of.variance[i] = 0.25 * reach * reach;
    of.quotient[i] = std::max(quotient(row, height_share, k), k > 0 ? quotient(row, height_share, k - 1) : 0);
    of.height[i] = k < 2 ? beside : height_share * from_vertex(row, k - 1);
    of.ceiling[i] = k < 2 ? half_sine * from_vertex(row, k) : kInfinity;
  }
}

}  // namespace

void lower_terms(const MeetingRow& a, const MeetingRow& b, double sine, double cosine, LowerTerms& of_a,
                 LowerTerms& of_b) {
  const double height_share = cosine > 0 ? sine : 1;  // beyond a right angle the vertex is what is nearest
  const double half_sine = std::sqrt(std::max(0.0, 0.5 * (1 - cosine)));
  const double beside = height_share * std::min(from_vertex(a, 1), from_vertex(b, 1));
  terms(a, height_share, half_sine, beside, of_a);
  terms(b, height_share, half_sine, beside, of_b);
}

double lower_cost(const double* at, Index count, Index i, double x, double y, double rounding) {
  const double d = std::max(0.0, std::hypot(x - at[i], y) - rounding);
  const double reach = longer_interval(at, count, i), apart = std::max(d - reach, y - rounding);
  if (reach == 0) return d;
  return apart > 0 ? d * (apart / std::sqrt(apart * apart + 0.25 * reach * reach)) : 0;
}

}  // namespace brushfire::steiner
