// Heat in levels: where it becomes too little for a double, it is begun anew from there.
#include <brushfire/solvers/heat/relay.h>

#include <cmath>
#include <utility>

namespace brushfire::heat {
namespace {

constexpr std::uint32_t kMostLevels = 100'000;

}  // namespace

double Heat::unit(std::size_t v, std::uint32_t in_level) const {
  return level[v] == in_level ? 1 : std::pow(kStep, static_cast<double>(level[v]) - static_cast<double>(in_level));
}

bool starves(const std::vector<std::uint8_t>& heated, std::span<const double> value, std::size_t width) {
  for (std::size_t v = 0; v < heated.size(); ++v) {
    if (heated[v] && !(std::abs(value[width * v]) >= Heat::kStarving)) return true;
  }
  return false;
}

Heat relayed(std::vector<double> value, std::vector<std::uint8_t> heated, const SendOn& send_on) {
  Heat heat{std::move(value), std::vector<std::uint32_t>(heated.size(), 0)};
  std::vector<std::uint8_t>& beyond = heated;
  for (std::uint32_t level = 1; level <= kMostLevels && starves(beyond, heat.value); ++level) {
    for (std::size_t v = 0; v < beyond.size(); ++v) beyond[v] = beyond[v] && !(heat.value[v] >= Heat::kStep);
    const std::vector<double> next = send_on(level, beyond);
    bool is_heated = false;
    for (std::size_t v = 0; v < beyond.size(); ++v) {
      if (!beyond[v]) continue;
      heat.value[v] = next[v];
      heat.level[v] = level;
      is_heated = is_heated || next[v] > 0;
    }
    if (!is_heated) break;
  }
  return heat;
}

}  // namespace brushfire::heat
