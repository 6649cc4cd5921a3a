// The logarithmic map: how far every vertex is, and in which direction its shortest path starts.
#include <brushfire/queries/straightest.h>

#include <brushfire/core/cancel.h>
#include <brushfire/queries/detail/leaving_angles.h>
#include <brushfire/queries/detail/lengths_only.h>
#include <brushfire/queries/detail/only_side.h>
#include <brushfire/solvers/windows/paths/departures.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace brushfire {
namespace {

using detail::LeavingAngles;

constexpr double kUnknownAngle = std::numeric_limits<double>::quiet_NaN();

// Sets map.angle along the path to entry i: back along the vertices that the path bends at, to one whose angle is known
// or to the source. `chain` is room to work in.
void find_angle(windows::Departures& departures, const LeavingAngles& leaving, SparseLogMap& map, std::size_t i,
                std::vector<std::size_t>& chain) {
  chain.clear();
  double angle = 0;
  while (true) {
    chain.push_back(i);
    const windows::Departures::Departure departure = departures.of(map.vertex[i]);
    if (departure.vertex == kNoIndex || leaving.is_source(departure.vertex)) {
      angle = leaving.within_turn(departure.angle);
      break;
    }
    i = static_cast<std::size_t>(std::lower_bound(map.vertex.begin(), map.vertex.end(), departure.vertex) -
                                 map.vertex.begin());
    if (!std::isnan(map.angle[i])) {
      angle = map.angle[i];
      break;
    }
  }
  for (const std::size_t k : chain) map.angle[k] = angle;
}

// Of the copies of a vertex the nearest.
SparseLogMap brought_back(const Domain& domain, const SparseLogMap& map) {
  std::vector<std::size_t> order(map.vertex.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(domain.vertex(map.vertex[a]), map.radius[a], a) <
           std::tuple(domain.vertex(map.vertex[b]), map.radius[b], b);
  });
  SparseLogMap result{{}, {}, {}, map.total_angle};
  for (const std::size_t i : order) {
    const Index v = domain.vertex(map.vertex[i]);
    if (!result.vertex.empty() && result.vertex.back() == v) continue;
    result.vertex.push_back(v);
    result.radius.push_back(map.radius[i]);
    result.angle.push_back(map.angle[i]);
  }
  return result;
}

}  // namespace

SparseLogMap log_map(DistanceSolver& solver, const SurfacePoint& source, double max_radius, const CancelToken* cancel) {
  DistanceOptions how;
  how.max_distance = max_radius;
  how.cancel = cancel;
  return log_map(solver, source, how);
}

SparseLogMap log_map(DistanceSolver& solver, const SurfacePoint& source, const DistanceOptions& how) {
  detail::check_lengths_only(how, "directions and lengths of a log map");
  if (const Domain& domain = solver.domain(); domain.has_walls()) {
    DistanceSolver on_open(domain.open());
    return brought_back(domain, log_map(on_open, detail::only_side(domain, source), how));
  }
  const LeavingAngles leaving(solver.mesh(), source);
  DistanceOptions options;
  options.method = Method::Exact;
  options.max_distance = how.max_distance;
  options.threads = how.threads;
  options.progress = how.progress;
  options.keep_paths = true;
  options.cancel = how.cancel;
  const Source origin{source};
  SparseField field = solver.distance_sparse(std::span(&origin, 1), options);
  SparseLogMap map{std::move(field.vertex), std::move(field.distance), {}, leaving.total()};
  map.angle.assign(map.vertex.size(), kUnknownAngle);
  std::vector<std::size_t> chain;
  windows::Departures departures(*field.windows, map.vertex.size(),
                                 [&](const WindowField::Leg& leg) { return leaving.of(leg); });
  const CancelScope listen(how.cancel);
  Poll poll(64);
  for (std::size_t i = 0; i < map.vertex.size(); ++i) {
    poll();
    if (leaving.is_source(map.vertex[i])) map.angle[i] = 0;
    if (std::isnan(map.angle[i])) find_angle(departures, leaving, map, i, chain);
  }
  return map;
}

LogMap log_map(const Domain& domain, const SurfacePoint& source, double max_radius, const CancelToken* cancel) {
  const Mesh& mesh = domain.mesh();
  DistanceSolver solver(domain);
  const SparseLogMap reached = log_map(solver, source, max_radius, cancel);
  LogMap map{std::vector<double>(mesh.vertex_count(), kInfinity),
             std::vector<double>(mesh.vertex_count(), kUnknownAngle), reached.total_angle};
  for (std::size_t i = 0; i < reached.vertex.size(); ++i) {
    map.radius[reached.vertex[i]] = reached.radius[i];
    map.angle[reached.vertex[i]] = reached.angle[i];
  }
  return map;
}

}  // namespace brushfire
