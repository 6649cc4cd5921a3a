// Window propagation as an engine of distance(): exact at tolerance 0.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <memory>

namespace brushfire::detail {

// The mesh is worked on in parts of 2^part_bits faces, on which threads work side by side. Small enough for a few dozen
// to be under way at a time, large enough for little to cross from one to the next.
inline constexpr unsigned kPartBits = 15;

// Throws Error(TooLarge) for meshes of 2^31 vertices.
std::unique_ptr<Engine> make_windows(const Mesh& mesh, unsigned part_bits = kPartBits);

}  // namespace brushfire::detail
