// The signed heat method: the distance from curves drawn on a surface, with a sign that says on which side; also from
// broken curves, whose gaps it closes. Smooth and without a bound, as the heat method is: docs/heat.md.
#pragma once

#include <brushfire/core/types.h>
#include <brushfire/mesh/domain.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/heat_options.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace brushfire {

// Consecutive points share a face; a closed curve repeats its first point at its end.
struct SignedCurve {
  std::vector<SurfacePoint> points;
  bool is_signed = true;  // false: distances grow on both sides
};

// What is required of values on the curves, besides that distances grow away from them at rate one.
enum class LevelSetConstraint : std::uint8_t {
  None,      // nothing: their mean is 0
  ZeroSet,   // all of them read 0
  Multiple,  // every curve reads one value, which may be another for each; their mean is 0
};

struct SignedHeatOptions {
  LevelSetConstraint constraint = LevelSetConstraint::ZeroSet;
  // > 0: the constraint is weighed against the rest in place of being kept.
  double soft_weight = 0;
  // In faces that curves run through, distances grow at right angles to the curves, whatever heat says there.
  bool preserve_normals = false;
};

// For one mesh, factored once. The surfaces and options are those of VectorHeatSolver. Not for use from several threads
// at once.
//
// Walls are borders of what is open: a curve along one runs along both of its sides, what of a curve lies behind one is
// left out, and a vertex on one reads the side whose value is nearest to 0.
//
// Based on: Feng, Crane, "A heat method for generalized signed distance", 2024; vectors here live at vertices.
class SignedHeatSolver {
 public:
  explicit SignedHeatSolver(const Domain& domain, const HeatOptions& options = {});
  ~SignedHeatSolver();
  SignedHeatSolver(SignedHeatSolver&&) noexcept;
  SignedHeatSolver& operator=(SignedHeatSolver&&) noexcept;

  // [vertex_count], in units of the mesh: positive on the right of signed curves, seen from where faces run counter-
  // clockwise, negative on their left, and so inside of one that runs counter-clockwise. Points are sources without a
  // direction. +inf in components with no source. With a constraint a linear system as large as there are points is
  // solved. Throws Error(InvalidArgument) for no source at all, consecutive points that share no face, a curve or point
  // that lies behind walls as a whole, and more than kMostConstraints points with a constraint; what locate() throws.
  std::vector<double> distance(std::span<const SignedCurve> curves, std::span<const SurfacePoint> points = {},
                               const SignedHeatOptions& options = {});
  static constexpr std::size_t kMostConstraints = 5000;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace brushfire
