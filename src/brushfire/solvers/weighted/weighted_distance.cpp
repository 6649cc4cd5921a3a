// From the caller's mesh to the search and back.
#include <brushfire/solvers/weighted/weighted_distance.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/refraction/detail/run.h>
#include <brushfire/solvers/steiner/detail/apex_costs.h>
#include <brushfire/solvers/steiner/detail/run.h>
#include <brushfire/solvers/weighted/detail/fields.h>
#include <brushfire/solvers/weighted/detail/marching.h>
#include <brushfire/solvers/weighted/detail/needs.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brushfire {
namespace {

using namespace steiner;
using namespace weighted;

// Sums of up to 2^20 costs, each off by a unit in the last place, stay below what they stand for.
constexpr double kBelowSums = 1 - 0x1p-32;

// Windows take no less time where they may be farther apart than this.
constexpr double kWidestWindows = 0.02;

// As many for a vertex as take about as long as the search over points, measured: half a microsecond each, beside 6 +
// 0.6 / tolerance.
double windows_worth_it(double tolerance) { return 20 + 0.8 / tolerance; }

// Costs to a vertex next to a source, as a share of those across its faces, of which windows know little in comparison.
constexpr double kBeside = 1e-3;

void check(const WeightedOptions& options) {
  check_tolerance(options.tolerance);
  if (!(options.max_distance >= 0)) {
    throw Error(ErrorCode::InvalidArgument,
                "max_distance " + number_as_text(options.max_distance) + " is not a number >= 0");
  }
}

// A vertex of the caller's reads the least of its copies.
void bring_back(const WeightedMesh& mesh, std::vector<double>& values) {
  std::vector<double> least(mesh.domain().mesh().vertex_count(), kInfinity);
  for (Index v = 0; v < values.size(); ++v) least[mesh.vertex(v)] = std::min(least[mesh.vertex(v)], values[v]);
  values = std::move(least);
}

}  // namespace

const char* name_of(WeightedEngine engine) noexcept {
  if (engine == WeightedEngine::Uniform) return "uniform";
  if (engine == WeightedEngine::Marching) return "marching";
  return engine == WeightedEngine::Windows ? "windows" : "points";
}

struct WeightedSolver::Workspace {
  Domain domain{Mesh()};
  Weights weights;
  double uniform = 0;
  std::unique_ptr<DistanceSolver> plain;     // where the weight is uniform
  std::shared_ptr<const WeightedMesh> cut;   // elsewhere, for windows and marching
  std::shared_ptr<const WeightedMesh> mesh;  // for points; the same where there are no walls
  struct LaidOut {
    Density density;
    std::shared_ptr<const PointLayout> points;
  };
  LaidOut for_real, for_below;  // the last ones: upper bounds need fewer points
  std::unique_ptr<refraction::Medium> medium;
  std::unique_ptr<detail::Engine> marching;

  const std::shared_ptr<const WeightedMesh>& mesh_with(Walls walls);
  std::shared_ptr<Run> located(Walls walls, std::span<const Source> sources, const WeightedOptions& options,
                               std::shared_ptr<const PointLayout> layout = nullptr);
  std::shared_ptr<const PointLayout> points_for(Costs costs, const WeightedOptions& options, unsigned doublings);
  WeightedField run_uniform(std::span<const Source> sources, const WeightedOptions& options);
  WeightedField run(std::span<const Source> sources, const WeightedOptions& options, unsigned doublings);
  WeightedField run_refined(std::span<const Source> sources, const WeightedOptions& options);
  bool follow_windows(const Run& run, const WeightedOptions& options, unsigned refinements, WeightedField& field);
  void search(Run& run, const WeightedOptions& options, const PointLayout* below, WeightedField& field) const;
  void fill_lower(const Search& below, const Run& run, const WeightedOptions& options, WeightedField& field) const;
};

const std::shared_ptr<const WeightedMesh>& WeightedSolver::Workspace::mesh_with(Walls walls) {
  std::shared_ptr<const WeightedMesh>& wanted = walls == Walls::Left ? mesh : cut;
  const std::shared_ptr<const WeightedMesh>& other = walls == Walls::Left ? cut : mesh;
  const auto is_wall = [](double w) { return w == kInfinity; };
  if (!wanted && other && std::none_of(weights.face.begin(), weights.face.end(), is_wall)) wanted = other;
  if (!wanted) wanted = std::make_shared<WeightedMesh>(domain, weights, walls);
  return wanted;
}

std::shared_ptr<Run> WeightedSolver::Workspace::located(Walls walls, std::span<const Source> sources,
                                                        const WeightedOptions& options,
                                                        std::shared_ptr<const PointLayout> layout) {
  auto run = std::make_shared<Run>();
  run->mesh = mesh_with(walls);
  run->towards = options.towards;
  run->layout = std::move(layout);
  locate(sources, options.targets, *run);
  return run;
}

std::shared_ptr<const PointLayout> WeightedSolver::Workspace::points_for(Costs costs, const WeightedOptions& options,
                                                                         unsigned doublings) {
  const Density wanted = density_for(costs, options.tolerance, doublings);
  LaidOut& last = costs == Costs::Real ? for_real : for_below;
  if (!last.points || !(last.density == wanted)) {
    last.points.reset();
    last.points = std::make_shared<PointLayout>(*mesh_with(Walls::Left), wanted);
    last.density = wanted;
  }
  return last.points;
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
  fill_upper(run, options.max_distance, field);
  if (!below_points) return;
  if (options.progress) limits.progress = [&](double done) { options.progress(share + (1 - share) * done); };
  Search below(*mesh, *below_points, Costs::Below);
  below.run(run.sources, limits);
  fill_lower(below, run, options, field);
}

void WeightedSolver::Workspace::fill_lower(const Search& below, const Run& run, const WeightedOptions& options,
                                           WeightedField& field) const {
  const double unit = mesh->mesh().unit(), horizon = below.front().horizon;
  // What is not final may still fall, but not below the horizon.
  const auto value = [&](double v) { return std::min(v, horizon) * kBelowSums * unit + run.base; };
  field.lower = below.front().vertex_value;
  const NearVertices near(*mesh, run.sources);
  for (const NearVertex& n : near.bounds) field.lower[n.vertex] = std::max(field.lower[n.vertex], n.lower);
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
    for (const PointLocation& p : run.targets[t]) {
      const NearVertex* n = p.on == PointLocation::On::Vertex ? near.at(p.vertex) : nullptr;
      least = std::min(least, std::max(below.at(p).value, n ? n->lower : 0));
    }
    const double upper = field.target_distance[t];
    field.target_lower.push_back(upper < kInfinity ? std::min(value(least), upper) : kInfinity);
    compare(upper, field.target_lower.back());
  }
  field.max_error_bound = most;
  field.mean_error_bound = count > 0 ? sum / static_cast<double>(count) : 0;
}

// Both bounds by windows. False, and the field is empty, where they cannot be followed.
bool WeightedSolver::Workspace::follow_windows(const Run& run, const WeightedOptions& options, unsigned refinements,
                                               WeightedField& field) {
  if (!medium) medium = std::make_unique<refraction::Medium>(*cut);
  const double tolerance = std::ldexp(options.tolerance, -2 * static_cast<int>(refinements));
  if (!medium->is_followable(tolerance)) return false;
  std::vector<PointLocation> places;
  for (const auto& sides : run.targets) places.insert(places.end(), sides.begin(), sides.end());
  const double unit = cut->mesh().unit();
  double farthest = (options.max_distance - run.base) / unit;
  if (!options.targets.empty() && places.empty()) farthest = -1;  // all targets are nowhere
  const NearVertices near(*cut, run.sources);
  refraction::Run windows(*medium, run.sources,
                          {std::min(tolerance, kWidestWindows), farthest, windows_worth_it(tolerance), places,
                           options.progress, near.of_source});
  if (!windows()) return false;
  const auto at_vertex = [&](Index v) {
    refraction::Known known = windows.at_vertex(v);
    if (const NearVertex* n = near.at(v); n && n->upper <= kBeside * n->beyond) {
      known.lower = std::max(known.lower, n->lower);
      known.upper = std::min(known.upper, n->upper);
    }
    return known;
  };
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
  for (Index v = 0; v < cut->mesh().vertex_count(); ++v) {
    known[cut->vertex(v)] = better(known[cut->vertex(v)], at_vertex(v));
  }
  field.distance.resize(known.size());
  field.lower.resize(known.size());
  field.source.resize(known.size());
  for (std::size_t v = 0; v < known.size(); ++v) {
    give(known[v], options.targets.empty(), field.distance[v], field.lower[v], field.source[v]);
    field.reached += field.distance[v] < kInfinity;
  }
  fill_sides(run, horizon, [&](Index v) { return at_vertex(v).upper; }, options.max_distance, field);
  std::size_t place = 0;
  for (const auto& sides : run.targets) {
    refraction::Known there;
    for (const PointLocation& p : sides) {
      there = better(there, p.on == PointLocation::On::Vertex ? at_vertex(p.vertex) : windows.at_target(place));
      ++place;
    }
    give(there, true, field.target_distance.emplace_back(), field.target_lower.emplace_back(),
         field.target_source.emplace_back());
  }
  field.max_error_bound = most;
  field.mean_error_bound = count > 0 ? sum / static_cast<double>(count) : 0;
  field.engine = WeightedEngine::Windows;
  return true;
}

WeightedField WeightedSolver::Workspace::run(std::span<const Source> sources, const WeightedOptions& options,
                                             unsigned doublings) {
  const bool from_curves =
      std::any_of(sources.begin(), sources.end(), [](const Source& s) { return s.curve != nullptr; });
  const bool lower = options.lower && !from_curves;
  WeightedField field;
  if (lower && !options.keep_paths &&
      follow_windows(*located(Walls::CutOut, sources, options), options, doublings, field)) {
    return field;
  }
  const std::shared_ptr<Run> run = located(Walls::Left, sources, options, points_for(Costs::Real, options, doublings));
  std::shared_ptr<const PointLayout> below;
  if (lower && weights.is_isotropic()) below = points_for(Costs::Below, options, doublings);
  search(*run, options, below.get(), field);
  field.points = run->layout->size() + (below ? below->size() : 0);
  field.run = run;
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
  field.engine = WeightedEngine::Uniform;
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

// Until the tolerance is met, or as long as what is allowed may do it.
WeightedField WeightedSolver::Workspace::run_refined(std::span<const Source> sources, const WeightedOptions& options) {
  WeightedField field = run(sources, options, 0);
  field.needed = needs_of(field, options.tolerance, kInfinity);
  for (unsigned k = 1; k <= options.refinements; ++k) {
    const unsigned more = field.needed.refinements;
    if (more == 0 || !field.needed.is_reachable || more > options.refinements - field.refinements) break;
    try {
      WeightedField finer = run(sources, options, k);
      const bool same_kind = finer.engine == field.engine;
      finer.needed = needs_of(finer, options.tolerance, same_kind ? field.max_error_bound : kInfinity);
      if (finer.max_error_bound < field.max_error_bound) {
        field = std::move(finer);
      } else {  // points after windows, where these have given up
        field.needed = finer.needed;
      }
      field.refinements = k;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::TooLarge) throw;
      break;  // what is known is worth more than nothing
    }
  }
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
  WeightedOptions options;
  options.tolerance = tolerance;
  w.points_for(Costs::Real, options, 0);
}

WeightedSolver WeightedSolver::twin() const {
  auto workspace = std::make_unique<Workspace>();
  workspace->domain = workspace_->domain;
  workspace->weights = workspace_->weights;
  workspace->uniform = workspace_->uniform;
  workspace->cut = workspace_->cut;
  workspace->mesh = workspace_->mesh;
  workspace->for_real = workspace_->for_real;
  workspace->for_below = workspace_->for_below;
  return WeightedSolver(std::move(workspace));
}

WeightedField WeightedSolver::distance(std::span<const Source> sources, const WeightedOptions& options) {
  const CancelScope listen(options.cancel);
  check(options);
  if (options.marching) {
    Workspace& w = *workspace_;
    const std::shared_ptr<const WeightedMesh>& cut = w.mesh_with(Walls::CutOut);
    if (!w.marching) w.marching = make_march(*cut, w.weights);
    return march(cut, *w.marching, sources, options);
  }
  if (workspace_->uniform > 0) return workspace_->run_uniform(sources, options);
  return workspace_->run_refined(sources, options);
}

WeightedField weighted_distance(const Domain& domain, const Weights& weights, std::span<const Source> sources,
                                const WeightedOptions& options) {
  return WeightedSolver(domain, weights).distance(sources, options);
}

}  // namespace brushfire
