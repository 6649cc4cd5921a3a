// The heat of one set of sparks, however far it has to go; and the directions away from it.
#include <brushfire/solvers/heat/system.h>

#include <algorithm>
#include <cmath>

namespace brushfire::heat {

std::vector<std::uint8_t> System::lit_by(const Sparks& sparks) const {
  std::vector<bool> component(component_count_, false);
  for (const Spark& s : sparks) component[component_[s.vertex]] = true;
  std::vector<std::uint8_t> heated(vertex_count());
  for (Index v = 0; v < vertex_count(); ++v) {
    heated[v] = component_[v] != kNoIndex && component[component_[v]] && takes_heat(v);
  }
  return heated;
}

Heat System::diffuse(const Sparks& sparks) const {
  std::vector<std::vector<double>> last;  // of each matrix
  for (std::size_t m = 0; m < heat_.size(); ++m) last.push_back(heat_by(m, 1, {&sparks, 1}));
  const auto mean = [&] {
    std::vector<double> u = last[0];
    for (std::size_t v = 0; v < u.size() && last.size() > 1; ++v) u[v] = 0.5 * (u[v] + last[1][v]);
    return u;
  };
  return relayed(mean(), lit_by(sparks), [&](std::uint32_t level, const std::vector<std::uint8_t>& beyond) {
    for (std::size_t m = 0; m < heat_.size(); ++m) {
      std::vector<double> next = sent_over<double>(operators_.pattern, heat_[m], beyond, last[m]);
      for (const Spark& s : sparks) {  // those that are so late that they count only here
        if (beyond[s.vertex]) next[s.vertex] += s.weight * std::exp(-s.delay - level * std::log(Heat::kStep));
      }
      factors_->solve(m + 1, 1, next);
      last[m] = std::move(next);
    }
    return mean();
  });
}

void System::add_divergence(const Heat& heat, std::size_t width, std::size_t column, std::span<double> b) const {
  for (const FlatFace& f : faces_) {
    const std::uint32_t base = std::min({heat.level[f.vertex[0]], heat.level[f.vertex[1]], heat.level[f.vertex[2]]});
    std::array<double, 3> u;
    for (int k = 0; k < 3; ++k) u[k] = heat.value[f.vertex[k]] * heat.unit(f.vertex[k], base);
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
