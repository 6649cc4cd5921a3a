// The logarithmic map: how far every vertex is, and in which direction its shortest path starts.
#include <brushfire/core/cancel.h>
#include <brushfire/core/detail/sort.h>
#include <brushfire/queries/detail/leaving_angles.h>
#include <brushfire/queries/detail/lengths_only.h>
#include <brushfire/queries/detail/only_side.h>
#include <brushfire/queries/straightest.h>
#include <brushfire/solvers/windows/paths/departures.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace brushfire {
namespace {

using detail::LeavingAngles;

constexpr double kUnknownAngle = std::numeric_limits<double>::quiet_NaN();

// The angles at which paths leave the source.
class PathAngles {
 public:
  // vertices: all that a path may bend at, ascending, of the mesh of the run.
  PathAngles(const WindowField& paths, const LeavingAngles& leaving, std::span<const Index> vertices)
      : leaving_(leaving),
        vertices_(vertices),
        angle_(vertices.size(), kUnknownAngle),
        departures_(paths, vertices.size(), [&leaving](const WindowField::Leg& leg) { return leaving.of(leg); }) {}

  // Of the path to vertices[i].
  double to(std::size_t i) {
    if (leaving_.is_source(vertices_[i])) return 0;
    if (std::isnan(angle_[i])) find(i);
    return angle_[i];
  }

 private:
  // Back along the vertices that the path bends at, to one whose angle is known or to the source; theirs is the same.
  void find(std::size_t i) {
    chain_.clear();
    double angle = 0;
    while (true) {
      chain_.push_back(i);
      const windows::Departures::Departure departure = departures_.of(vertices_[i]);
      if (departure.vertex == kNoIndex || leaving_.is_source(departure.vertex)) {
        angle = leaving_.within_turn(departure.angle);
        break;
      }
      i = static_cast<std::size_t>(std::lower_bound(vertices_.begin(), vertices_.end(), departure.vertex) -
                                   vertices_.begin());
      if (!std::isnan(angle_[i])) {
        angle = angle_[i];
        break;
      }
    }
    for (const std::size_t k : chain_) angle_[k] = angle;
  }

  const LeavingAngles& leaving_;
  std::span<const Index> vertices_;
  std::vector<double> angle_;  // [vertices]
  windows::Departures departures_;
  std::vector<std::size_t> chain_;
};

// The vertices of what is open that a run came to, on all sides of walls, and the nearest side of each vertex that was
// reached.
struct Sides {
  std::vector<Index> vertex;         // of domain.open(), ascending
  std::vector<std::size_t> nearest;  // [reached] its place in these
};

Sides sides_of(const Domain& domain, const SparseField& field) {
  Sides sides;
  sides.nearest.resize(field.vertex.size());
  std::iota(sides.nearest.begin(), sides.nearest.end(), std::size_t{0});
  if (!domain.has_walls()) {
    sides.vertex = field.vertex;
    return sides;
  }
  std::vector<std::tuple<Index, std::size_t, double>> found;  // side, which of the reached, value
  for (std::size_t i = 0; i < field.vertex.size(); ++i) {
    for (const SurfacePoint& side : domain.on_open(vertex_point(domain.mesh(), field.vertex[i]))) {
      const double value = field.windows->value(side).distance;
      if (value < kInfinity) found.emplace_back(locate(domain.open(), side).vertex, i, value);
    }
  }
  detail::sort(found.begin(), found.end());
  std::vector<double> least(field.vertex.size(), kInfinity);
  for (const auto& [vertex, i, value] : found) {
    if (value < least[i]) {
      least[i] = value;
      sides.nearest[i] = sides.vertex.size();
    }
    sides.vertex.push_back(vertex);
  }
  return sides;
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
  const Domain& domain = solver.domain();
  const LeavingAngles leaving(domain.open(), detail::only_side(domain, source));
  DistanceOptions options;
  options.method = Method::Exact;
  options.max_distance = how.max_distance;
  options.threads = how.threads;
  options.progress = how.progress;
  options.keep_paths = true;
  options.cancel = how.cancel;
  const Source origin{source};
  SparseField field = solver.distance_sparse(std::span(&origin, 1), options);
  const Sides sides = sides_of(domain, field);
  PathAngles angles(*field.windows, leaving, sides.vertex);
  SparseLogMap map{std::move(field.vertex), std::move(field.distance), {}, leaving.total()};
  map.angle.reserve(map.vertex.size());
  const CancelScope listen(how.cancel);
  Poll poll(64);
  for (const std::size_t side : sides.nearest) {
    poll();
    map.angle.push_back(angles.to(side));
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
