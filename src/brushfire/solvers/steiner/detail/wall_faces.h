// Whether walls can be left in a mesh as faces that nothing enters.
#pragma once

#include <brushfire/solvers/steiner/weights.h>

namespace brushfire::steiner {

// Whether there is a vertex whose faces of one fan are parted by faces of weight +inf, with fences as slits: cut out,
// such walls leave it in several pieces, and one that is left whole would let paths through. O(faces + those at walls).
bool walls_part_a_vertex(const Mesh& mesh, const Weights& weights);

}  // namespace brushfire::steiner
