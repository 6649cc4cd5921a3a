// Validation, dispatch to an engine, and what all engines share after the run: radius, units, counts.
#include <brushfire/solvers/distance.h>

#include <brushfire/core/error.h>
#include <brushfire/solvers/detail/dijkstra.h>
#include <brushfire/solvers/detail/engine.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace brushfire {
namespace {

constexpr std::array kMethods{Method::Dijkstra};

std::unique_ptr<detail::Engine> make_engine(const Mesh& mesh, Method method) {
  switch (method) {
    case Method::Dijkstra:
      return detail::make_dijkstra(mesh);
    default:
      break;
  }
  throw Error(ErrorCode::InvalidArgument, "no such method");
}

std::vector<detail::LocatedSource> locate_sources(const Mesh& mesh, std::span<const Source> sources) {
  if (sources.empty()) throw Error(ErrorCode::InvalidArgument, "no source given: a distance needs at least one");
  std::vector<detail::LocatedSource> located;
  located.reserve(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!std::isfinite(sources[i].offset)) {
      throw Error(ErrorCode::InvalidArgument,
                  "offset " + std::to_string(sources[i].offset) + " of source " + std::to_string(i) + " is not finite");
    }
    located.push_back({locate(mesh, sources[i].point), sources[i].offset / mesh.unit(), static_cast<Index>(i)});
  }
  return located;
}

void check(const DistanceOptions& options) {
  if (!(options.max_distance >= 0)) {
    throw Error(ErrorCode::InvalidArgument,
                "max_distance " + std::to_string(options.max_distance) + " is not a number >= 0");
  }
}

// Applies the radius, goes back to the mesh's units, counts.
void finish(const Mesh& mesh, const DistanceOptions& options, DistanceField& field) {
  const double unit = mesh.unit();
  field.method = options.method;
  field.reached = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    double& d = field.distance[v];
    if (d == kInfinity) continue;
    d *= unit;
    if (d > options.max_distance) {
      d = kInfinity;
      field.source[v] = kNoIndex;
      ++field.beyond_radius;
    } else {
      ++field.reached;
    }
  }
  field.unreachable = mesh.vertex_count() - field.reached - field.beyond_radius;
  for (std::size_t i = 0; i < field.target_distance.size(); ++i) {
    field.target_distance[i] *= unit;
    if (field.target_distance[i] > options.max_distance) {
      field.target_distance[i] = kInfinity;
      field.target_source[i] = kNoIndex;
    }
  }
}

}  // namespace

std::string_view name_of(Method method) {
  switch (method) {
    case Method::NovotniKlein:
      return "novotni-klein";
    case Method::NovotniKlein2002:
      return "novotni-klein-2002";
    case Method::KimmelSethian:
      return "kimmel-sethian";
    case Method::Dijkstra:
      return "dijkstra";
  }
  return "unknown";
}

Method method_named(std::string_view name) {
  std::string known;
  for (const Method m : kMethods) {
    if (name_of(m) == name) return m;
    known += std::string(known.empty() ? "" : ", ") + std::string(name_of(m));
  }
  throw Error(ErrorCode::InvalidArgument, "unknown method '" + std::string(name) + "': it is one of " + known);
}

std::span<const Method> all_methods() { return kMethods; }

struct DistanceSolver::Workspace {
  Mesh mesh;
  std::map<Method, std::unique_ptr<detail::Engine>> engines;
};

DistanceSolver::DistanceSolver(Mesh mesh) : workspace_(std::make_unique<Workspace>()) {
  workspace_->mesh = std::move(mesh);
}
DistanceSolver::~DistanceSolver() = default;
DistanceSolver::DistanceSolver(DistanceSolver&&) noexcept = default;
DistanceSolver& DistanceSolver::operator=(DistanceSolver&&) noexcept = default;
const Mesh& DistanceSolver::mesh() const noexcept { return workspace_->mesh; }

DistanceField DistanceSolver::distance(std::span<const Source> sources, const DistanceOptions& options) {
  const Mesh& mesh = workspace_->mesh;
  check(options);
  const std::vector<detail::LocatedSource> located = locate_sources(mesh, sources);
  std::vector<PointLocation> targets;
  for (const SurfacePoint& t : options.targets) targets.push_back(locate(mesh, t));

  std::unique_ptr<detail::Engine>& engine = workspace_->engines[options.method];
  if (!engine) engine = make_engine(mesh, options.method);

  DistanceField field;
  field.distance.assign(mesh.vertex_count(), kInfinity);
  field.source.assign(mesh.vertex_count(), kNoIndex);
  field.target_distance.assign(targets.size(), kInfinity);
  field.target_source.assign(targets.size(), kNoIndex);
  engine->solve({located, targets, options.max_distance / mesh.unit(), &options}, field);
  finish(mesh, options, field);
  return field;
}

DistanceField distance(const Mesh& mesh, std::span<const Source> sources, const DistanceOptions& options) {
  return DistanceSolver(mesh).distance(sources, options);
}

}  // namespace brushfire
