// A run that is carried over from change to change.
#include <brushfire/solvers/weighted/replanner.h>

#include <brushfire/core/cancel.h>
#include <brushfire/solvers/steiner/detail/carry.h>
#include <brushfire/solvers/weighted/detail/fields.h>

#include <utility>

namespace brushfire {

using namespace steiner;
using namespace weighted;

struct Replanner::State {
  Domain domain{Mesh()};
  ReplannerOptions options;
  Weights weights;
  std::vector<Source> sources;
  std::shared_ptr<const WeightedMesh> mesh;
  std::shared_ptr<const PointLayout> layout;
  std::shared_ptr<Run> run;  // null before the first search and after one that was cancelled
  WeightedField field;
  double renewed = 1;

  std::shared_ptr<Run> located(std::shared_ptr<const WeightedMesh> on, std::shared_ptr<const PointLayout> points,
                               std::span<const Source> from) const;
  void go_on(const std::shared_ptr<Run>& next);
};

std::shared_ptr<Run> Replanner::State::located(std::shared_ptr<const WeightedMesh> on,
                                               std::shared_ptr<const PointLayout> points,
                                               std::span<const Source> from) const {
  auto next = std::make_shared<Run>();
  next->mesh = std::move(on);
  next->layout = std::move(points);
  next->towards = options.towards;
  locate(from, {}, *next);
  return next;
}

void Replanner::State::go_on(const std::shared_ptr<Run>& next) {
  mesh = next->mesh;
  layout = next->layout;
  const std::shared_ptr<Run> last = std::exchange(run, nullptr);
  field.run.reset();
  Carried carried;
  if (last) {
    // Whoever keeps the field of before keeps its front.
    Run before = last.use_count() > 1 ? *last : std::move(*last);
    carried = carry(before, *next);
  } else {
    carried.front = unreached(*mesh, *layout);
  }
  renewed = 1 - carried.kept;
  Search search(*mesh, *layout, Costs::Real, options.towards);
  SearchLimits limits;
  limits.progress = options.progress;
  search.resume(std::move(carried.front), next->sources, carried.rows, limits);
  next->front = search.take();
  field = {};
  fill_upper(*next, kInfinity, field);
  field.points = layout->size();
  field.run = next;
  run = next;
}

Replanner::Replanner(Domain domain, Weights weights, std::vector<Source> sources, ReplannerOptions options)
    : state_(std::make_unique<State>()) {
  check_tolerance(options.tolerance);
  state_->domain = std::move(domain);
  state_->options = std::move(options);
  state_->sources = std::move(sources);
  change(std::move(weights));
}
Replanner::~Replanner() = default;
Replanner::Replanner(Replanner&&) noexcept = default;
Replanner& Replanner::operator=(Replanner&&) noexcept = default;

const Domain& Replanner::domain() const noexcept { return state_->domain; }
const Weights& Replanner::weights() const noexcept { return state_->weights; }
const WeightedField& Replanner::field() const noexcept { return state_->field; }
double Replanner::renewed() const noexcept { return state_->renewed; }

void Replanner::change(Weights weights) {
  const CancelScope listen(state_->options.cancel);
  std::shared_ptr<const WeightedMesh> mesh;
  std::shared_ptr<const PointLayout> layout = state_->layout;
  if (state_->mesh) mesh = state_->mesh->reweighted(weights);
  if (!mesh) {
    mesh = std::make_shared<WeightedMesh>(state_->domain, weights, Walls::Left);
    layout = std::make_shared<PointLayout>(*mesh, density_for(Costs::Real, state_->options.tolerance, 0));
  }
  const std::shared_ptr<Run> next = state_->located(std::move(mesh), std::move(layout), state_->sources);
  state_->weights = std::move(weights);
  state_->go_on(next);
}

void Replanner::move(std::vector<Source> sources) {
  const CancelScope listen(state_->options.cancel);
  const std::shared_ptr<Run> next = state_->located(state_->mesh, state_->layout, sources);
  state_->sources = std::move(sources);
  state_->go_on(next);
}

}  // namespace brushfire
