// From WeightedField to DistanceField.
#include <brushfire/solvers/detail/cost_runs.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <brushfire/core/error.h>

#include <utility>

namespace brushfire {
namespace weighted {
namespace {

void check(const Domain& domain, const DistanceOptions& options) {
  const Domain& own = options.weighting->domain();
  if (own.mesh().face_count() != domain.mesh().face_count() ||
      own.mesh().vertex_count() != domain.mesh().vertex_count() ||
      own.open().face_count() != domain.open().face_count() ||
      own.open().vertex_count() != domain.open().vertex_count()) {
    throw Error(ErrorCode::InvalidArgument,
                "the weights are those of another mesh, or of other walls: ask in Weighting::domain()");
  }
  if (options.keep_paths || options.keep_windows) {
    throw Error(ErrorCode::InvalidArgument,
                "costs have no windows to keep, which exact arcs, signs and paths of distances are read from; paths of "
                "costs are weighted_paths()");
  }
  if (options.bound == Bound::Lower && options.weighting->options().marching) {
    throw Error(ErrorCode::InvalidArgument, "lower bounds: marching has none");
  }
  if (options.bound == Bound::Lower && !options.weighting->weights().is_isotropic()) {
    throw Error(ErrorCode::InvalidArgument, "lower bounds: where slopes or a grain count there are upper ones only");
  }
}

DistanceField run_as_distance(WeightedSolver& solver, const Domain& domain, std::span<const Source> sources,
                              const DistanceOptions& options) {
  check(domain, options);
  WeightedOptions how;
  how.tolerance = options.weighting->options().tolerance;
  how.towards = options.weighting->options().towards;
  how.marching = options.weighting->options().marching;
  how.lower = options.bound == Bound::Lower;
  how.max_distance = options.max_distance;
  how.targets = options.targets;
  how.progress = options.progress;
  how.cancel = options.cancel;
  WeightedField found = solver.distance(sources, how);
  if (how.lower && found.lower.empty()) {
    throw Error(ErrorCode::InvalidArgument, "lower bounds: from curves there are upper ones only");
  }
  DistanceField field;
  field.method = options.method;
  field.source = std::move(found.source);
  field.target_source = std::move(found.target_source);
  field.max_error_bound = found.max_error_bound;
  field.reached = found.reached;
  field.unreachable = domain.mesh().vertex_count() - found.reached;  // the front keeps no count of what it saw
  field.updates = found.points;
  if (how.lower) {
    field.error_bound.reserve(found.lower.size());
    for (std::size_t v = 0; v < found.lower.size(); ++v) {
      field.error_bound.push_back(found.lower[v] < kInfinity ? found.distance[v] - found.lower[v] : kInfinity);
    }
    field.distance = std::move(found.lower);
    field.target_distance = std::move(found.target_lower);
    if (domain.has_walls()) field.side_distance = domain.spread(field.distance);
  } else {
    field.distance = std::move(found.distance);
    field.target_distance = std::move(found.target_distance);
    field.side_distance = std::move(found.side_distance);
  }
  return field;
}

class Runs : public detail::CostRuns {
 public:
  explicit Runs(WeightedSolver solver) : solver_(std::move(solver)) {}

  DistanceField operator()(const Domain& domain, std::span<const Source> sources,
                           const DistanceOptions& options) override {
    return run_as_distance(solver_, domain, sources, options);
  }

 private:
  WeightedSolver solver_;
};

}  // namespace
}  // namespace weighted

std::unique_ptr<detail::CostRuns> Weighting::runs() const { return std::make_unique<weighted::Runs>(solver()); }

}  // namespace brushfire
