// Random points of a mesh, of every kind.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/surface_point.h>

#include <random>

namespace brushfire::test {

// In (0, 1); the same on every platform.
inline double uniform(std::mt19937& random) { return (static_cast<double>(random() % 1000000) + 0.5) / 1000000; }

// A vertex, a point of an edge or a point inside a face.
inline SurfacePoint any_point(const Mesh& mesh, std::mt19937& random) {
  Index f = kNoIndex;
  do {
    f = static_cast<Index>(random() % mesh.face_count());
  } while (!mesh.is_face_usable(f));
  const double a = uniform(random), b = (1 - a) * uniform(random);
  switch (random() % 3) {
    case 0:
      return {f, {1, 0, 0}};
    case 1:
      return {f, {a, 1 - a, 0}};
    default:
      return {f, {a, b, 1 - a - b}};
  }
}

}  // namespace brushfire::test
