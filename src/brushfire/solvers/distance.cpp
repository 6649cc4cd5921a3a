// Validation, dispatch to an engine, and what all engines share after the run: radius, units, counts.
#include <brushfire/solvers/distance.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/prefault.h>
#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>
#include <brushfire/solvers/carried_source/detail/engine.h>
#include <brushfire/solvers/detail/curve_feet.h>
#include <brushfire/solvers/detail/dijkstra.h>
#include <brushfire/solvers/detail/engine.h>
#include <brushfire/solvers/detail/offsets.h>
#include <brushfire/solvers/detail/walls.h>
#include <brushfire/solvers/fast_marching/detail/fast_marching.h>
#include <brushfire/solvers/heat/cholesky.h>
#include <brushfire/solvers/heat/engine.h>
#include <brushfire/solvers/steiner/detail/as_distance.h>
#include <brushfire/solvers/windows/engine.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace brushfire {
namespace {

constexpr std::array kMethods{
    Method::Windows,          Method::Exact,         Method::CarriedSource, Method::NovotniKlein,
    Method::NovotniKlein2002, Method::KimmelSethian, Method::Dijkstra,      Method::Heat};

// Methods that share one engine go by the name of the first.
Method engine_of(Method method) {
  if (method == Method::Exact) return Method::Windows;
  return method == Method::NovotniKlein2002 || method == Method::KimmelSethian ? Method::NovotniKlein : method;
}

std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh, Method method) {
  switch (method) {
    case Method::Windows:
      return windows::make_windows(mesh);
    case Method::CarriedSource:
      return carried_source::make_engine(mesh);
    case Method::NovotniKlein:
      return fast_marching::make_engine(mesh);
    case Method::Dijkstra:
      return detail::make_dijkstra(mesh);
    case Method::Heat:
      return heat::make_engine(mesh);
    default:
      break;
  }
  throw Error(ErrorCode::InvalidArgument, "no such method");
}

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

using detail::Offsets;

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

// A target at a vertex reads what the field reads there, to the bit. Makes room for those that are nowhere.
void finish_targets(double unit, std::span<const PointLocation> targets, const Offsets& offsets,
                    const DistanceOptions& options, DistanceField& field) {
  for (std::size_t i = 0; i < field.target_distance.size(); ++i) {
    double& d = field.target_distance[i];
    Index& source = field.target_source[i];
    if (targets[i].on == PointLocation::On::Vertex) {
      d = field.distance[targets[i].vertex];
      source = field.source[targets[i].vertex];
    }
    d = offsets.value(d, source, unit, options.bound);
    if (d == kInfinity || d > options.max_distance) {
      d = kInfinity;
      source = kNoIndex;
    }
  }
  for (std::size_t i = 0; i < options.targets.size() && targets.size() < options.targets.size(); ++i) {
    if (!options.targets[i].is_nowhere()) continue;
    const auto place = static_cast<std::ptrdiff_t>(i);
    field.target_distance.insert(field.target_distance.begin() + place, kInfinity);
    field.target_source.insert(field.target_source.begin() + place, kNoIndex);
  }
}

// Applies the radius, goes back to the mesh's units, counts.
void finish(const Mesh& mesh, std::span<const PointLocation> targets, const Offsets& offsets,
            const DistanceOptions& options, DistanceField& field) {
  const double unit = mesh.unit();
  finish_targets(unit, targets, offsets, options, field);
  field.method = options.method;
  field.reached = 0;
  for (std::size_t v = 0; v < field.distance.size(); ++v) {
    double& d = field.distance[v];
    if (d == kInfinity) continue;
    d = offsets.value(d, field.source[v], unit, options.bound);
    if (d == kInfinity || d > options.max_distance) {
      d = kInfinity;
      field.source[v] = kNoIndex;
      if (!field.error_bound.empty()) field.error_bound[v] = kInfinity;
      ++field.beyond_radius;
    } else {
      if (!field.error_bound.empty()) field.error_bound[v] = offsets.bound(field.error_bound[v], d, unit);
      ++field.reached;
    }
  }
  field.unreachable = mesh.vertex_count() - field.reached - field.beyond_radius;
}

// The touched vertices within the radius, ascending, in the mesh's units. `touched` is sorted on the way.
void collect(double unit, std::span<const PointLocation> targets, const Offsets& offsets,
             const DistanceOptions& options, DistanceField& field, std::vector<Index>& touched, SparseField& result) {
  constexpr std::size_t kScanShare = 16;  // looking at this many vertices costs about as much as sorting in one
  if (touched.size() > field.distance.size() / kScanShare) {
    touched.clear();
    for (Index v = 0; v < field.distance.size(); ++v) {
      if (field.distance[v] != kInfinity || field.source[v] != kNoIndex) touched.push_back(v);
    }
  } else {
    std::sort(touched.begin(), touched.end());
  }
  result.vertex.resize(touched.size());
  result.distance.resize(touched.size());
  result.source.resize(touched.size());
  std::size_t count = 0;
  for (const Index v : touched) {
    const double d = offsets.value(field.distance[v], field.source[v], unit, options.bound);
    if (d == kInfinity || d > options.max_distance) continue;
    result.vertex[count] = v;
    result.distance[count] = d;
    result.source[count++] = field.source[v];
  }
  result.vertex.resize(count);
  result.distance.resize(count);
  result.source.resize(count);
  finish_targets(unit, targets, offsets, options, field);
  result.target_distance.swap(field.target_distance);
  result.target_source.swap(field.target_source);
  result.windows = std::move(field.windows);
}

}  // namespace

std::string_view name_of(Method method) {
  switch (method) {
    case Method::Windows:
      return "windows";
    case Method::Exact:
      return "exact";
    case Method::CarriedSource:
      return "carried-source";
    case Method::NovotniKlein:
      return "novotni-klein";
    case Method::NovotniKlein2002:
      return "novotni-klein-2002";
    case Method::KimmelSethian:
      return "kimmel-sethian";
    case Method::Dijkstra:
      return "dijkstra";
    case Method::Heat:
      return "heat";
  }
  return "unknown";
}

Method method_named(std::string_view name) {
  std::string known;
  if (name == name_of(Method::Heat)) heat::require_factorization();
  for (const Method m : all_methods()) {
    if (name_of(m) == name) return m;
    known += std::string(known.empty() ? "" : ", ") + std::string(name_of(m));
  }
  throw Error(ErrorCode::InvalidArgument, "unknown method '" + std::string(name) + "': it is one of " + known);
}

std::span<const Method> all_methods() {
  return heat::can_factor() ? std::span(kMethods) : std::span(kMethods).first(kMethods.size() - 1);  // heat is the last
}

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
  std::shared_ptr<const Weighting> weighting;  // of the last run that had one, and its solver
  std::optional<WeightedSolver> weighted;

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
  if (!engine) engine = make_engine(mesh, engine_of(method));
  return *engine;
}

DistanceField DistanceSolver::Workspace::run_weighted(std::span<const Source> from, const DistanceOptions& options) {
  if (weighting != options.weighting) {
    weighted.emplace(options.weighting->solver());
    weighting = options.weighting;
  }
  return steiner::run_as_distance(*weighted, domain, from, options);
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

// Targets beside curves that were run as points, straight.
void DistanceSolver::Workspace::read_curves(DistanceField& field) const {
  if (points.empty()) return;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const detail::CurveValue value = detail::straight_from_curves(mesh, sources, targets[i]);
    if (std::pair(value.distance, value.label) >= std::pair(field.target_distance[i], field.target_source[i])) continue;
    field.target_distance[i] = value.distance;
    field.target_source[i] = value.label;
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
  finish(mesh, targets, offsets, options, field);
}

void DistanceSolver::distance_sparse(std::span<const Source> sources, const DistanceOptions& options,
                                     SparseField& field) {
  if (options.weighting) {
    field = steiner::reached_of(workspace_->run_weighted(sources, options));
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
  collect(mesh.unit(), targets, offsets, options, scratch, touched, field);
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
