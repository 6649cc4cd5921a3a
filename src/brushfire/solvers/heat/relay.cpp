// Heat that has to go farther than doubles reach: it falls by a factor of e with every sqrt(t), that is about one edge,
// and is 0 some seven hundred edges away. Where it has become small it is taken as what it is there, made larger, and
// sent on: with a matrix whose off-diagonal entries are <= 0 all sums are of positive numbers, so that its digits are
// right however small it is.
#include <brushfire/solvers/heat/system.h>

#include <algorithm>
#include <cmath>

namespace brushfire::heat {
namespace {

constexpr double kStarving = 1e-290;  // the products of what is larger with matrix entries are far from denormal
constexpr std::uint32_t kMostLevels = 100'000;

}  // namespace

bool System::starves(const Sparks& sparks, std::size_t width, std::size_t column, std::span<const double> u) const {
  std::vector<bool> lit(component_count_, false);
  for (const Spark& s : sparks) lit[component_[s.vertex]] = true;
  for (Index v = 0; v < vertex_count(); ++v) {
    if (component_[v] == kNoIndex || !lit[component_[v]] || !takes_heat(v)) continue;
    if (!(std::abs(u[width * v + column]) >= kStarving)) return true;
  }
  return false;
}

// What comes to the vertices `beyond`, in the units of level + 1, from what all have in those of `level`.
std::vector<double> System::relay(std::size_t matrix, const Sparks& sparks, std::uint32_t level,
                                  const std::vector<std::uint8_t>& beyond, const std::vector<double>& last) const {
  const Pattern& p = operators_.pattern;
  std::vector<double> next(vertex_count(), 0.0);
  for (int column = 0; column < p.columns(); ++column) {
    for (int e = p.start[column] + 1; e < p.start[column + 1]; ++e) {
      const int a = column, b = p.row[e];
      if (beyond[a] == beyond[b]) continue;
      const int in = beyond[a] ? a : b, out = beyond[a] ? b : a;
      next[in] -= heat_[matrix][e] * (last[out] / Heat::kStep);
      next[out] += heat_[matrix][e] * (last[in] / Heat::kStep);
    }
  }
  for (const Spark& s : sparks) {
    if (beyond[s.vertex]) next[s.vertex] += s.weight * std::exp(-s.delay - (level + 1) * std::log(Heat::kStep));
  }
  factors_->solve(matrix + 1, 1, next);
  return next;
}

Heat System::diffuse(const Sparks& sparks) const {
  Heat heat{heat_of(1, {&sparks, 1}), std::vector<std::uint32_t>(vertex_count(), 0)};
  if (!starves(sparks, 1, 0, heat.value)) return heat;

  std::vector<bool> lit(component_count_, false);
  for (const Spark& s : sparks) lit[component_[s.vertex]] = true;
  std::vector<std::uint8_t> beyond(vertex_count());
  for (Index v = 0; v < vertex_count(); ++v) beyond[v] = component_[v] != kNoIndex && lit[component_[v]];
  std::vector<std::vector<double>> last;
  for (std::size_t m = 0; m < heat_.size(); ++m) last.push_back(heat_by(m, 1, {&sparks, 1}));
  for (std::uint32_t level = 0; level < kMostLevels; ++level) {
    bool is_starving = false, is_lit = false;
    for (Index v = 0; v < vertex_count(); ++v) {
      beyond[v] = beyond[v] && !(heat.value[v] >= Heat::kStep) && takes_heat(v);
      is_starving = is_starving || (beyond[v] && heat.value[v] < kStarving);
    }
    if (!is_starving) break;
    for (std::size_t m = 0; m < heat_.size(); ++m) last[m] = relay(m, sparks, level, beyond, last[m]);
    for (Index v = 0; v < vertex_count(); ++v) {
      if (!beyond[v]) continue;
      heat.value[v] = heat_.size() == 1 ? last[0][v] : 0.5 * (last[0][v] + last[1][v]);
      heat.level[v] = level + 1;
      is_lit = is_lit || heat.value[v] > 0;
    }
    if (!is_lit) break;
  }
  return heat;
}

void System::add_divergence(const Heat& heat, std::size_t width, std::size_t column, std::span<double> b) const {
  for (const FlatFace& f : faces_) {
    const std::uint32_t base = std::min({heat.level[f.vertex[0]], heat.level[f.vertex[1]], heat.level[f.vertex[2]]});
    std::array<double, 3> u;
    for (int k = 0; k < 3; ++k) {
      u[k] = heat.value[f.vertex[k]] * std::pow(Heat::kStep, heat.level[f.vertex[k]] - base);
    }
    const double largest = std::max({std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
    if (!(largest > 0)) continue;
    const double d1 = (u[1] - u[0]) / largest, d2 = (u[2] - u[0]) / largest;
    const double x = d1 * f.apex.y, y = d2 * f.length - d1 * f.apex.x;
    const double norm = std::hypot(x, y);
    if (!(norm > 0)) continue;
    const double down = -0.5 * per_sheet_ / norm;
    const double to_1 = down * (x * f.apex.y - y * f.apex.x), to_2 = down * y * f.length;
    b[width * f.vertex[0] + column] -= to_1 + to_2;
    b[width * f.vertex[1] + column] += to_1;
    b[width * f.vertex[2] + column] += to_2;
  }
}

}  // namespace brushfire::heat
