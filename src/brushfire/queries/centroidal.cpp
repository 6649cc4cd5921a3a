// Lloyd's method on a surface.
#include <brushfire/queries/centroidal.h>

#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/queries/detail/leaving_angles.h>
#include <brushfire/queries/sampling.h>
#include <brushfire/queries/straightest.h>
#include <brushfire/queries/vertex_measures.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

// Of the cells of one round, on the open mesh.
class Cells {
 public:
  Cells(const Mesh& mesh, std::vector<double> weight, const CentroidalOptions& options)
      : mesh_(mesh), weight_(std::move(weight)), solver_(mesh) {
    run_.method = Method::Exact;
    run_.keep_paths = true;
    run_.threads = options.threads;
  }

  // The field of these sites; its energy.
  double measure(std::span<const SurfacePoint> sites) {
    sites_.assign(sites.begin(), sites.end());
    std::vector<Source> sources;
    for (const SurfacePoint& p : sites) sources.push_back({p});
    solver_.distance(sources, run_, field_);
    double energy = 0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const double d = field_.distance[v];
      if (d < kInfinity) energy += weight_[v] * d * d;
    }
    return energy;
  }

  const DistanceField& field() const { return field_; }

  // Every site moved to the middle of its cell.
  std::vector<SurfacePoint> middles() {
    std::vector<std::optional<detail::LeavingAngles>> leaving(sites_.size());
    for (std::size_t s = 0; s < sites_.size(); ++s) {
      const PointLocation at = locate(mesh_, sites_[s]);
      if (at.on != PointLocation::On::Vertex || mesh_.links()[at.vertex] != Link::Other) {
        leaving[s].emplace(mesh_, sites_[s]);
      }
    }
    std::vector<Vec2> sum(sites_.size(), Vec2{0, 0});
    std::vector<double> weight(sites_.size(), 0);
    angle_.assign(mesh_.vertex_count(), kUnknown);
    Poll poll(64);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      poll();
      const Index s = field_.source[v];
      if (s == kNoIndex || !leaving[s] || !(weight_[v] > 0)) continue;
      weight[s] += weight_[v];
      if (field_.distance[v] == 0) continue;
      sum[s] = sum[s] + weight_[v] * leaving[s]->vector(angle_of_path(v, *leaving[s]), field_.distance[v]);
    }
    std::vector<SurfacePoint> moved = sites_;
    for (std::size_t s = 0; s < sites_.size(); ++s) {
      if (!(weight[s] > 0)) continue;
      const auto [angle, length] = leaving[s]->polar((1 / weight[s]) * sum[s]);
      moved[s] = straightest(mesh_, sites_[s], angle, length).path.points.back();
    }
    return moved;
  }

 private:
  static constexpr double kUnknown = -1;

  // In which the shortest path to v leaves its site: that of the vertex where its last leg starts.
  double angle_of_path(Index v, const detail::LeavingAngles& leaving) {
    chain_.clear();
    double angle = 0;
    while (true) {
      if (angle_[v] != kUnknown) {
        angle = angle_[v];
        break;
      }
      chain_.push_back(v);
      const WindowField::Leg leg = field_.windows->last_leg(v);
      if (leg.vertex == kNoIndex || leaving.is_source(leg.vertex)) {
        if (leg.points.size() > 1) angle = leaving.towards(leg.points[leg.points.size() - 2]);
        break;
      }
      v = leg.vertex;
    }
    for (const Index w : chain_) angle_[w] = angle;
    return angle;
  }

  const Mesh& mesh_;
  std::vector<double> weight_;  // of every vertex: its share of the surface
  DistanceSolver solver_;
  DistanceOptions run_;
  std::vector<SurfacePoint> sites_;
  DistanceField field_;
  std::vector<double> angle_;
  std::vector<Index> chain_;
};

std::vector<double> weights_of(const Domain& domain, std::span<const double> density) {
  std::vector<double> weight = vertex_areas(Domain(domain.open()));
  if (density.empty()) return weight;
  if (density.size() != domain.mesh().vertex_count()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(density.size()) + " densities for " +
                                                std::to_string(domain.mesh().vertex_count()) + " vertices");
  }
  for (Index v = 0; v < weight.size(); ++v) {
    const double d = density[domain.vertex(v)];
    if (!(d >= 0) || !std::isfinite(d)) {
      throw Error(ErrorCode::InvalidArgument, "the density of vertex " + std::to_string(domain.vertex(v)) + " is " +
                                                  std::to_string(d) + ", and not finite and >= 0");
    }
    weight[v] *= d;
  }
  return weight;
}

}  // namespace

CentroidalVoronoi centroidal_voronoi(const Domain& domain, std::span<const SurfacePoint> first,
                                     const CentroidalOptions& options) {
  if (first.empty()) throw Error(ErrorCode::InvalidArgument, "no sites: cells need at least one");
  std::vector<SurfacePoint> sites;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::vector<SurfacePoint> sides = domain.on_open(first[i]);
    if (sides.empty()) {
      throw Error(ErrorCode::InvalidArgument, "site " + std::to_string(i) + " lies behind a wall, or in no face");
    }
    sites.push_back(sides.front());
  }
  const CancelScope listen(options.cancel);
  Cells cells(domain.open(), weights_of(domain, options.density), options);
  CentroidalVoronoi result;
  result.energy.push_back(cells.measure(sites));
  for (Index round = 0; round < options.max_rounds; ++round) {
    if (options.progress) options.progress(static_cast<double>(round) / options.max_rounds);
    std::vector<SurfacePoint> moved = cells.middles();
    const double before = result.energy.back(), energy = cells.measure(moved);
    if (!(energy < before)) {
      cells.measure(sites);  // rounding, or a step too far: what was there is better
      break;
    }
    sites = std::move(moved);
    result.energy.push_back(energy);
    if (before - energy <= options.tolerance * before) break;
  }
  // Sites on the open mesh; the field's copies of vertices by the nearest.
  const DistanceField& field = cells.field();
  result.sites = sites;
  domain.to_mesh(result.sites);
  result.distance.assign(domain.mesh().vertex_count(), kInfinity);
  result.nearest.assign(domain.mesh().vertex_count(), kNoIndex);
  for (Index v = 0; v < field.distance.size(); ++v) {
    const Index o = domain.vertex(v);
    if (!(field.distance[v] < result.distance[o])) continue;
    result.distance[o] = field.distance[v];
    result.nearest[o] = field.source[v];
  }
  return result;
}

CentroidalVoronoi centroidal_voronoi(const Domain& domain, Index count, const CentroidalOptions& options) {
  DistanceOptions run;
  run.cancel = options.cancel;
  const Samples samples = farthest_points(domain, count, {}, run);
  if (samples.vertices.size() < count) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(count) + " sites, but there are " +
                                                std::to_string(samples.vertices.size()) + " vertices to put them");
  }
  std::vector<SurfacePoint> sites;
  for (const Index v : samples.vertices) sites.push_back(vertex_point(domain.mesh(), v));
  return centroidal_voronoi(domain, sites, options);
}

}  // namespace brushfire
