// Surfaces with holes.
#pragma once

#include <brushfire/mesh/shapes.h>

#include <vector>

namespace brushfire::test {

// The shape's faces whose centre `keeps` wants, with all of its vertices.
template <class Keeps>
Mesh with_faces(const Shape& shape, Keeps&& keeps) {
  std::vector<Face> faces;
  for (const Face& t : shape.faces) {
    const Vec3 centre = (1.0 / 3) * (shape.positions[t[0]] + shape.positions[t[1]] + shape.positions[t[2]]);
    if (keeps(centre)) faces.push_back(t);
  }
  return Mesh(shape.positions, faces);
}

}  // namespace brushfire::test
