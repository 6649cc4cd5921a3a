// Window propagation as an engine of distance(): exact at tolerance 0.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/detail/engine.h>

#include <cstdint>
#include <memory>

namespace brushfire::windows {

// The mesh is worked on in parts of 2^part_bits faces, on which threads work side by side. Small enough for a few dozen
// to be under way at a time, large enough for little to cross from one to the next.
inline constexpr unsigned kPartBits = 15;

// Whether a run with a tolerance merges windows only where that is quicker than an exact run (see least_budget.h), or
// always: then the proof of the tolerance can be put to the test on small meshes, too.
enum class Merging : std::uint8_t { WherePays, Always };

// Throws Error(TooLarge) for meshes of 2^31 vertices. Works in doubles, and in wider numbers where doubles are not
// enough for the mesh and the options.
std::unique_ptr<detail::Engine> make_windows(const Mesh& mesh, unsigned part_bits = kPartBits,
                                             Merging merging = Merging::WherePays);

// With numbers of one kind.
class NumberedEngine : public detail::Engine {
 public:
  // What rounding may do to the distance between neighbours on this mesh, as a share of it.
  virtual double doubt() const = 0;
  // And as a length, in mesh.unit().
  virtual double absolute_rounding() const = 0;
  // Whether some edge has three faces or more.
  virtual bool has_spines() const = 0;
};
inline namespace in_doubles {
std::unique_ptr<NumberedEngine> make_engine(const Mesh& mesh, unsigned part_bits, Merging merging);
}
namespace in_double_doubles {
std::unique_ptr<NumberedEngine> make_engine(const Mesh& mesh, unsigned part_bits, Merging merging);
}

}  // namespace brushfire::windows
