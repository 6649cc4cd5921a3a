// From numbers to colours: perceptually uniform maps for values, distinct colours for labels.
#pragma once

#include <brushfire/core/types.h>

#include <string_view>

namespace brushfire {

struct Color {
  float r = 0, g = 0, b = 0;  // in [0, 1]
  friend constexpr bool operator==(const Color&, const Color&) = default;
};

constexpr Color mix(Color a, Color b, float share) {
  return {a.r + share * (b.r - a.r), a.g + share * (b.g - a.g), a.b + share * (b.b - a.b)};
}
constexpr Color scaled(Color c, float s) { return {s * c.r, s * c.g, s * c.b}; }

// All of them rise in lightness from end to end, so that they survive colour blindness and a black-and-white printer.
enum class Colormap : std::uint8_t { Viridis, Magma, Cividis };

// "viridis", "magma", "cividis". Throws Error(InvalidArgument) that lists them.
Colormap colormap_named(std::string_view name);

// The colour at `share` of the map, clamped to [0, 1].
Color color_of(Colormap map, double share);

// A colour for label `index`: eight that the colour-blind can tell apart (Okabe & Ito 2008), then more by hue.
Color label_color(Index index);

}  // namespace brushfire
