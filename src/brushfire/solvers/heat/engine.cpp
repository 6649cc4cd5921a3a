// From a problem of distance() to right-hand sides of the heat method, and back.
#include <brushfire/solvers/heat/engine.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/start.h>
#include <brushfire/solvers/heat/fronts.h>
#include <brushfire/solvers/heat/system.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace brushfire::heat {
namespace {

class Engine final : public detail::Engine {
 public:
  explicit Engine(Mesh mesh) : mesh_(std::move(mesh)) {}

  void set_up(const DistanceOptions& options) override {
    if (!system_ || system_->options() != options.heat) system_.emplace(mesh_, options.heat);
  }

  void solve(const detail::Problem& problem, DistanceField& field) override {
    set_up(*problem.options);
    const std::vector<Origin> origins = origins_of(mesh_, *system_, problem.sources);
    const Sparks sparks = sparks_of(*system_, origins);
    const std::vector<double> potential = system_->potentials({&sparks, 1});
    read_off(mesh_, *system_, origins, potential, 1, field.distance, field.source);
    field.updates = mesh_.vertex_count();
    for (std::size_t i = 0; i < problem.targets.size(); ++i) evaluate(problem, i, field);
  }

 private:
  // Linear in every face; straight to the sources in the target's own.
  void evaluate(const detail::Problem& problem, std::size_t i, DistanceField& field) const {
    const PointLocation& at = problem.targets[i];
    double value = 0;
    Index label = kNoIndex;
    double heaviest = 0;
    for (int k = 0; k < 3; ++k) {
      if (!(at.weights[k] > 0)) continue;
      const Index v = mesh_.faces()[at.face][k];
      value += at.weights[k] * field.distance[v];
      if (at.weights[k] > heaviest) {
        heaviest = at.weights[k];
        label = field.source[v];
      }
    }
    for (const detail::LocatedSource& s : problem.sources) {
      const double straight = s.offset + detail::straight_distance(mesh_, s.at, at);
      if (s.at.face != at.face || std::pair(straight, s.label) >= std::pair(value, label)) continue;
      value = straight;
      label = s.label;
    }
    field.target_distance[i] = value;
    field.target_source[i] = value < kInfinity ? label : kNoIndex;
  }

  Mesh mesh_;
  std::optional<System> system_;
};

}  // namespace

std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh) {
  require_factorization();
  return std::make_unique<Engine>(mesh);
}

}  // namespace brushfire::heat
