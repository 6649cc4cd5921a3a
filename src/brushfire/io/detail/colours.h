// Colours for scalars: dark blue to yellow, in steps that look equal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace brushfire::detail {

using Colour = std::array<std::uint8_t, 3>;

// The map "viridis" of S. van der Walt and N. Smith (public domain), at nine even steps.
inline Colour viridis(double t) {
  static constexpr std::array<Colour, 9> kSteps{{{68, 1, 84},
                                                 {71, 44, 122},
                                                 {59, 81, 139},
                                                 {44, 113, 142},
                                                 {33, 144, 141},
                                                 {39, 173, 129},
                                                 {92, 200, 99},
                                                 {170, 220, 50},
                                                 {253, 231, 37}}};
  const double x = std::clamp(t, 0.0, 1.0) * (kSteps.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(x), kSteps.size() - 2);
  Colour c;
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = static_cast<std::uint8_t>(
        std::lround(kSteps[k][i] + (x - static_cast<double>(k)) * (kSteps[k + 1][i] - kSteps[k][i])));
  }
  return c;
}

// Maps the finite values of a field onto the colours; everything else is grey.
class ColourScale {
 public:
  explicit ColourScale(std::span<const double> values) {
    for (const double v : values) {
      if (!std::isfinite(v)) continue;
      low_ = std::min(low_, v);
      high_ = std::max(high_, v);
    }
  }
  Colour operator()(double v) const {
    if (!std::isfinite(v)) return {128, 128, 128};
    // Halved, so that the span of huge values of both signs does not overflow.
    const double span = 0.5 * high_ - 0.5 * low_;
    return viridis(span > 0 ? (0.5 * v - 0.5 * low_) / span : 0);
  }

 private:
  double low_ = HUGE_VAL, high_ = -HUGE_VAL;
};

}  // namespace brushfire::detail
