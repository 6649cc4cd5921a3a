// Heat carried from vertices: in one go, or sent on where it has to go farther than doubles reach.
#include <brushfire/solvers/heat/carrier.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace brushfire::heat {

Carrier::Carrier(VectorSystem& system, std::span<const Index> from) : system_(system) {
  const Pattern& pattern = system.operators().pattern;
  const HeatEquation<double>& equation = system.scalar_heat();
  const detail::Components& components = system.components();
  std::vector<std::uint8_t> is_heated(components.count, 0), heated(components.of_vertex.size(), 0);
  std::vector<double> last(heated.size(), 0.0);
  for (const Index v : from) {
    last[v] += 1;
    is_heated[components.of_vertex[v]] = 1;
  }
  for (std::size_t v = 0; v < heated.size(); ++v) {
    heated[v] = components.of_vertex[v] != kNoIndex && is_heated[components.of_vertex[v]];
  }
  equation.factors.solve(0, 1, last);
  heat_ = relayed(last, std::move(heated), [&](std::uint32_t, const std::vector<std::uint8_t>& beyond) {
    last = sent_over<double>(pattern, equation.matrix, beyond, last);
    equation.factors.solve(0, 1, last);
    return last;
  });
}

void Carrier::carry(std::size_t width, std::span<double> x) const { spread(system_.scalar_heat(), width, x); }

void Carrier::carry(std::span<Complex> x) const { spread(system_.vector_heat(), 1, x); }

template <class Scalar>
void Carrier::spread(const HeatEquation<Scalar>& equation, std::size_t width, std::span<Scalar> x) const {
  const std::vector<std::uint32_t>& levels = heat_.level;
  const std::uint32_t most = levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
  if (most == 0) return equation.factors.solve(0, width, x);
  const std::vector<Scalar> b(x.begin(), x.end());
  std::vector<Scalar> last(x.size(), Scalar{});
  std::vector<std::uint8_t> beyond(levels.size());
  for (std::uint32_t level = 0; level <= most; ++level) {
    if (level > 0) {
      for (std::size_t v = 0; v < beyond.size(); ++v) beyond[v] = levels[v] >= level;
      last = sent_over<Scalar>(system_.operators().pattern, equation.matrix, beyond, last, width);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {  // what begins farther out is too little to be seen
      if (levels[i / width] == level) last[i] += b[i];
      if (levels[i / width] == level + 1) last[i] += Heat::kStep * b[i];
    }
    equation.factors.solve(0, width, last);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (levels[i / width] == level) x[i] = last[i];
    }
  }
}

}  // namespace brushfire::heat
