// Mean edges, mollification and times, component by component.
#include <brushfire/solvers/heat/scales.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <cstddef>

namespace brushfire::heat {
namespace {

// The fourth powers of mollified lengths (in areas, squared) still have numbers.
constexpr double kNowhere = 1e-60;

}  // namespace

std::vector<double> mean_edge_lengths(const Triangulation& t, const detail::Components& components) {
  if (components.count == 1) return {mean_edge_length(t)};  // the same sums, in registers
  std::vector<double> sum(components.count, 0.0), edges(components.count, 0.0);
  for (Index h = 0; h < t.tail.size(); ++h) {
    if (t.twin[h] < h) continue;
    sum[components.of_vertex[t.tail[h]]] += t.length[h];
    ++edges[components.of_vertex[t.tail[h]]];
  }
  for (Index c = 0; c < components.count; ++c) sum[c] /= edges[c];
  return sum;
}

std::vector<bool> points_among(const Triangulation& t, const detail::Components& components) {
  std::vector<bool> points;
  for (const double mean : mean_edge_lengths(t, components)) points.push_back(!(mean > kNowhere));
  return points;
}

void mollify(Triangulation& t, const detail::Components& components, double share) {
  const std::vector<double> means = mean_edge_lengths(t, components);
  const double anywhere = std::max(share * mean_edge_length(t), kNowhere);
  std::vector<double> add(components.count, 0.0);
  const auto component = [&](std::size_t h) { return components.of_vertex[t.tail[h]]; };
  for (std::size_t f = 0; f < t.face_count(); ++f) {
    const Index c = component(3 * f);
    const double* l = &t.length[3 * f];
    const double longest = std::max({l[0], l[1], l[2]});
    const double rest = l[0] + l[1] + l[2] - longest;
    add[c] = std::max(add[c], longest - rest + (means[c] > kNowhere ? share * means[c] : anywhere));
  }
  for (std::size_t h = 0; h < t.length.size(); ++h) t.length[h] += add[component(h)];
}

Times times_of(const Triangulation& t, const detail::Components& components, double time_factor, double time) {
  const double mean = mean_edge_length(t), square = mean * mean;
  if (!(square > 0)) return {1, std::vector<double>(components.count, 1)};  // nothing to spread on
  if (time > 0 && !(time >= kLeastFactor * square && time <= kLargestFactor * square)) {
    throw Error(ErrorCode::InvalidArgument, "heat: time is " + number_as_text(time / square) +
                                                " times the squared mean edge: at least 1e-12 and at most 1e6 times it "
                                                "is possible");
  }
  Times times{time > 0 ? time : time_factor * square, {}};
  for (const double own : mean_edge_lengths(t, components)) {
    times.of.push_back(std::clamp(times.all, kLeastFactor * own * own, kLargestFactor * own * own));
  }
  return times;
}

}  // namespace brushfire::heat
