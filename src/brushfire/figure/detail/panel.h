// Draws one panel's surface and overlays into a picture.
#pragma once

#include <brushfire/figure/detail/surface.h>

#include <span>

namespace brushfire::detail {

struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

// Paints the panel over `at`. `depth`, where not empty, receives the nearest depth of every pixel of the rectangle
// ([height * width], -inf: nothing).
void paint_panel(const Panel& panel, const RenderOptions& options, ScalarRange range, Rectangle at, bool overlays,
                 Image& picture, std::span<float> depth = {});

// The projection that fits the panel into a rectangle of this size at the origin.
Projection projection_of(const Panel& panel, const RenderOptions& options);

}  // namespace brushfire::detail
