// What lies on the surface: tubes along paths, dots at sources.
#pragma once

#include <brushfire/figure/detail/raster.h>
#include <brushfire/figure/render.h>

#include <span>
#include <vector>

namespace brushfire::detail {

// A capsule on the screen, in samples: a piece of a tube, or (where both ends agree) a ball.
struct Capsule {
  float x0, y0, depth0, x1, y1, depth1;
  float radius;               // samples
  float lift;                 // how much nearer than its axis its front is, in depth
  float rim = 0;              // share of the radius that is drawn in the rim colour
  float begin = 0, dash = 0;  // samples along its line up to its first end, and of a dash; 0: not seen where hidden
  Color color, rim_color;
};

inline constexpr double kDashes = 1.4;  // how long the dashes of hidden paths, and the gaps, are: path widths

// The panel's paths and dots as capsules.
std::vector<Capsule> overlay_capsules(const Panel& panel, const RenderOptions& options, const Projection& projection);

// Draws them into the strip and its colours [rows * columns]: what the surface hides first, as dashes on it.
void draw(std::span<const Capsule> capsules, Strip& strip, std::span<Color> colors);

}  // namespace brushfire::detail
