// The function whose gradient is nearest to a field of vectors, among those that are constant on given sets of points.
#pragma once

#include <brushfire/mesh/detail/components.h>
#include <brushfire/mesh/surface_point.h>
#include <brushfire/solvers/heat/operators.h>
#include <brushfire/solvers/signed_heat.h>

#include <optional>
#include <vector>

namespace brushfire::heat {

class LevelSets {
 public:
  LevelSets(const Operators& operators, const detail::Components& components);

  // L f = b, in units of the mesh, moved so that its mean on the points of each component is 0; +inf in components
  // without a point. A single group's points, or all, read the same where that is asked for.
  std::vector<double> integrate(const Mesh& mesh, std::vector<double> b,
                                const std::vector<std::vector<PointLocation>>& groups,
                                const SignedHeatOptions& options) const;

 private:
  detail::Components components_;
  std::optional<Factors<double>> poisson_;  // a vertex of each component held
};

}  // namespace brushfire::heat
