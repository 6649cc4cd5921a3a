// How much of the sky each place of a surface sees: what makes crevices dark in a picture.
#pragma once

#include <brushfire/core/progress.h>
#include <brushfire/mesh/mesh.h>

#include <array>
#include <vector>

namespace brushfire {

struct AmbientOcclusionOptions {
  int directions = 256;      // over the whole sphere, 8 to 65536; the openness is known to a few in `directions`
  double reach = kInfinity;  // > 0, in the mesh's unit of length: what is farther away casts no shade
  unsigned threads = 0;      // 0: one per processor; the result is the same for any number
  Progress progress;
  const CancelToken* cancel = nullptr;
};

// Whether this library was built with Embree, which ambient_occlusion() needs.
bool has_ambient_occlusion() noexcept;

// The cosine-weighted share of the sky that is seen from each corner of each face, [halfedge_count]{on the front of the
// face, on its back}, in [0, 1]: 1 on a plane, 0 inside a closed surface. The front is where the corners run
// counter-clockwise. Directions are the same for all corners (a Fibonacci lattice), so that equal surroundings give
// equal values; rays go out from beside the vertices, weights follow the normals that the picture is shaded with.
//
// O(vertices * directions * log faces): about a second for 35k vertices. Throws Error(InvalidArgument) for options out
// of range, a mesh without positions, and where the library was built without Embree; Error(Cancelled).
std::vector<std::array<float, 2>> ambient_occlusion(const Mesh& mesh, const AmbientOcclusionOptions& options = {});

}  // namespace brushfire
