// Validation, and runs of engines.
#include <brushfire/solvers/distance.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/cost_runs.h>
#include <brushfire/solvers/detail/curve_feet.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/detail/finish.h>
#include <brushfire/solvers/detail/methods.h>
#include <brushfire/solvers/detail/offsets.h>
#include <brushfire/solvers/detail/walls.h>
#include <brushfire/solvers/weighted/weighting.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace brushfire {
namespace {

// std::vector::assign(), on pages that are made present all at once.
template <class T>
void assign(std::vector<T>& array, std::size_t size, T value) {
  if (array.capacity() < size) {
    array.clear();
    array.reserve(size);
    prefault(array.data(), size * sizeof(T));
  }
  array.assign(size, value);
}

// The reached vertices of it alone.
SparseField reached_of(DistanceField field) {
  SparseField result;
  for (Index v = 0; v < field.distance.size(); ++v) {
    if (field.distance[v] == kInfinity) continue;
    result.vertex.push_back(v);
    result.distance.push_back(field.distance[v]);
    result.source.push_back(field.source[v]);
  }
  result.target_distance = std::move(field.target_distance);
  result.target_source = std::move(field.target_source);
  return result;
}

using detail::engine_of, detail::Offsets;

// The others start at points of the curve, and have one value for each front to start with.
void check_slopes(Method method, std::span<const detail::LocatedSource> sources) {
  if (engine_of(method) == Method::Windows || method == Method::Dijkstra || !detail::any_slope(sources)) return;
  throw Error(ErrorCode::InvalidArgument,
              "offsets that change along a curve are for the methods windows, exact and "
              "dijkstra, not for " +
                  std::string(name_of(method)));
}

void locate_sources(const Mesh& mesh, std::span<const Source> sources, std::vector<detail::LocatedSource>& all,
                    Offsets& offsets) {
  if (sources.empty()) throw Error(ErrorCode::InvalidArgument, "no source given: a distance needs at least one");
  all.clear();
  all.reserve(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!std::isfinite(sources[i].offset)) {
      throw Error(ErrorCode::InvalidArgument,
                  "offset " + number_as_text(sources[i].offset) + " of source " + std::to_string(i) + " is not finite");
    }
    all.push_back(detail::located(mesh, sources[i], static_cast<Index>(i)));
    if (!std::isfinite(all.back().offset)) {
      throw Error(ErrorCode::InvalidArgument, "the offsets of source " + std::to_string(i) + " add up to no number");
    }
  }
  offsets.split(mesh, all);
}

// Targets that are nowhere are not for engines: they read +inf.
void locate_targets(const Mesh& mesh, const DistanceOptions& options, std::vector<PointLocation>& located) {
  located.clear();
  located.reserve(options.targets.size());
  for (const SurfacePoint& t : options.targets) {
    if (!t.is_nowhere()) located.push_back(locate(mesh, t));
  }
}

void check(const DistanceOptions& options) {
  if (!(options.max_distance >= 0)) {
    throw Error(ErrorCode::InvalidArgument,
                "max_distance " + number_as_text(options.max_distance) + " is not a number >= 0");
  }
  if (options.method == Method::Windows && !(options.tolerance >= 0 && options.tolerance <= kMaxTolerance)) {
    throw Error(ErrorCode::InvalidArgument, "tolerance " + number_as_text(options.tolerance) + " is not in [0, " +
                                                number_as_text(kMaxTolerance) + "]");
  }
}

}  // namespace

Source source_along(CurveSource curve, double offset) {
  return {{}, offset, std::make_shared<const CurveSource>(std::move(curve))};
}

double least_offset(const Source& source) {
  double least = kInfinity;
  for (std::size_t i = 0; source.curve && i < source.curve->offsets.size(); ++i) {
    if (!source.curve->places[i].is_nowhere()) least = std::min(least, source.curve->offsets[i]);
  }
  return source.offset + (least < kInfinity ? least : 0);
}

struct DistanceSolver::Workspace {
  explicit Workspace(Domain given) : domain(std::move(given)), mesh(domain.open()) {}

  Domain domain;
  Mesh mesh;  // what is open of it
  std::map<Method, std::unique_ptr<detail::Engine>> engines;
  DistanceField scratch;                       // of distance_sparse(): +inf and kNoIndex everywhere between calls
  std::vector<Index> touched;                  // what a run has changed in it
  std::vector<detail::LocatedSource> sources;  // of the run
  std::vector<detail::LocatedSource> points;  // in place of these, where there are curves that the method does not take
  detail::Offsets offsets;                    // of these
  std::vector<PointLocation> targets;         // those that are somewhere
  std::shared_ptr<const Weighting> weighting;  // of the last run that had one
  std::unique_ptr<detail::CostRuns> costs;     // its

  detail::Engine& engine(Method method);
  DistanceField run_weighted(std::span<const Source> from, const DistanceOptions& options);
  detail::Problem problem(const DistanceOptions& options, std::vector<Index>* list) const {
    return {points.empty() ? sources : points,
            targets,
            offsets.radius(options.max_distance, mesh.unit()),
            &options,
            list,
            offsets.bases(),
            current_cancel_token()};
  }
  void clean(bool everything);

  void locate_all(std::span<const Source> from, const DistanceOptions& options);
  void read_curves(DistanceField& field) const;

  // On the open mesh.
  void run(std::span<const Source> from, const DistanceOptions& options, DistanceField& field);
  void run_sparse(std::span<const Source> from, const DistanceOptions& options, SparseField& field);
};

detail::Engine& DistanceSolver::Workspace::engine(Method method) {
  std::unique_ptr<detail::Engine>& engine = engines[engine_of(method)];
  if (!engine) engine = detail::make_engine(mesh, method);
  return *engine;
}

DistanceField DistanceSolver::Workspace::run_weighted(std::span<const Source> from, const DistanceOptions& options) {
  if (weighting != options.weighting) {
    costs = options.weighting->runs();
    weighting = options.weighting;
  }
  return (*costs)(domain, from, options);
}

void DistanceSolver::Workspace::locate_all(std::span<const Source> from, const DistanceOptions& options) {
  locate_sources(mesh, from, sources, offsets);
  locate_targets(mesh, options, targets);
  points.clear();
  if (!detail::any_curve(sources) || engine_of(options.method) == Method::Windows) return;
  if (options.method == Method::Heat) {
    throw Error(ErrorCode::InvalidArgument,
                "heat starts at points: curves are for windows, exact and the marching "
                "methods");
  }
  check_slopes(options.method, sources);
  points = sources;
  detail::replace_curves_by_feet(mesh, points);
}

// Targets in regions; and beside curves that were run as points, straight.
void DistanceSolver::Workspace::read_curves(DistanceField& field) const {
  if (!detail::any_curve(sources)) return;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto offer = [&](const detail::CurveValue& v) {
      if (std::pair(v.distance, v.label) >= std::pair(field.target_distance[i], field.target_source[i])) return;
      field.target_distance[i] = v.distance;
      field.target_source[i] = v.label;
    };
    if (!points.empty()) offer(detail::straight_from_curves(mesh, sources, targets[i]));
    offer(detail::from_regions(mesh, sources, targets[i]));
  }
}

void DistanceSolver::Workspace::clean(bool everything) {
  if (everything || scratch.distance.size() != mesh.vertex_count()) {
    scratch.distance.assign(mesh.vertex_count(), kInfinity);
    scratch.source.assign(mesh.vertex_count(), kNoIndex);
  }
  for (const Index v : touched) {
    scratch.distance[v] = kInfinity;
    scratch.source[v] = kNoIndex;
  }
  touched.clear();
}

DistanceSolver::DistanceSolver(Domain domain) : workspace_(std::make_unique<Workspace>(std::move(domain))) {}
DistanceSolver::~DistanceSolver() = default;
DistanceSolver::DistanceSolver(DistanceSolver&&) noexcept = default;
DistanceSolver& DistanceSolver::operator=(DistanceSolver&&) noexcept = default;
const Domain& DistanceSolver::domain() const noexcept { return workspace_->domain; }
const Mesh& DistanceSolver::mesh() const noexcept { return workspace_->domain.mesh(); }

void DistanceSolver::set_up(const DistanceOptions& options) {
  const CancelScope listen(options.cancel);
  if (options.weighting) return;
  workspace_->engine(options.method).set_up(options);
}

DistanceField DistanceSolver::distance(std::span<const Source> sources, const DistanceOptions& options) {
  DistanceField field;
  distance(sources, options, field);
  return field;
}

void DistanceSolver::distance(std::span<const Source> sources, const DistanceOptions& options, DistanceField& field) {
  field.side_distance.clear();
  if (options.weighting) {
    field = workspace_->run_weighted(sources, options);
    return;
  }
  if (!workspace_->domain.has_walls()) return workspace_->run(sources, options, field);
  const detail::WalledRun walled(workspace_->domain, sources, options);
  workspace_->run(walled.sources(), walled.options(), field);
  walled.bring_back(field);
}

void DistanceSolver::Workspace::run(std::span<const Source> from, const DistanceOptions& options,
                                    DistanceField& field) {
  const CancelScope listen(options.cancel);
  check(options);
  detail::Engine& chosen = engine(options.method);  // first: what it derives of the mesh is not found twice
  locate_all(from, options);
  field.windows.reset();
  field.error_bound.clear();
  field.max_error_bound = kInfinity;
  field.beyond_radius = 0;
  field.updates = 0;
  assign(field.distance, mesh.vertex_count(), kInfinity);
  assign(field.source, mesh.vertex_count(), kNoIndex);
  field.target_distance.assign(targets.size(), kInfinity);
  field.target_source.assign(targets.size(), kNoIndex);
  chosen.solve(problem(options, nullptr), field);
  read_curves(field);
  detail::finish(mesh, targets, offsets, options, field);
}

void DistanceSolver::distance_sparse(std::span<const Source> sources, const DistanceOptions& options,
                                     SparseField& field) {
  if (options.weighting) {
    field = reached_of(workspace_->run_weighted(sources, options));
    return;
  }
  if (!workspace_->domain.has_walls()) return workspace_->run_sparse(sources, options, field);
  const detail::WalledRun walled(workspace_->domain, sources, options);
  workspace_->run_sparse(walled.sources(), walled.options(), field);
  walled.bring_back(field);
}

void DistanceSolver::Workspace::run_sparse(std::span<const Source> from, const DistanceOptions& options,
                                           SparseField& field) {
  const CancelScope listen(options.cancel);
  check(options);
  locate_all(from, options);
  detail::Engine& chosen = engine(options.method);
  const bool listed = chosen.lists_touched();

  clean(false);
  scratch.target_distance.assign(targets.size(), kInfinity);
  scratch.target_source.assign(targets.size(), kNoIndex);
  scratch.error_bound.clear();
  scratch.windows.reset();
  try {
    chosen.solve(problem(options, listed ? &touched : nullptr), scratch);
  } catch (...) {
    clean(!listed);
    throw;
  }
  read_curves(scratch);
  if (!listed) touched.resize(mesh.vertex_count());  // any of them
  detail::collect(mesh.unit(), targets, offsets, options, scratch, touched, field);
  clean(!listed);
}

SparseField DistanceSolver::distance_sparse(std::span<const Source> sources, const DistanceOptions& options) {
  SparseField field;
  distance_sparse(sources, options, field);
  return field;
}

DistanceField distance(const Domain& domain, std::span<const Source> sources, const DistanceOptions& options) {
  return DistanceSolver(domain).distance(sources, options);
}

}  // namespace brushfire
