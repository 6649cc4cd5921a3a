// Generators: meshes of well-known surfaces, for tests, benchmarks and demonstrations.
//
// All are deterministic to the bit on every platform (their sines and cosines are computed here, from + and * alone).
// Faces run counter-clockwise seen from outside (from above for those over the xy plane). Sizes of zero are errors:
// Error(InvalidArgument); more vertices than 32-bit numbers hold: Error(TooLarge).
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/mesh.h>

#include <cstdint>
#include <vector>

namespace brushfire {

struct Shape {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  Mesh mesh() const { return Mesh(positions, faces); }
};

namespace shapes {

// [0, width] x [0, height] in columns x rows rectangles, each split by the diagonal from its lower left corner. Vertex
// number: y * (columns + 1) + x.
Shape plane(Index columns, Index rows, double width = 1, double height = 1);

// z = height * (x^2 - y^2) over [-1, 1]^2, cells x cells.
Shape saddle(Index cells, double height = 1);

// Fractal value noise (six octaves, each half as high as the one before) over [0, 1]^2, columns x rows cells; heights
// in [0, 2 * height).
Shape noise_terrain(Index columns, Index rows, double height = 0.2, std::uint64_t seed = 1);

// The surface of [0, 1]^3, cells x cells squares a side, vertices shared along the edges.
Shape cube(Index cells);

// An icosahedron split `levels` times, pushed onto the sphere: 10 * 4^levels + 2 vertices.
Shape icosphere(Index levels, double radius = 1);

// Parallels and meridians; vertex 0 is the north pole (+z), the last one the south pole, between them stacks - 1 rings
// of `slices` vertices. stacks >= 2, slices >= 3.
Shape latlong_sphere(Index stacks, Index slices, double radius = 1);

// The side of a cone, no base: vertex 0 is the apex at (0, 0, height), then `rings` rings of `segments` vertices at
// equal steps down to z = 0. segments >= 3.
Shape cone(Index rings, Index segments, double radius = 1, double height = 1);

// The side of a cylinder around z, no caps: rings + 1 rings of `segments` vertices from z = 0 to `height`. segments
// >= 3.
Shape cylinder(Index rings, Index segments, double radius = 1, double height = 1);

// Around z; vertex number: i * minor_segments + j. Both >= 3.
Shape torus(Index major_segments, Index minor_segments, double major_radius = 1, double minor_radius = 0.4);

// A sphere with deep smooth folds like those of a cortex: the radius swings by +-depth along the level lines of smooth
// noise, `folds` times over the noise's range. Star-shaped, so it never meets itself. 0 <= depth < 1.
Shape folded_sphere(Index levels, double folds = 6, double depth = 0.2, std::uint64_t seed = 1);

// `pages` rectangles of columns x rows cells on one common spine: edges of `pages` faces. Vertices 0 .. rows are the
// spine, from (0,0,0) to (0,0,1); every page is 1 wide.
Shape book(Index pages, Index columns, Index rows);

// `fans` discs of `segments` faces that have only their centre, vertex 0, in common: a vertex of several circles.
Shape bow_tie(Index fans, Index segments);

}  // namespace shapes
}  // namespace brushfire
