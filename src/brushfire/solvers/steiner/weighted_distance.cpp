// From the caller's mesh to the search and back.
#include <brushfire/solvers/steiner/weighted_distance.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/refraction/detail/run.h>
#include <brushfire/solvers/steiner/detail/curve_points.h>
#include <brushfire/solvers/steiner/detail/run.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire {
namespace steiner {

Index source_behind(const Run& run, Index parent) {
  while (parent < kFromSource) {
    const Index edge = run.layout->edge_of(parent), i = parent - run.layout->row(edge);
    const Index h = run.mesh->edges().halfedge(edge);
    if (i == 0) {
      parent = run.front.vertex_parent[run.mesh->mesh().from(h)];
    } else if (i + 1 == run.layout->count(edge)) {
      parent = run.front.vertex_parent[run.mesh->mesh().to(h)];
    } else {
      parent = run.front.parent[parent];
    }
  }
  return parent == kNoIndex ? kNoIndex : parent - kFromSource;
}

}  // namespace steiner

namespace {

using namespace steiner;

// Sums of up to 2^20 costs, each off by a unit in the last place, stay below what they stand for.
constexpr double kBelowSums = 1 - 0x1p-32;

// Measured (docs/weights.md): so dense, upper bounds are off by about half of the tolerance on average and by all of it
// at most, and lower ones by the tolerance on average.
Density density_for(Costs costs, double tolerance, unsigned doublings) {
  const double finer = std::ldexp(1.0, -static_cast<int>(doublings)), root = std::sqrt(tolerance) * finer;
  const auto most = static_cast<Index>(std::min(4096.0, 64 / finer));
  if (costs == Costs::Real) return {3 * root, std::min(0.25, 8 * tolerance * finer), most};
  return {2.1 * root / (1 + root), std::min(0.25, 0.7 * tolerance * finer), 4 * most};
}

// Windows take no less time where they may be farther apart than this.
constexpr double kWidestWindows = 0.02;

void check_tolerance(double tolerance) {
  if (!(tolerance >= kLeastWeightedTolerance && tolerance <= kMostWeightedTolerance)) {
    throw Error(ErrorCode::InvalidArgument, "tolerance " + number_as_text(tolerance) + " is not in [" +
                                                number_as_text(kLeastWeightedTolerance) + ", " +
                                                number_as_text(kMostWeightedTolerance) + "]: weighted distances are " +
                                                "computed between bounds");
  }
}

void check(const WeightedOptions& options) {
  check_tolerance(options.tolerance);
  if (!(options.max_distance >= 0)) {
    throw Error(ErrorCode::InvalidArgument,
                "max_distance " + number_as_text(options.max_distance) + " is not a number >= 0");
  }
}

double least_offset(std::span<const Source> sources) {
  if (sources.empty()) throw Error(ErrorCode::InvalidArgument, "no source given: a distance needs at least one");
  double least = kInfinity;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!std::isfinite(sources[i].offset)) {
      throw Error(ErrorCode::InvalidArgument,
                  "offset " + number_as_text(sources[i].offset) + " of source " + std::to_string(i) + " is not finite");
    }
    least = std::min(least, brushfire::least_offset(sources[i]));
  }
  return least;
}

// A vertex of the caller's reads the least of its copies.
void bring_back(const WeightedMesh& mesh, std::vector<double>& values) {
  std::vector<double> least(mesh.domain().mesh().vertex_count(), kInfinity);
  for (Index v = 0; v < values.size(); ++v) least[mesh.vertex(v)] = std::min(least[mesh.vertex(v)], values[v]);
  values = std::move(least);
}

}  // namespace

struct WeightedSolver::Workspace {
  Domain domain{Mesh()};
  Weights weights;
  double uniform = 0;
  std::unique_ptr<DistanceSolver> plain;     // where the weight is uniform
  std::shared_ptr<const WeightedMesh> mesh;  // elsewhere
  struct LaidOut {
    Density density;
    std::shared_ptr<const PointLayout> points;
  };
  LaidOut for_real, for_below;  // the last ones: upper bounds need fewer points
  std::unique_ptr<refraction::Medium> medium;

  std::shared_ptr<const PointLayout> points_for(Costs costs, const WeightedOptions& options, unsigned doublings);
  WeightedField run_uniform(std::span<const Source> sources, const WeightedOptions& options);
  WeightedField run(std::span<const Source> sources, const WeightedOptions& options, unsigned doublings);
  void locate(std::span<const Source> sources, const WeightedOptions& options, Run& run) const;
  bool follow_windows(const Run& run, const WeightedOptions& options, WeightedField& field);
  void search(Run& run, const WeightedOptions& options, const PointLayout* below, WeightedField& field) const;
  void fill_upper(const Run& run, const WeightedOptions& options, WeightedField& field) const;
  template <class Value>
  void fill_sides(double base, double horizon, Value value, const WeightedOptions& options, WeightedField& field) const;
  void fill_lower(const Search& below, const Run& run, const WeightedOptions& options, WeightedField& field) const;
};

std::shared_ptr<const PointLayout> WeightedSolver::Workspace::points_for(Costs costs, const WeightedOptions& options,
                                                                         unsigned doublings) {
  const Density wanted = density_for(costs, options.tolerance, doublings);
  LaidOut& last = costs == Costs::Real ? for_real : for_below;
  if (!last.points || !(last.density == wanted)) {
    last.points.reset();
    last.points = std::make_shared<PointLayout>(*mesh, wanted);
    last.density = wanted;
  }
  return last.points;
}

void WeightedSolver::Workspace::locate(std::span<const Source> sources, const WeightedOptions& options,
                                       Run& run) const {
  run.base = least_offset(sources);
  run.given.assign(sources.begin(), sources.end());
  const double unit = mesh->mesh().unit();
  std::vector<std::uint8_t> is_open(sources.size(), 0);
  for (const PointSource& s : with_points_of_curves(*mesh, run.layout.get(), sources)) {
    for (const SurfacePoint& p : mesh->on_open(s.point)) {
      is_open[s.label] = 1;
      run.sources.push_back({brushfire::locate(mesh->mesh(), p), (s.offset - run.base) / unit, s.label, nullptr});
    }
  }
  if (const auto closed = std::find(is_open.begin(), is_open.end(), 0); closed != is_open.end()) {
    throw Error(ErrorCode::InvalidArgument, "source " + std::to_string(closed - is_open.begin()) +
                                                " lies behind a wall: nothing can be reached from there");
  }
  for (const SurfacePoint& t : options.targets) {
    std::vector<PointLocation>& sides = run.targets.emplace_back();
    for (const SurfacePoint& p : mesh->on_open(t)) sides.push_back(brushfire::locate(mesh->mesh(), p));
  }
}

// `below_points`: the points for lower bounds, where they are wanted.
void WeightedSolver::Workspace::search(Run& run, const WeightedOptions& options, const PointLayout* below_points,
                                       WeightedField& field) const {
  std::vector<PointLocation> places;
  for (const auto& sides : run.targets) places.insert(places.end(), sides.begin(), sides.end());
  const double unit = mesh->mesh().unit(), share = below_points ? 0.1 : 1;
  SearchLimits limits{(options.max_distance - run.base) / unit, places, {}};
  if (options.progress) limits.progress = [&](double done) { options.progress(share * done); };
  if (!options.targets.empty() && places.empty()) limits.max_value = -1;  // all targets are nowhere
  {
    Search real(*mesh, *run.layout, Costs::Real, options.towards);
    real.run(run.sources, limits);
    for (const auto& sides : run.targets) {
      std::vector<ValueAt>& values = run.target_values.emplace_back();
      for (const PointLocation& p : sides) values.push_back(real.at(p));
    }
    run.front = real.take();
  }
  fill_upper(run, options, field);
  if (!below_points) return;
  if (options.progress) limits.progress = [&](double done) { options.progress(share + (1 - share) * done); };
  Search below(*mesh, *below_points, Costs::Below);
  below.run(run.sources, limits);
  fill_lower(below, run, options, field);
}

void WeightedSolver::Workspace::fill_upper(const Run& run, const WeightedOptions& options, WeightedField& field) const {
  const double unit = mesh->mesh().unit(), horizon = run.front.horizon;
  const Index count = domain.mesh().vertex_count();
  const auto label = [&](Index parent) {
    const Index s = source_behind(run, parent);
    return s == kNoIndex ? kNoIndex : run.sources[s].label;
  };
  const auto value = [&](double v) { return v <= horizon ? run.base + v * unit : kInfinity; };
  field.distance.assign(count, kInfinity);
  field.source.assign(count, kNoIndex);
  for (Index v = 0; v < run.front.vertex_value.size(); ++v) {
    const double d = value(run.front.vertex_value[v]);
    double& least = field.distance[mesh->vertex(v)];
    if (!(d <= options.max_distance) || d == kInfinity || !(d < least)) continue;
    least = d;
    field.source[mesh->vertex(v)] = run.given.size() == 1 ? 0 : label(run.front.vertex_parent[v]);
  }
  fill_sides(run.base, horizon, [&](Index v) { return run.front.vertex_value[v]; }, options, field);
  field.reached = static_cast<Index>(
      std::count_if(field.distance.begin(), field.distance.end(), [](double d) { return d < kInfinity; }));
  for (const std::vector<ValueAt>& sides : run.target_values) {
    ValueAt best;
    for (const ValueAt& at : sides) best = at.value < best.value ? at : best;
    const double d = value(best.value);
    const bool is_reached = d < kInfinity && d <= options.max_distance;
    field.target_distance.push_back(is_reached ? d : kInfinity);
    field.target_source.push_back(is_reached ? label(best.parent) : kNoIndex);
  }
}

// value(v): what is known at the mesh's vertex v, final up to the horizon.
template <class Value>
void WeightedSolver::Workspace::fill_sides(double base, double horizon, Value value, const WeightedOptions& options,
                                           WeightedField& field) const {
  if (!domain.has_walls()) return;
  field.side_distance.assign(domain.open().vertex_count(), kInfinity);
  for (Index v = 0; v < mesh->mesh().vertex_count(); ++v) {
    const double at = value(v), d = at <= horizon ? base + at * mesh->mesh().unit() : kInfinity;
    double& least = field.side_distance[mesh->open_vertex(v)];
    if (d <= options.max_distance) least = std::min(least, d);
  }
}

void WeightedSolver::Workspace::fill_lower(const Search& below, const Run& run, const WeightedOptions& options,
                                           WeightedField& field) const {
  const double unit = mesh->mesh().unit(), horizon = below.front().horizon;
  // What is not final may still fall, but not below the horizon.
  const auto value = [&](double v) { return std::min(v, horizon) * kBelowSums * unit + run.base; };
  field.lower = below.front().vertex_value;
  bring_back(*mesh, field.lower);
  double sum = 0, most = 0;
  std::size_t count = 0;
  const auto compare = [&](double upper, double lower) {
    if (upper == kInfinity || upper == run.base) return;
    const double excess = (upper - lower) / (lower - run.base);
    sum += excess;
    most = std::max(most, excess);
    ++count;
  };
  for (std::size_t v = 0; v < field.lower.size(); ++v) {
    field.lower[v] = field.distance[v] < kInfinity ? std::min(value(field.lower[v]), field.distance[v]) : kInfinity;
    if (options.targets.empty()) compare(field.distance[v], field.lower[v]);
  }
  for (std::size_t t = 0; t < run.targets.size(); ++t) {
    double least = kInfinity;
    for (const PointLocation& p : run.targets[t]) least = std::min(least, below.at(p).value);
    const double upper = field.target_distance[t];
    field.target_lower.push_back(upper < kInfinity ? std::min(value(least), upper) : kInfinity);
    compare(upper, field.target_lower.back());
  }
  field.max_error_bound = most;
  field.mean_error_bound = count > 0 ? sum / static_cast<double>(count) : 0;
}

// Both bounds by windows. False, and the field is empty, where they cannot be followed.
bool WeightedSolver::Workspace::follow_windows(const Run& run, const WeightedOptions& options, WeightedField& field) {
  if (!medium) medium = std::make_unique<refraction::Medium>(*mesh);
  if (!medium->is_followable(options.tolerance)) return false;
  std::vector<PointLocation> places;
  for (const auto& sides : run.targets) places.insert(places.end(), sides.begin(), sides.end());
  const double unit = mesh->mesh().unit();
  double farthest = (options.max_distance - run.base) / unit;
  if (!options.targets.empty() && places.empty()) farthest = -1;  // all targets are nowhere
  refraction::Run windows(*medium, run.sources,
                          {std::min(options.tolerance, kWidestWindows), farthest, places, options.progress});
  if (!windows()) return false;
  const double horizon = std::min(farthest, windows.horizon());
  double sum = 0, most = 0;
  std::size_t count = 0;
  // The cheapest of several sides.
  const auto better = [](const refraction::Known& a, const refraction::Known& b) {
    refraction::Known best = b.upper < a.upper ? b : a;
    best.lower = std::min(a.lower, b.lower);
    return best;
  };
  const auto give = [&](const refraction::Known& known, bool counts, double& upper, double& lower, Index& source) {
    upper = lower = kInfinity;
    source = kNoIndex;
    if (known.upper == kInfinity || known.upper > horizon) return;
    upper = run.base + known.upper * unit;
    lower = std::min(upper, run.base + known.lower * unit);
    source = run.sources[known.source].label;
    if (!counts || upper == run.base) return;
    const double excess = (upper - lower) / (lower - run.base);
    sum += excess;
    most = std::max(most, excess);
    ++count;
  };
  std::vector<refraction::Known> known(domain.mesh().vertex_count());
  for (Index v = 0; v < mesh->mesh().vertex_count(); ++v) {
    known[mesh->vertex(v)] = better(known[mesh->vertex(v)], windows.at_vertex(v));
  }
  field.distance.resize(known.size());
  field.lower.resize(known.size());
  field.source.resize(known.size());
  for (std::size_t v = 0; v < known.size(); ++v) {
    give(known[v], options.targets.empty(), field.distance[v], field.lower[v], field.source[v]);
    field.reached += field.distance[v] < kInfinity;
  }
  fill_sides(run.base, horizon, [&](Index v) { return windows.at_vertex(v).upper; }, options, field);
  std::size_t place = 0;
  for (const auto& sides : run.targets) {
    refraction::Known there;
    for (std::size_t i = 0; i < sides.size(); ++i) there = better(there, windows.at_target(place++));
    give(there, true, field.target_distance.emplace_back(), field.target_lower.emplace_back(),
         field.target_source.emplace_back());
  }
  field.max_error_bound = most;
  field.mean_error_bound = count > 0 ? sum / static_cast<double>(count) : 0;
  return true;
}

WeightedField WeightedSolver::Workspace::run(std::span<const Source> sources, const WeightedOptions& options,
                                             unsigned doublings) {
  if (!mesh) mesh = std::make_shared<WeightedMesh>(domain, weights);
  auto run = std::make_shared<Run>();
  run->mesh = mesh;
  run->towards = options.towards;
  const bool from_curves =
      std::any_of(sources.begin(), sources.end(), [](const Source& s) { return s.curve != nullptr; });
  const bool lower = options.lower && !from_curves;
  if (from_curves) run->layout = points_for(Costs::Real, options, doublings);
  locate(sources, options, *run);
  WeightedField field;
  if (lower && !options.keep_paths && doublings == 0 && follow_windows(*run, options, field)) return field;
  run->layout = points_for(Costs::Real, options, doublings);
  std::shared_ptr<const PointLayout> below;
  if (lower && !weights.pace) below = points_for(Costs::Below, options, doublings);
  search(*run, options, below.get(), field);
  field.points = run->layout->size() + (below ? below->size() : 0);
  field.run = std::move(run);
  return field;
}

// With one weight everywhere these are distances, and proven to any tolerance.
WeightedField WeightedSolver::Workspace::run_uniform(std::span<const Source> sources, const WeightedOptions& options) {
  if (!plain) plain = std::make_unique<DistanceSolver>(domain);
  std::vector<Source> scaled(sources.begin(), sources.end());
  for (Source& s : scaled) {
    s.offset /= uniform;
    if (!s.curve || s.curve->offsets.empty()) continue;
    CurveSource curve = *s.curve;
    for (double& offset : curve.offsets) offset /= uniform;
    s.curve = std::make_shared<const CurveSource>(std::move(curve));
  }
  DistanceOptions how;
  how.tolerance = std::min(options.tolerance, kMaxTolerance);
  how.bound = Bound::Upper;
  how.max_distance = options.max_distance / uniform;
  how.targets = options.targets;
  how.progress = options.progress;
  const DistanceField found = plain->distance(scaled, how);
  WeightedField field;
  field.distance = found.distance;
  field.source = found.source;
  field.target_distance = found.target_distance;
  field.target_source = found.target_source;
  field.reached = found.reached;
  field.side_distance = found.side_distance;
  for (std::vector<double>* values : {&field.distance, &field.target_distance, &field.side_distance}) {
    for (double& d : *values) d *= uniform;
  }
  if (!options.lower) return field;
  field.max_error_bound = field.mean_error_bound = found.max_error_bound;
  field.lower = field.distance;
  for (std::size_t v = 0; v < field.lower.size(); ++v) {
    if (field.lower[v] < kInfinity) field.lower[v] -= found.error_bound[v] * uniform;
  }
  field.target_lower = field.target_distance;
  const double base = least_offset(sources);  // a path is not longer than from there
  for (double& d : field.target_lower) d = d < kInfinity ? d - found.max_error_bound * (d - base) : d;
  return field;
}

WeightedSolver::WeightedSolver(Domain domain, Weights weights) : workspace_(std::make_unique<Workspace>()) {
  brushfire::check(domain.mesh(), weights);
  workspace_->domain = std::move(domain);
  workspace_->weights = std::move(weights);
  workspace_->uniform = workspace_->weights.uniform();
}
WeightedSolver::WeightedSolver(std::unique_ptr<Workspace> workspace) : workspace_(std::move(workspace)) {}
WeightedSolver::~WeightedSolver() = default;
WeightedSolver::WeightedSolver(WeightedSolver&&) noexcept = default;
WeightedSolver& WeightedSolver::operator=(WeightedSolver&&) noexcept = default;
const Domain& WeightedSolver::domain() const noexcept { return workspace_->domain; }
const Weights& WeightedSolver::weights() const noexcept { return workspace_->weights; }

void WeightedSolver::prepare(double tolerance) {
  check_tolerance(tolerance);
  Workspace& w = *workspace_;
  if (w.uniform > 0) return;
  if (!w.mesh) w.mesh = std::make_shared<WeightedMesh>(w.domain, w.weights);
  WeightedOptions options;
  options.tolerance = tolerance;
  w.points_for(Costs::Real, options, 0);
}

WeightedSolver WeightedSolver::twin() const {
  auto workspace = std::make_unique<Workspace>();
  workspace->domain = workspace_->domain;
  workspace->weights = workspace_->weights;
  workspace->uniform = workspace_->uniform;
  workspace->mesh = workspace_->mesh;
  workspace->for_real = workspace_->for_real;
  workspace->for_below = workspace_->for_below;
  return WeightedSolver(std::move(workspace));
}

WeightedField WeightedSolver::distance(std::span<const Source> sources, const WeightedOptions& options) {
  const CancelScope listen(options.cancel);
  check(options);
  if (workspace_->uniform > 0) return workspace_->run_uniform(sources, options);
  WeightedField field = workspace_->run(sources, options, 0);
  for (unsigned k = 1; k <= options.refinements && !field.lower.empty() && field.max_error_bound > options.tolerance;
       ++k) {
    field = workspace_->run(sources, options, k);
    field.refinements = k;
  }
  return field;
}

WeightedField weighted_distance(const Domain& domain, const Weights& weights, std::span<const Source> sources,
                                const WeightedOptions& options) {
  return WeightedSolver(domain, weights).distance(sources, options);
}

}  // namespace brushfire
