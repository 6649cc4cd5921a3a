// Wild complexes: small, random, in numbers that nobody would model in. Each family is a kind on which something went
// wrong once.
#pragma once

#include "oracle/zoo.h"

#include <brushfire/mesh/surface_point.h>

#include <array>
#include <cstdint>
#include <random>

namespace brushfire::oracle {

enum class Wild {
  Grid,      // coordinates are small integers
  Scales,    // every vertex at its own scale, 1e-8 to 1e4
  Needles,   // edges of 1 and of 1e-9 in one face
  Clusters,  // vertices 1e-9 apart, clusters 1 apart
  Doubled,   // sheets of which every face is there two or three times, both ways round
  Book,      // pages over common edges, some of them mirror images of others
  PowerLaw,  // every coordinate at its own scale, 1e-6 to 1e6
  FarPoint,  // one vertex a million to 1e12 times farther away than the rest
  Soup,      // any three vertices are a face
};
inline constexpr std::array kWild{Wild::Grid, Wild::Scales,   Wild::Needles,  Wild::Clusters, Wild::Doubled,
                                  Wild::Book, Wild::PowerLaw, Wild::FarPoint, Wild::Soup};
const char* name_of(Wild family);

// Of 3 to 60 faces.
Mesh wild_complex(Wild family, std::mt19937& random);

// A vertex, a point of an edge or of a face, or one that is 1e-16 to 1e-3 away (as a share of a weight) from a vertex
// or an edge.
SurfacePoint wild_point(const Mesh& mesh, std::mt19937& random);

}  // namespace brushfire::oracle
