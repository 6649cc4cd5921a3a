// A picture that can be checked by eye: the unit square, coloured by x.
#pragma once

#include <brushfire/figure/render.h>
#include <brushfire/mesh/shapes.h>

#include <span>

namespace brushfire::test {

// The unit square seen from the front: the screen shows x to the right and y up.
inline Panel square(Index cells = 8) {
  Panel panel;
  panel.mesh = shapes::plane(cells, cells).mesh();
  for (const Vec3& p : panel.mesh.positions()) panel.scalar.push_back(p.x);
  return panel;
}

inline RenderOptions front(int size) {
  RenderOptions options;
  options.width = options.height = size;
  options.camera = named_view("front");
  options.colour_bar = false;
  options.silhouettes = false;
  return options;
}

inline Image render_one(const Panel& panel, const RenderOptions& options) {
  return render(std::span(&panel, 1), options);
}

inline double brightness(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return (p[0] + p[1] + p[2]) / 3.0;
}

}  // namespace brushfire::test
