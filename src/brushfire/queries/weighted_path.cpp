// From a run to its paths, in the caller's numbers and units.
#include <brushfire/queries/weighted_path.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/mesh/detail/flat_face.h>
#include <brushfire/queries/detail/strip.h>
#include <brushfire/queries/path.h>

#include <algorithm>
#include <utility>

namespace brushfire {
namespace {

using steiner::Run;
using weighted::Stop;
using weighted::Strip;
using weighted::StripLeg;

SurfacePoint point_of(const steiner::WeightedMesh& weighted, const Stop& stop) {
  const Mesh& mesh = weighted.mesh();
  if (stop.on == Stop::On::Place) return {stop.place.face, stop.place.weights};
  if (stop.on == Stop::On::Vertex) return vertex_point(mesh, stop.vertex);
  const Index h = weighted.edges().halfedge(stop.edge);
  const double length = mesh.lengths()[h], t = length > 0 ? std::clamp(stop.at / length, 0.0, 1.0) : 0;
  SurfacePoint point{Mesh::face_of(h), {0, 0, 0}};
  point.weights[h % 3] = 1 - t;
  point.weights[(h + 1) % 3] = t;
  return point;
}

double height_of(const steiner::WeightedMesh& weighted, const Stop& stop) {
  return position(weighted.mesh(), point_of(weighted, stop)).z;
}

WeightedLeg leg_of(const Run& run, const Strip& strip, std::size_t k) {
  const steiner::WeightedMesh& weighted = *run.mesh;
  const StripLeg& leg = strip.legs[k];
  WeightedLeg result;
  result.length = length_of(weighted, strip, k) * weighted.mesh().unit();
  result.weight = leg.weight;
  result.toll = strip.stops[k].toll * weighted.mesh().unit();
  if (weighted.pace() != nullptr && result.length > 0) {
    const double rise = height_of(weighted, strip.stops[k + 1]) - height_of(weighted, strip.stops[k]);
    const steiner::Travel travel{weighted.pace(), run.towards};
    result.weight *= travel.cost(result.length, rise) / result.length;
  }
  if (weighted.stretches().any() && leg.face != kNoIndex && result.length > 0) {
    const Mesh& mesh = weighted.mesh();
    const auto a = weights_in(mesh, locate(mesh, point_of(weighted, strip.stops[k])), leg.face);
    const auto b = weights_in(mesh, locate(mesh, point_of(weighted, strip.stops[k + 1])), leg.face);
    if (a && b) {
      result.weight *= weighted.stretches().within(mesh, leg.face, *a, *b) * mesh.unit() / result.length;
    }
  }
  Index face = leg.face;
  if (face == kNoIndex) {
    const Index h = weighted.edges().halfedge(leg.edge);
    face = Mesh::face_of(h);
    result.along = {weighted.vertex(weighted.mesh().from(h)), weighted.vertex(weighted.mesh().to(h))};
  }
  SurfacePoint somewhere{face, {1, 0, 0}};
  weighted.to_caller({&somewhere, 1});
  result.face = somewhere.face;
  return result;
}

WeightedPath path_of(const Run& run, const Strip& strip) {
  WeightedPath path;
  if (strip.stops.empty()) return path;
  path.cost = path.length = 0;
  for (const Stop& stop : strip.stops) path.points.push_back(point_of(*run.mesh, stop));
  run.mesh->to_caller(path.points);
  for (std::size_t k = 0; k < strip.legs.size(); ++k) {
    path.legs.push_back(leg_of(run, strip, k));
    path.length += path.legs.back().length;
    path.cost += path.legs.back().cost();
  }
  // A fence at the very end is paid without a leg.
  if (!strip.legs.empty()) path.cost += strip.stops.back().toll * run.mesh->mesh().unit();
  if (run.towards) {
    std::reverse(path.points.begin(), path.points.end());
    std::reverse(path.legs.begin(), path.legs.end());
  }
  return path;
}

// Of the sides of a target, the cheapest.
WeightedPath path_to(const Run& run, std::span<const PointLocation> sides, std::span<const steiner::ValueAt> values) {
  const auto best =
      std::min_element(values.begin(), values.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  if (best == values.end() || best->value == kInfinity) return {};
  Strip strip = weighted::trace(run, sides[static_cast<std::size_t>(best - values.begin())], *best);
  if (run.mesh->is_isotropic()) make_locally_shortest(*run.mesh, strip);
  WeightedPath path = path_of(run, strip);
  path.source = run.sources[steiner::source_behind(run, best->parent)].label;
  return path;
}

// One weight everywhere.
std::vector<WeightedPath> plain_paths(const Domain& domain, double weight, std::span<const Source> sources,
                                      std::span<const SurfacePoint> targets, const WeightedOptions& options) {
  std::vector<Source> scaled(sources.begin(), sources.end());
  for (Source& s : scaled) s.offset /= weight;
  DistanceSolver solver(domain);
  DistanceOptions how;
  how.max_distance = options.max_distance / weight;
  how.cancel = options.cancel;
  const Mesh& mesh = domain.mesh();
  std::vector<WeightedPath> paths;
  for (const SourcePath& found : paths_to(solver, scaled, targets, how)) {
    WeightedPath& path = paths.emplace_back();
    static_cast<SurfacePath&>(path) = found;  // NOLINT(cppcoreguidelines-slicing): the source follows
    path.source = found.source;
    if (found.points.empty()) continue;
    path.cost = path.lower = found.length * weight;
    for (std::size_t k = 0; k + 1 < found.points.size(); ++k) {
      const PointLocation a = locate(mesh, found.points[k], 0), b = locate(mesh, found.points[k + 1], 0);
      WeightedLeg& leg = path.legs.emplace_back();
      leg.face = common_face(mesh, a, b, found.points[k].face);
      leg.length = distance_within(mesh, leg.face, a, b) * mesh.unit();
      leg.weight = weight;
    }
  }
  return paths;
}

}  // namespace

std::vector<WeightedPath> weighted_paths(WeightedSolver& solver, std::span<const Source> sources,
                                         std::span<const SurfacePoint> targets, WeightedOptions options) {
  const CancelScope listen(options.cancel);
  if (targets.empty()) return {};
  if (const double weight = solver.weights().uniform(); weight > 0) {
    return plain_paths(solver.domain(), weight, sources, targets, options);
  }
  options.targets.assign(targets.begin(), targets.end());
  options.keep_paths = true;
  const WeightedField field = solver.distance(sources, options);
  std::vector<WeightedPath> paths;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (field.target_distance[t] == kInfinity) {
      paths.emplace_back();
      continue;
    }
    WeightedPath& path = paths.emplace_back(path_to(*field.run, field.run->targets[t], field.run->target_values[t]));
    if (!field.target_lower.empty()) path.lower = field.target_lower[t] - sources[path.source].offset;
  }
  return paths;
}

std::vector<WeightedPath> weighted_paths(const WeightedField& field, std::span<const SurfacePoint> targets) {
  if (!field.run) {
    throw Error(ErrorCode::InvalidArgument, "the field keeps no run to read paths from: WeightedOptions::keep_paths");
  }
  const Run& run = *field.run;
  const steiner::Places places(*run.mesh, *run.layout, steiner::Costs::Real, {run.mesh->pace(), run.towards});
  std::vector<WeightedPath> paths;
  for (const SurfacePoint& target : targets) {
    std::vector<PointLocation> sides;
    std::vector<steiner::ValueAt> values;
    for (const SurfacePoint& p : run.mesh->on_open(target)) {
      const PointLocation side = locate(run.mesh->mesh(), p);
      const steiner::ValueAt value = places.value(run.front, run.sources, side);
      if (value.value > run.front.horizon) continue;
      sides.push_back(side);
      values.push_back(value);
    }
    paths.push_back(path_to(run, sides, values));
  }
  return paths;
}

WeightedPath weighted_path(WeightedSolver& solver, const SurfacePoint& from, const SurfacePoint& to,
                           const WeightedOptions& options) {
  const Source source{from};
  return weighted_paths(solver, {&source, 1}, {&to, 1}, options).front();
}

}  // namespace brushfire
