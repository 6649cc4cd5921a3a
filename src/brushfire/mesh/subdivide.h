// Splits every triangle into four: finer meshes of the same surface, for benchmarks and convergence studies.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/shapes.h>

#include <cstdint>

namespace brushfire {

enum class SubdivisionRule : std::uint8_t {
  Midpoint,  // new vertices in the middle of their edges: the same surface, exactly
  LoopOdd,   // Loop's rule for new vertices (3/8 of the ends, 1/8 of the opposite corners): rounds a coarse scan
};

struct SubdivisionOptions {
  SubdivisionRule rule = SubdivisionRule::LoopOdd;
  double noise = 0;        // new vertices move by up to this share of their edge's length in each coordinate
  std::uint64_t seed = 1;  // of the noise
};

// Old vertices keep their number and place; new ones follow, one per edge, in the order of the lowest halfedge; face f
// becomes faces 4f (the middle one) to 4f+3 (at corners 0, 1, 2). Edges with other than two faces get midpoints. Faces
// that name a vertex twice stay as they are, so numbers after such a face shift. The mesh must have positions
// (Error(InvalidArgument)); Error(TooLarge) where the result does not fit into 32-bit numbers. O(vertices + faces).
// Based on: Charles Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987.
Shape subdivided(const Mesh& mesh, const SubdivisionOptions& options = {});

}  // namespace brushfire
