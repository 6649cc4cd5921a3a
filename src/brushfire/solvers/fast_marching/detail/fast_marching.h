// The fast marching methods: novotni-klein, novotni-klein-2002 and kimmel-sethian.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <memory>
#include <span>

namespace brushfire::fast_marching {

// One engine for the three methods and both precisions: which one runs stands in the problem's options.
std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh);

// Costs in place of distances, by the weights of the faces ([face_count], > 0 and finite): each face is as large as its
// weight, so that fronts are refracted where they pass from one to the next. Obtuse corners are unfolded within one
// weight only. Sources are points.
std::unique_ptr<detail::Engine> make_weighted_engine(const Mesh& mesh, std::span<const double> weights);

// With parts of a size of one's own, a power of two (see VertexPartition): results depend on it, to the bit, though not
// on how many threads work on them. kNoIndex: the whole mesh.
std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh, Index part_size);
Index usual_part_size(const Mesh& mesh);

}  // namespace brushfire::fast_marching
