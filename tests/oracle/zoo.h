// The zoo: small meshes of every awkward kind, built by hand or at random, for whoever claims to take any mesh.
#pragma once

#include <brushfire/mesh/mesh.h>

#include <cstdint>
#include <string>
#include <vector>

namespace brushfire::oracle {

struct Specimen {
  std::string name;
  Mesh mesh;
};

// Non-manifold edges, bow-ties, flipped and duplicate faces, faces of no area, repeated indices, edges of length zero,
// several components, isolated vertices, slits, saddles of exactly 2 pi, flat tori.
std::vector<Specimen> awkward_meshes();

// `faces` random triangles over `vertices` random points of a lattice in space: almost everything is wrong with them.
Mesh random_soup(std::uint32_t seed, Index vertices, Index faces, int lattice = 5);

// The same with lengths only, all in [1, 1.9], so that every triangle closes: cone angles of any size.
Mesh random_intrinsic(std::uint32_t seed, Index vertices, Index faces);

// A grid over [0,1]^2 whose rows are `altitude` high in turn: needles and caps beside ordinary faces.
Mesh needle_grid(std::uint32_t seed, int cells, double altitude);

// columns x rows rectangles glued to a torus, from lengths alone. Vertex number: y * columns + x.
Mesh flat_torus(Index columns, Index rows, double width, double height);

// `count` triangles around vertex 0, closed or open, on a circle of radius 1 with the height swinging `waves` times.
Mesh fan(Index count, bool closed, double height = 0, int waves = 0);

// Two tips, vertices 0 and 1, at these heights over and under a rim of `count` vertices on a circle of radius 1.
Mesh bipyramid(Index count, double height, double depth);

// A band of `count` triangles, 1 high and `step` per vertex long, lower vertices even, upper vertices odd.
Mesh strip(Index count, double step);

}  // namespace brushfire::oracle
