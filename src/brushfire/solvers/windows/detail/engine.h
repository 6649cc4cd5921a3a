// Window propagation as an engine of distance(): exact at tolerance 0.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <cstdint>
#include <memory>

namespace brushfire::detail {

// The mesh is worked on in parts of 2^part_bits faces, on which threads work side by side. Small enough for a few dozen
// to be under way at a time, large enough for little to cross from one to the next.
inline constexpr unsigned kPartBits = 15;

// Whether a run with a tolerance merges windows only where that is quicker than an exact run (see least_budget.h), or
// always: then the proof of the tolerance can be put to the test on small meshes, too.
enum class Merging : std::uint8_t { WherePays, Always };

// Throws Error(TooLarge) for meshes of 2^31 vertices.
std::unique_ptr<Engine> make_windows(const Mesh& mesh, unsigned part_bits = kPartBits,
                                     Merging merging = Merging::WherePays);

// With these numbers, whatever the mesh; see real.h.
inline namespace in_doubles {
std::unique_ptr<Engine> make_engine(const Mesh& mesh, unsigned part_bits, Merging merging);
}
namespace in_double_doubles {
std::unique_ptr<Engine> make_engine(const Mesh& mesh, unsigned part_bits, Merging merging);
}

}  // namespace brushfire::detail
