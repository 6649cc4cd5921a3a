// Small surfaces of every kind.
#pragma once

#include <brushfire/mesh/shapes.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/random_points.h"

namespace brushfire::test {

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

// Curved, flat, with corners, edges of several faces, a vertex of two circles, needles, and the wrong way round.
inline std::vector<NamedMesh> small_surfaces() {
  std::vector<NamedMesh> all{{"saddle", shapes::saddle(8).mesh()},
                             {"terrain", shapes::noise_terrain(12, 9, 0.4).mesh()},
                             {"cube", shapes::cube(3).mesh()},
                             {"icosphere", shapes::icosphere(2).mesh()},
                             {"sphere with needles", shapes::latlong_sphere(12, 7).mesh()},
                             {"torus", shapes::torus(9, 7).mesh()},
                             {"folds", shapes::folded_sphere(2).mesh()},
                             {"book", shapes::book(4, 3, 3).mesh()},
                             {"bow tie", shapes::bow_tie(2, 6).mesh()},
                             {"plane", shapes::plane(7, 5).mesh()}};
  Shape turned = shapes::noise_terrain(8, 8, 0.5, 7);
  for (std::size_t f = 0; f < turned.faces.size(); f += 3) std::swap(turned.faces[f][1], turned.faces[f][2]);
  all.push_back({"terrain with faces the wrong way round", turned.mesh()});
  std::mt19937 random(5);
  Shape rough = shapes::icosphere(2);
  for (Vec3& p : rough.positions) p = (0.6 + 0.8 * uniform(random)) * p;
  all.push_back({"spikes", rough.mesh()});
  return all;
}

}  // namespace brushfire::test
