// The fast marching methods: novotni-klein, novotni-klein-2002 and kimmel-sethian.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <memory>

namespace brushfire::fast_marching {

// One engine for the three methods and both precisions: which one runs stands in the problem's options.
std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh);

// With parts of a size of one's own, a power of two (see VertexPartition): results depend on it, to the bit, though not
// on how many threads work on them. kNoIndex: the whole mesh.
std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh, Index part_size);
Index usual_part_size(const Mesh& mesh);

}  // namespace brushfire::fast_marching
